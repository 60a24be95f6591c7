// The light that a reading may have missed where no sample found any.
#pragma once

#include <vector>

#include "sensors/sensor.h"
#include "transport/light_sampler.h"

namespace stilb::run {

/// Keeps a reference to the scene and to the caster.
class PossibleLight {
  public:
    PossibleLight(const Scene& scene, const rays::RayCaster& caster, int max_reflections);

    /// About the largest contribution of a single sample of reflected light: the light of all lamps there
    /// without shadows, by which methods choose among lamps. 0 where nothing can reflect light to the
    /// reading.
    double of(const Measurand& measurand) const;

  private:
    double light_lx(const MeasuringPoint& at) const;

    const rays::RayCaster& caster_;
    transport::LightSampler lights_;
    std::vector<Bounds> reflecting_;  ///< of the objects that reflect light
};

}  // namespace stilb::run
