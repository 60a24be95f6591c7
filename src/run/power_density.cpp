#include "run/power_density.h"

#include <algorithm>
#include <limits>

#include "statistics/combination.h"

namespace stilb::run {

std::optional<PowerDensity> power_density(const scene::InstalledPower& power, std::span<const Sensor> sensors,
                                          std::span<const SensorEstimates> estimates, double confidence) {
    const double area_m2 = sensors::task_area_m2(sensors);
    if (!power.power_w || !(area_m2 > 0)) return std::nullopt;
    std::vector<statistics::Quantity> means;
    std::vector<double> areas_m2;
    double incident_lm = 0;
    for (std::size_t s = 0; s < sensors.size(); ++s) {
        const double own_m2 = sensors::task_area_m2({&sensors[s], 1});
        if (!(own_m2 > 0)) continue;
        const SensorEstimates& from = estimates[s];
        means.push_back(
            {from.summary.mean,
             statistics::residuals_of({from.readings.replicate_means, sensors[s].size()}, Statistic::mean)});
        areas_m2.push_back(own_m2);
        incident_lm += own_m2 * from.summary.mean.value;
    }
    // P / A over E / 100 lx, where A E is the sum of the areas' fluxes.
    const double value = 100 * *power.power_w / incident_lm;
    std::vector<double> slopes;
    for (const double own_m2 : areas_m2) slopes.push_back(-value * own_m2 / incident_lm);
    PowerDensity density{area_m2, *power.power_w / area_m2, {}};
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    density.w_m2_per_100_lx = incident_lm > 0 ? statistics::combine(value, slopes, means, confidence).estimate
                                              : statistics::Estimate{none, none, none, none};
    return density;
}

}  // namespace stilb::run
