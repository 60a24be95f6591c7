// Light from infinity around the whole scene: constant luminance, or that of a panorama.
#pragma once

#include <memory>
#include <vector>

#include "lights/light_kind.h"
#include "lights/panorama.h"
#include "math/sampling.h"

namespace stilb::lights {

class EnvironmentEmitter;

struct EnvironmentLight {
    Rgb luminance_cd_m2;                          ///< of all directions, where there is no panorama
    std::shared_ptr<const Panorama> panorama{};   ///< instead
    Frame axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< of the panorama in the scene

    static constexpr std::string_view kType = "environment";
    static constexpr LightLocation kLocation = LightLocation::infinity;
    using Emitter = EnvironmentEmitter;
    void scale(const Rgb& by);
    bool shines_like(const EnvironmentLight& other) const { return panorama == other.panorama; }
    /// The flux that enters the scene's bounding box.
    Rgb flux_lm(const Surroundings& surroundings) const;
    std::vector<LightDetail> details(const Surroundings& surroundings) const;
};

/// The axes of a panorama with the top `unit_up`. With +z as the top the picture's middle looks along +x,
/// rotated by `rotation_deg` counterclockwise seen from above; other directions are reached by the shortest
/// rotation from there.
Frame panorama_axes(const Vec3& unit_up, double rotation_deg);

/// Particles enter through the faces of the scene's bounding box, a little enlarged, in proportion to the
/// flux where the luminance is constant; elsewhere in proportion to luminance, uniformly over the box as it
/// is seen from their direction, and carry flux in proportion to its projected area. A share of them goes
/// through the boxes of Surroundings::entries() in the same manner, and each has the density of all boxes
/// that its line meets.
class EnvironmentEmitter {
  public:
    EnvironmentEmitter(const EnvironmentLight& light, const Surroundings& surroundings, const Lift& lift);

    Emission emit(math::SampleStream& stream) const;
    /// Constant luminance: sampled by the cosine at the receiver.
    std::optional<IncidentLight> sample_incident(const SurfacePoint& at,
                                                 const std::array<double, 2>& u) const;
    double rough_illuminance_lx(const SurfacePoint& at) const;

    Rgb luminance_cd_m2(const Vec3& direction) const;
    double pdf_per_sr(const Vec3& direction, const SurfacePoint& at) const;

  private:
    Emission emit_constant(math::SampleStream& stream) const;
    Emission emit_panorama(math::SampleStream& stream) const;
    /// A particle through a point on a face of a box. `share`: of its flux, if all went through the scene's
    /// box alone; `area_m2(box)`: what their density is in inverse proportion to.
    template <typename Area>
    Emission through(std::size_t entry, const Vec3& point, const Vec3& direction, const Rgb& share,
                     const Area& area_m2) const;
    IncidentLight incident(const Vec3& from, const Vec3& direction, const Rgb& luminance,
                           double pdf_per_sr) const;

    EnvironmentLight light_;
    std::vector<Entry> entries_;  ///< the first is the scene's box, in which all others lie
    math::DiscreteDistribution choice_;
    Rgb flux_lm_;
    std::array<double, 6> illuminance_lx_{};  ///< luminous, about: of surfaces facing +x, -x, +y ...
};

}  // namespace stilb::lights

namespace stilb {
using lights::EnvironmentLight;
}  // namespace stilb
