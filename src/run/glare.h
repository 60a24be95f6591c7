// Ratings of discomfort glare, from the illuminances at eyes.
//
// The Unified Glare Rating [CIE 117] is
//
//     UGR = 8 log10( 0.25 pi / q ),   q = (E - Ed) / G,
//
// with the illuminance E at the eye, that by lamps alone Ed, and G = sum of L^2 w / p^2 over the lamps. The
// replicates of q are linear in those of E, and normal where those are, even where noise makes some of them
// negative. UGR falls as q grows: ends of intervals and extremes are mapped one to one.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "math/random.h"
#include "rays/ray_caster.h"
#include "run/sensor_estimates.h"
#include "transport/glare.h"

namespace stilb::run {

/// What the eyes of all sensors of type "ugr" see of the lamps, found once for a run.
class GlareViews {
  public:
    /// `replicates`: the largest number of the run's.
    GlareViews(const Scene& scene, const rays::RayCaster& caster, std::span<const Sensor> sensors,
               std::size_t replicates, math::RandomKey key);

    /// Makes the illuminances of sensors that rate glare into ratings, with the errors of E, Ed and G. A
    /// rating is 0 where the eye sees no lamp. Where the background may be 0, it has no upper end, and the
    /// value is NaN where the background is not above 0. `estimates`: of all sensors.
    void rate(std::span<SensorEstimates> estimates, double confidence) const;

    /// Warns of sources for which the rating was not made.
    std::vector<std::string> warnings(const Scene& scene, std::span<const Sensor> sensors) const;

  private:
    std::vector<std::vector<transport::Glare>> views_;  ///< of each sensor; none of those of other types
};

}  // namespace stilb::run
