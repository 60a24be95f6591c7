// Area lights: one-sided diffuse emitters on the front of an object. A luminous sphere is one on a
// sphere.
#pragma once

#include "lights/emitter_surface.h"
#include "lights/light_kind.h"

namespace stilb::lights {

class AreaEmitter;

struct AreaLight {
    ObjectId object{};
    Rgb luminance_cd_m2;

    static constexpr std::string_view kType = "area";
    static constexpr LightLocation kLocation = LightLocation::surface;
    using Emitter = AreaEmitter;
    void scale(const Rgb& by) { luminance_cd_m2 *= by; }
    bool shines_like(const AreaLight&) const { return true; }
    Rgb flux_lm(const Surroundings& surroundings) const;
    std::vector<LightDetail> details(const Surroundings& surroundings) const;
    const Rgb& mean_luminance_cd_m2(const Surroundings&) const { return luminance_cd_m2; }
};

class AreaEmitter {
  public:
    AreaEmitter(const AreaLight& light, const Surroundings& surroundings, const Lift& lift);

    Emission emit(math::SampleStream& stream) const;
    std::optional<IncidentLight> sample_incident(const SurfacePoint& at,
                                                 const std::array<double, 2>& u) const;
    double rough_illuminance_lx(const SurfacePoint& at) const;

    const Rgb& luminance_cd_m2(const Vec3&) const { return luminance_cd_m2_; }
    double pdf_per_sr(std::uint32_t triangle, const Vec3& position, const Vec3& normal,
                      const Vec3& from) const {
        return surface_.pdf_per_sr(triangle, position, normal, from);
    }

  private:
    Rgb luminance_cd_m2_;
    double flux_lm_;  ///< luminous
    EmitterSurface surface_;
};

}  // namespace stilb::lights

namespace stilb {
using lights::AreaLight;
}  // namespace stilb
