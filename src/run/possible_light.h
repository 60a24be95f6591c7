// The light that a reading may have missed where no sample found any.
#pragma once

#include <vector>

#include "sensors/sensor.h"
#include "transport/light_sampler.h"

namespace stilb::run {

/// Keeps references to the scene and to the caster.
class PossibleLight {
  public:
    PossibleLight(const Scene& scene, const rays::RayCaster& caster, int max_reflections);

    /// About the largest contribution of a single sample of reflected light: the light of all lamps there
    /// without shadows, by which methods choose among lamps, or what surfaces reflect that the reading sees,
    /// if that is more. 0 where nothing can reflect light to the reading.
    double of(const Measurand& measurand) const;

  private:
    /// A place that a particle of a lamp has met.
    struct Lit {
        Vec3 lifted, normal;
        double reflectance = 0, all_lx = 0;
    };
    void find_lit();
    double light_lx(const MeasuringPoint& at) const;
    /// The unshadowed light of all lamps.
    double all_lx(const Vec3& position, const Vec3& normal) const;
    /// The mean light that lit places reflect, over those that are seen from there; 0 without any.
    double seen_lx(const MeasuringPoint& at, const Vec3& lifted) const;

    const Scene& scene_;
    const rays::RayCaster& caster_;
    transport::LightSampler lights_;
    std::vector<Bounds> reflecting_;  ///< of the objects that reflect light
    std::vector<Lit> lit_;
};

}  // namespace stilb::run
