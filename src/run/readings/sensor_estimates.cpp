#include "run/readings/sensor_estimates.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "statistics/combination.h"

namespace stilb::run {
namespace {

using statistics::GridSummary;

/// Widens a summary by the error of the patches.
void include_bias(const statistics::BiasBounds& bias, std::span<const statistics::Estimate> readings,
                  GridSummary& summary) {
    const auto [least, most] = std::ranges::minmax_element(readings, {}, &statistics::Estimate::value);
    const double of_least = bias.of_readings[static_cast<std::size_t>(least - readings.begin())];
    const double of_most = bias.of_readings[static_cast<std::size_t>(most - readings.begin())];
    // Of both quantities, in units of the denominator.
    const auto of_quotient = [&](double quotient, double of_denominator, double denominator) {
        return (of_least + quotient * of_denominator) / denominator;
    };
    summary.uniformity =
        widened(summary.uniformity, of_quotient(summary.uniformity.value, bias.of_mean, summary.mean.value));
    summary.diversity =
        widened(summary.diversity, of_quotient(summary.diversity.value, of_most, summary.maximum.value));
    summary.mean = widened(summary.mean, bias.of_mean);
    summary.minimum = widened(summary.minimum, of_least);
    summary.maximum = widened(summary.maximum, of_most);
}

SensorEstimates estimates_of_meter(const Campaign& campaign, const Sensor& sensor, std::size_t first,
                                   double confidence, ChannelWeights weights) {
    SensorEstimates all{campaign.estimates(sensor, first, confidence, weights), {}};
    all.summary = summary_of(all.readings, confidence);
    return all;
}

statistics::Quantity quantity_of(const Operand& operand, const SensorEstimates& from) {
    const statistics::ReplicateTable table{from.readings.replicate_means, from.readings.readings.size()};
    if (operand.statistic) return {from.summary[*operand.statistic], residuals_of(table, *operand.statistic)};
    const std::size_t reading = operand.reading.value_or(0);
    return {from.readings.readings[reading], residuals_of_reading(table, reading)};
}

/// `all`: of the sensors, those with readings at least.
SensorEstimates estimates_of_derived(const Derived& derived, std::span<const Sensor> sensors,
                                     std::span<const SensorEstimates> all, double confidence) {
    std::vector<statistics::Quantity> quantities;
    std::vector<double> values;
    for (const Operand& operand : derived.formula.operands()) {
        const Sensor* const sensor = find_sensor(sensors, operand.sensor);
        quantities.push_back(quantity_of(operand, all[static_cast<std::size_t>(sensor - sensors.data())]));
        values.push_back(quantities.back().estimate.value);
    }
    const Expression::Value formula = derived.formula.at(values);
    statistics::Combination combination =
        statistics::combine(formula.value, formula.slopes, quantities, confidence);
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    constexpr statistics::Estimate undefined{none, none, none, none};
    const statistics::Estimate& value = combination.estimate;
    SensorEstimates result{{}, {value, value, value, undefined, undefined}};
    result.readings.readings = {value};
    result.readings.replicate_means = std::move(combination.of_replicates);
    return result;
}

}  // namespace

GridSummary summary_of(const Campaign::Estimates& estimates, double confidence) {
    GridSummary summary =
        statistics::summarize_grid({estimates.replicate_means, estimates.readings.size(), estimates.columns},
                                   confidence, estimates.rare_light);
    if (estimates.bias) include_bias(*estimates.bias, estimates.readings, summary);
    return summary;
}

std::vector<SensorEstimates> estimate_all(const Campaign& campaign, std::span<const Sensor> sensors,
                                          double confidence, ChannelWeights weights) {
    std::vector<SensorEstimates> all(sensors.size());
    std::size_t first = 0;
    for (std::size_t s = 0; s < sensors.size(); ++s) {
        if (sensors[s].size() > 0)
            all[s] = estimates_of_meter(campaign, sensors[s], first, confidence, weights);
        first += sensors[s].size();
    }
    for (std::size_t s = 0; s < sensors.size(); ++s) {
        if (const Derived* derived = sensors[s].derived())
            all[s] = estimates_of_derived(*derived, sensors, all, confidence);
    }
    return all;
}

double attained_error_of_means(std::span<const Sensor> sensors, std::span<const SensorEstimates> estimates) {
    double worst = 0;
    for (std::size_t s = 0; s < sensors.size(); ++s) {
        if (sensors[s].size() == 0) continue;
        const GridSummary& summary = estimates[s].summary;
        const double least = statistics::dark_level(std::span(&summary.mean, 1));
        worst =
            std::max({worst, relative_half_width(summary.mean), relative_half_width(summary.minimum, least)});
    }
    return worst;
}

}  // namespace stilb::run
