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
#include "run/glare/daylight_glare.h"
#include "run/readings/sensor_estimates.h"
#include "transport/glare/glare.h"

namespace stilb::run {

/// The sources of glare that the eyes of all sensors see. They are found once for a run.
class GlareViews {
  public:
    /// `replicates`: the largest number of the run's. Throws Cancelled where the monitor ends the run.
    GlareViews(std::span<const Sensor> sensors, const PictureSetting& setting, std::size_t replicates,
               math::RandomKey key);

    /// Makes the illuminances of sensors that rate glare into ratings. The intervals of UGR contain the
    /// errors of E, Ed and G; a rating is 0 where the eye sees no lamp that counts. Where the background may
    /// be 0, it has no upper end, and the value is NaN where the background is not above 0. `complete` is set
    /// where an eye sees sources for which UGR was not made. `estimates`: of all sensors.
    void rate(std::span<SensorEstimates> estimates, double confidence) const;

    /// Warns of sources and views for which the ratings were not made. `illuminances`: the estimates of all
    /// sensors before rate().
    std::vector<std::string> warnings(const Scene& scene, std::span<const Sensor> sensors,
                                      std::span<const SensorEstimates> illuminances) const;

    /// Why a requirement of a sensor is unsure. `ratings`: its estimates after rate().
    std::string reason_of_doubt(std::size_t sensor, const SensorEstimates& ratings, const Scene& scene) const;

    /// What the views of a sensor that rates glare see; none of other sensors. `illuminances`: its estimates
    /// before rate().
    std::vector<GlareView> described_views(std::size_t sensor, const SensorEstimates& illuminances,
                                           const Scene& scene) const;

  private:
    // Of each sensor; none of those of other types.
    std::vector<std::vector<transport::Glare>> views_;
    std::vector<std::vector<DaylightView>> daylight_views_;
};

}  // namespace stilb::run
