// A luminous surface whose light on diffuse receivers has a closed form.
#pragma once

#include <optional>
#include <vector>

#include "lights/solid_angle/projected_solid_angle.h"
#include "scene/scene.h"
#include "transport/direct/lamp_hull.h"
#include "transport/light_sampler.h"

namespace stilb::transport {

class UniformLamp {
  public:
    static constexpr std::size_t kMostElements = 32;

    /// Of a light of the scene; nothing where it has no closed form, or too many elements for one.
    static std::optional<UniformLamp> of(const Scene& scene, std::size_t light, const Lift& lift);

    std::size_t light() const { return light_; }
    const LampHull& hull() const { return hull_; }
    /// The illuminance without shadows, as if elements hid nothing of each other: exact.
    Rgb illuminance_lx(const SurfacePoint& at) const {
        return projected_solid_angle_sr(at) * luminance_cd_m2_;
    }
    /// The light from a point of the front that is drawn by projected solid angle.
    std::optional<DirectSample> sample(const SurfacePoint& at, math::SampleStream& stream) const;

  private:
    UniformLamp(std::size_t light, ObjectId object, const Rgb& luminance_cd_m2,
                std::vector<lights::EmitterElement> elements, const Lift& lift);
    double projected_solid_angle_sr(const SurfacePoint& at) const;

    std::size_t light_;  ///< its number
    Rgb luminance_cd_m2_;
    std::vector<lights::EmitterElement> elements_;
    Lift lift_;
    LampHull hull_;
};

}  // namespace stilb::transport
