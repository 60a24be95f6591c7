// Light sources. Photometric quantities are per band: luminance() of an intensity is candela, and so on.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "lights/area.h"
#include "lights/environment.h"
#include "lights/light_kind.h"
#include "lights/luminaire.h"
#include "lights/luminous_opening.h"
#include "lights/point.h"

namespace stilb::lights {

/// All kinds of light: a new kind is added here.
using LightSource = std::variant<PointLight, Luminaire, LuminousOpening, AreaLight, EnvironmentLight>;

struct Light {
    std::string name;
    LightSource source;
    std::string group = {};  ///< of lights that are dimmed together; empty: it is one of its own
    double maintenance = 1;  ///< the maintenance factor, which its emission contains
    /// The electric power at full output, where it is known.
    std::optional<double> power_w = {};
};

template <typename Sources>
struct EmittersOf;
template <LightKind... Kinds>
struct EmittersOf<std::variant<Kinds...>> {
    using Type = std::variant<typename Kinds::Emitter...>;
};
/// The functions for a light of any kind, in the order of LightSource.
using Emitter = EmittersOf<LightSource>::Type;

Emitter make_emitter(const Light& light, const Surroundings& surroundings, const Lift& lift);
LightLocation location_of(const Light& light);
/// The type in scene files; luminous spheres are area lights.
std::string_view type_of(const Light& light);
Rgb flux_lm(const Light& light, const Surroundings& surroundings);
std::vector<LightDetail> details_of(const Light& light, const Surroundings& surroundings);

/// The object whose front emits the light of a light on a surface; nothing for other lights.
std::optional<ObjectId> emitting_object(const Light& light);
/// Its luminance over all points and directions.
std::optional<Rgb> mean_luminance_cd_m2(const Light& light, const Surroundings& surroundings);
/// The emission of a surface with the same luminance everywhere and in all directions; nothing for other
/// lights.
struct UniformEmission {
    ObjectId object{};
    Rgb luminance_cd_m2;
};
std::optional<UniformEmission> uniform_emission(const Light& light);
/// The same light, its emission multiplied by a factor, band by band.
LightSource scaled(const LightSource& source, const Rgb& factor);
/// The luminaire of a file that a light is, with or without an opening; null for others.
const Luminaire* luminaire_of(const Light& light);
/// The luminous opening of such a luminaire; nothing for other lights.
std::optional<ObjectId> opening_of(const Light& light);
/// Whether two lights are of one kind and send their light into the same directions, whatever their flux,
/// colour and place.
bool shine_alike(const Light& a, const Light& b);
/// The emitter of a point light; nothing for other lights.
std::optional<LightOrigin> point_origin(const Light& light);

}  // namespace stilb::lights

namespace stilb {
using lights::Light;
using lights::LightLocation;
}  // namespace stilb
