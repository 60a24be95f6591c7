#include "run/readings/paired.h"

#include <vector>

namespace stilb::run {
namespace {

std::vector<double> residuals_of(const SensorResult& sensor, Statistic statistic) {
    return statistics::residuals_of({sensor.replicate_means, sensor.readings.size()}, statistic);
}

}  // namespace

std::optional<statistics::Estimate> paired_difference(const SensorResult& after, const SensorResult& before,
                                                      Statistic statistic, double confidence) {
    if (after.readings.size() != before.readings.size() ||
        after.replicate_means.size() != before.replicate_means.size())
        return std::nullopt;
    const std::vector<double> residuals = residuals_of(before, statistic);
    std::vector<double> differences = residuals_of(after, statistic);
    const double difference = after.summary[statistic].value - before.summary[statistic].value;
    for (std::size_t r = 0; r < differences.size(); ++r) differences[r] += difference - residuals[r];
    return statistics::estimate_from_replicates(differences, confidence);
}

}  // namespace stilb::run
