// Area lights: one-sided diffuse emitters on the front of an object. A luminous sphere is one on a
// sphere.
#pragma once

#include "lights/emitter_elements.h"
#include "lights/light_kind.h"
#include "math/sampling.h"

namespace stilb::lights {

class AreaEmitter;

struct AreaLight {
    ObjectId object{};
    Rgb luminance_cd_m2;

    static constexpr std::string_view kType = "area";
    static constexpr LightLocation kLocation = LightLocation::surface;
    using Emitter = AreaEmitter;
    void scale(const Rgb& by) { luminance_cd_m2 *= by; }
    Rgb flux_lm(const Surroundings& surroundings) const;
    std::vector<LightDetail> details(const Surroundings& surroundings) const;
};

class AreaEmitter {
  public:
    AreaEmitter(const AreaLight& light, const Surroundings& surroundings, const Lift& lift);

    Emission emit(math::SampleStream& stream) const;
    std::optional<IncidentLight> sample_incident(const ReceivingPoint& at,
                                                 const std::array<double, 2>& u) const;
    double rough_illuminance_lx(const Vec3& from, const Vec3& normal) const;

    double pdf_per_sr(std::uint32_t triangle, const Vec3& position, const Vec3& normal,
                      const Vec3& from) const;

  private:
    Rgb luminance_cd_m2_;
    double flux_lm_;  ///< luminous
    Lift lift_;
    std::vector<EmitterElement> elements_;
    math::DiscreteDistribution by_area_;
    Vec3 middle_;
    double radius_m_ = 0;
};

}  // namespace stilb::lights

namespace stilb {
using lights::AreaLight;
}  // namespace stilb
