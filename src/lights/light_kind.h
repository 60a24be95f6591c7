// What every kind of light is made of. A kind is a plain value, as the scene file has it, and an emitter that
// is made of it for one scene: all that transport does with a light. light.h lists the kinds; a kind that
// lacks something of LightKind does not compile there.
#pragma once

#include <array>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/ids.h"
#include "base/rays.h"
#include "base/rgb.h"
#include "base/vec.h"
#include "geometry/shape.h"
#include "lights/photometric_solid.h"
#include "math/random.h"

namespace stilb::lights {

/// Where a kind of light is. Transport goes by this, never by the kind itself.
enum class LightPlace {
    point,     ///< no ray can meet it; its light at a point is known without sampling
    surface,   ///< rays that meet the front of its object see it
    infinity,  ///< rays that leave the scene see it
};

/// The scene around a light, as far as lights depend on it.
class Surroundings {
  public:
    virtual ~Surroundings() = default;
    virtual const Shape& shape(ObjectId object) const = 0;
    virtual std::string_view name(ObjectId object) const = 0;
    virtual const PhotometricSolid& solid(SolidId solid) const = 0;
    virtual std::string_view file(SolidId solid) const = 0;
    /// Of all objects and of the lights that are points.
    virtual Bounds bounds() const = 0;
};

/// A particle as it leaves a light.
struct Emission {
    Vec3 origin;  ///< lifted off the light
    Vec3 direction;
    /// Its flux over that of the light, band by band: 1 where particles are drawn in proportion to flux.
    Rgb share = Rgb::grey(1);
};

/// Light that arrives at a point from a sampled point or direction of a source, visibility left out.
struct IncidentLight {
    Vec3 source_point;  ///< lifted off the source; beyond the scene for light from infinity
    Vec3 direction;     ///< unit, towards the source
    /// Multiply by the cosine at the receiver (and the BRDF), and by visibility. The division by the density
    /// is in it; for a point source it is intensity / distance^2 [lx].
    Rgb normal_illuminance_lx;
    /// About the density of `direction`, as the emitter's pdf_per_sr() has it: for weighing samples of lights
    /// against others. Infinite for point sources.
    double pdf_per_sr = 0;
};

/// Where light is received. Without a normal it is received from all around, else from above the surface.
struct ReceivingPoint {
    Vec3 position;
    std::optional<Vec3> normal;
};

/// A number or text about a light, for `info`. Keys carry their units.
struct LightDetail {
    std::string_view key;
    std::variant<double, std::string> value;
};

/// A point that a point light shines from; the axis leads into the space that it lights, where not all do.
struct LightOrigin {
    Vec3 position;
    std::optional<Vec3> axis;
};

/// Of every kind.
template <typename E>
concept EmitterKind = requires(const E& emitter, math::SampleStream& stream, const ReceivingPoint& at,
                               const Vec3& v, const std::array<double, 2>& u) {
    /// A particle in proportion to the flux, or nearly so: see Emission::share.
    { emitter.emit(stream) } -> std::same_as<Emission>;
    /// Nothing where the sample's front is turned away.
    { emitter.sample_incident(at, u) } -> std::same_as<std::optional<IncidentLight>>;
    /// About the unshadowed illuminance [lx] of a surface, for choosing among lights. 0 only where it is 0.
    { emitter.rough_illuminance_lx(v, v) } -> std::same_as<double>;
};

/// Of lights that are points.
template <typename E>
concept PointEmitterKind = requires(const E& emitter, const Vec3& v, const Frame& frame) {
    { E::kNoun } -> std::convertible_to<std::string_view>;
    /// Where rays start.
    { emitter.lifted() } -> std::convertible_to<Vec3>;
    /// The same in the coordinates of a frame at the light.
    { emitter.turned_into(frame) } -> std::same_as<E>;
    /// Luminance-weighted, along a unit direction that leaves the light.
    { emitter.luminous_intensity_cd(v) } -> std::same_as<double>;
};

/// Of lights on surfaces: the density of the direction to a point of one of the object's triangles (0 of
/// objects without).
template <typename E>
concept SurfaceEmitterKind = requires(const E& emitter, std::uint32_t triangle, const Vec3& v) {
    { emitter.pdf_per_sr(triangle, v, v, v) } -> std::same_as<double>;
};

/// Of light from infinity: what comes from a unit direction, and the density of sample_incident() there.
template <typename E>
concept InfiniteEmitterKind = requires(const E& emitter, const ReceivingPoint& at, const Vec3& v) {
    { emitter.luminance_cd_m2(v) } -> std::same_as<Rgb>;
    { emitter.pdf_per_sr(v, at) } -> std::same_as<double>;
};

/// The plain value. Its `Emitter` is made from it, its surroundings and the scene's Lift.
template <typename L>
concept LightKind = EmitterKind<typename L::Emitter> &&
    std::constructible_from<typename L::Emitter, const L&, const Surroundings&, const Lift&> &&
    requires(const L& light, const Surroundings& surroundings, Bounds& bounds) {
    { L::kType } -> std::convertible_to<std::string_view>;
    { L::kPlace } -> std::convertible_to<LightPlace>;
    /// Per band; luminance() of it is lumen.
    { light.flux_lm(surroundings) } -> std::same_as<Rgb>;
    { light.details(surroundings) } -> std::same_as<std::vector<LightDetail>>;
} &&(L::kPlace != LightPlace::point || (PointEmitterKind<typename L::Emitter> &&
                                        requires(const L& light) {
                                            { light.origin() } -> std::same_as<LightOrigin>;
                                        })) &&
    (L::kPlace != LightPlace::surface || (SurfaceEmitterKind<typename L::Emitter> &&
                                          requires(const L& light) {
                                              { light.object } -> std::convertible_to<ObjectId>;
                                              { light.luminance_cd_m2 } -> std::convertible_to<Rgb>;
                                          })) &&
    (L::kPlace != LightPlace::infinity || InfiniteEmitterKind<typename L::Emitter>);

}  // namespace stilb::lights
