// The interface of all kinds of light. A kind is a plain value, as in the scene file, and an emitter that
// is constructed from it for one scene and provides everything that transport needs. light.h lists the kinds;
// a kind that lacks a member of LightKind does not compile there.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/ids.h"
#include "base/rays.h"
#include "base/rgb.h"
#include "base/surface_point.h"
#include "base/vec.h"
#include "geometry/shape.h"
#include "lights/photometric_solid.h"
#include "math/random.h"

namespace stilb::lights {

/// The location of a kind of light. Transport distinguishes lights by this, never by their kind.
enum class LightLocation {
    point,     ///< no ray can meet it; its light at a point is computed without sampling
    surface,   ///< rays that meet the front of its object see it
    infinity,  ///< rays that leave the scene see it
};

/// A box through which some of the particles of light from infinity go.
struct Entry {
    Bounds box;
    double share = 1;  ///< of the particles
};

/// The part of the scene that lights depend on.
class Surroundings {
  public:
    virtual ~Surroundings() = default;
    virtual const Shape& shape(ObjectId object) const = 0;
    virtual std::string_view name(ObjectId object) const = 0;
    virtual const PhotometricSolid& solid(SolidId solid) const = 0;
    virtual std::string_view file(SolidId solid) const = 0;
    /// Bounds of all objects and point lights.
    virtual Bounds bounds() const = 0;
    /// Where light from infinity should come in beside bounds(): boxes within these around the places that
    /// matter most, all shares together less than 1.
    virtual std::span<const Entry> entries() const = 0;
};

/// A particle that leaves a light.
struct Emission {
    Vec3 origin;  ///< lifted off the light
    Vec3 direction;
    /// Its flux over that of the light, band by band: 1 where particles are sampled in proportion to flux.
    Rgb share = Rgb::grey(1);
    /// Particles like this one are so much more frequent than in proportion to their flux.
    double favour = 1;
};

/// Light that arrives at a point from a sampled point or direction of a source, visibility left out.
struct IncidentLight {
    Vec3 source_point;  ///< lifted off the source; beyond the scene for light from infinity
    Vec3 direction;     ///< unit, towards the source
    /// Multiply by the cosine at the receiver (and the BRDF), and by visibility. The division by the density
    /// is in it; for a point source it is intensity / distance^2 [lx].
    Rgb normal_illuminance_lx;
    /// The approximate density of `direction`, as in the emitter's pdf_per_sr(): for weights against samples
    /// of other lights. Infinite for point sources.
    double pdf_per_sr = 0;
    std::uint32_t light = 0;  ///< of Scene::lights; set by what chooses among lights
};

/// A number or text about a light, for `info`. Keys carry their units.
struct LightDetail {
    std::string_view key;
    std::variant<double, std::string> value;
};

/// The emission point of a point light.
struct LightOrigin {
    Vec3 position;
    std::optional<Vec3> axis{};         ///< into the half space that it illuminates, if it is one-sided
    std::optional<Rgb> intensity_cd{};  ///< if that is the same in all directions
};

/// The interface of every emitter.
template <typename E>
concept EmitterKind = requires(const E& emitter, math::SampleStream& stream, const SurfacePoint& at,
                               const Vec3& v, const std::array<double, 2>& u) {
    /// Samples a particle in proportion to the flux, or nearly so: see Emission::share.
    { emitter.emit(stream) } -> std::same_as<Emission>;
    /// Nothing where the sample's front faces away.
    { emitter.sample_incident(at, u) } -> std::same_as<std::optional<IncidentLight>>;
    /// The approximate unshadowed illuminance [lx] of a surface, for the choice among lights. 0 only where it
    /// is exactly 0.
    { emitter.rough_illuminance_lx(at) } -> std::same_as<double>;
};

/// The interface of point lights.
template <typename E>
concept PointEmitterKind = requires(const E& emitter, const Vec3& v, const Frame& frame) {
    { E::kNoun } -> std::convertible_to<std::string_view>;
    /// The start of rays.
    { emitter.lifted() } -> std::convertible_to<Vec3>;
    /// The same in the coordinates of a frame at the light.
    { emitter.turned_into(frame) } -> std::same_as<E>;
    /// The luminance-weighted intensity along a unit direction that leaves the light.
    { emitter.luminous_intensity_cd(v) } -> std::same_as<double>;
};

/// For lights on surfaces: the luminance of the front for a unit direction that leaves it, and the density of
/// the direction to a point of one of the object's triangles (0 for objects without triangles).
template <typename E>
concept SurfaceEmitterKind = requires(const E& emitter, std::uint32_t triangle, const Vec3& v) {
    { emitter.luminance_cd_m2(v) } -> std::convertible_to<Rgb>;
    { emitter.pdf_per_sr(triangle, v, v, v) } -> std::same_as<double>;
};

/// For light from infinity: the luminance from a unit direction, and the density of sample_incident() there.
template <typename E>
concept InfiniteEmitterKind = requires(const E& emitter, const SurfacePoint& at, const Vec3& v) {
    { emitter.luminance_cd_m2(v) } -> std::same_as<Rgb>;
    { emitter.pdf_per_sr(v, at) } -> std::same_as<double>;
};

/// The plain value. Its `Emitter` is constructed from it, its surroundings and the scene's Lift.
template <typename L>
concept LightKind = EmitterKind<typename L::Emitter> &&
    std::constructible_from<typename L::Emitter, const L&, const Surroundings&, const Lift&> &&
    requires(const L& light, const Surroundings& surroundings, Bounds& bounds) {
    { L::kType } -> std::convertible_to<std::string_view>;
    { L::kLocation } -> std::convertible_to<LightLocation>;
    /// Per band; luminance() of it is lumen.
    { light.flux_lm(surroundings) } -> std::same_as<Rgb>;
    { light.details(surroundings) } -> std::same_as<std::vector<LightDetail>>;
} && requires(L& light, const Rgb& factor) {
    /// Multiplies its emission, band by band.
    light.scale(factor);
} && requires(const L& light) {
    /// Whether both send their light into the same directions, whatever their flux, colour and place.
    { light.shines_like(light) } -> std::same_as<bool>;
} &&(L::kLocation != LightLocation::point || (PointEmitterKind<typename L::Emitter> &&
                                              requires(const L& light) {
                                                  { light.origin() } -> std::same_as<LightOrigin>;
                                              })) &&
    (L::kLocation != LightLocation::surface || (SurfaceEmitterKind<typename L::Emitter> &&
                                                requires(const L& light, const Surroundings& surroundings) {
                                                    { light.object } -> std::convertible_to<ObjectId>;
                                                    {
                                                        light.mean_luminance_cd_m2(surroundings)
                                                        } -> std::convertible_to<Rgb>;
                                                })) &&
    (L::kLocation != LightLocation::infinity || InfiniteEmitterKind<typename L::Emitter>);

}  // namespace stilb::lights
