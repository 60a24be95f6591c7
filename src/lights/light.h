// Light sources. Photometric quantities are per band: luminance() of an intensity is candela, and so on.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "lights/area.h"
#include "lights/environment.h"
#include "lights/light_kind.h"
#include "lights/luminaire.h"
#include "lights/point.h"

namespace stilb::lights {

/// All kinds of light: here a new one is added.
using LightSource = std::variant<PointLight, Luminaire, AreaLight, EnvironmentLight>;

struct Light {
    std::string name;
    LightSource source;
};

template <typename Sources>
struct EmittersOf;
template <LightKind... Kinds>
struct EmittersOf<std::variant<Kinds...>> {
    using type = std::variant<typename Kinds::Emitter...>;
};
/// Of any kind, in the order of LightSource.
using Emitter = EmittersOf<LightSource>::type;

Emitter make_emitter(const Light& light, const Surroundings& surroundings, const Lift& lift);
LightPlace place_of(const Light& light);
/// In the words of the scene file; luminous spheres are area lights.
std::string_view type_of(const Light& light);
Rgb flux_lm(const Light& light, const Surroundings& surroundings);
std::vector<LightDetail> details_of(const Light& light, const Surroundings& surroundings);

/// What a light on a surface gives off; nothing of other lights.
struct SurfaceEmission {
    ObjectId object{};
    Rgb luminance_cd_m2;
};
std::optional<SurfaceEmission> surface_emission(const Light& light);
/// Of a light that is a point; nothing of other lights.
std::optional<LightOrigin> point_origin(const Light& light);

}  // namespace stilb::lights

namespace stilb {
using lights::Light;
using lights::LightPlace;
}  // namespace stilb
