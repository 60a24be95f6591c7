#include "papers/estimate_series.h"

namespace stilb::papers {

namespace {

std::vector<double> collect(std::span<const statistics::Estimate> estimates,
                            double statistics::Estimate::*part) {
    std::vector<double> numbers;
    for (const statistics::Estimate& estimate : estimates) numbers.push_back(estimate.*part);
    return numbers;
}

}  // namespace

std::vector<statistics::Estimate> estimates_of(const SensorResult& result) {
    std::vector<statistics::Estimate> estimates;
    for (const Reading& reading : result.readings) estimates.push_back(reading.estimate);
    return estimates;
}

statistics::Estimate scaled(const statistics::Estimate& estimate, double factor) {
    return {factor * estimate.value, factor * estimate.standard_error, factor * estimate.lower,
            factor * estimate.upper};
}

Series series_of(const std::string& name, const std::vector<double>& x,
                 std::span<const statistics::Estimate> estimates) {
    return {name, x, collect(estimates, &statistics::Estimate::value),
            collect(estimates, &statistics::Estimate::lower),
            collect(estimates, &statistics::Estimate::upper)};
}

void add_columns(std::vector<io::Column>& columns, const std::string& name, const std::string& unit,
                 std::span<const statistics::Estimate> estimates) {
    columns.push_back({name + "_" + unit, collect(estimates, &statistics::Estimate::value)});
    columns.push_back(
        {name + "_standard_error_" + unit, collect(estimates, &statistics::Estimate::standard_error)});
    columns.push_back({name + "_lower_" + unit, collect(estimates, &statistics::Estimate::lower)});
    columns.push_back({name + "_upper_" + unit, collect(estimates, &statistics::Estimate::upper)});
}

namespace {

std::vector<statistics::Estimate> measure(const Scene& scene, const Sensor& sensor, const RunOptions& options,
                                          ProgressSink* progress) {
    return estimates_of(run::measure(scene, {&sensor, 1}, options, progress).sensors[0]);
}

}  // namespace

std::vector<statistics::Estimate> multiply_reflected_cd_m2(const Scene& scene, const Sensor& sensor,
                                                           const RunOptions& options, int runs,
                                                           ProgressSink* progress) {
    // The first reflection may be many times as bright as all others, and it is sampled. It is sampled
    // alike in two runs of one seed, and so leaves no noise in their difference. If it were not, intervals
    // would be wide but right: they come from the differences.
    std::vector<double> differences;
    for (int i = 0; i < runs; ++i) {
        RunOptions all = options, first = options;
        all.seed = first.seed = options.seed + static_cast<std::uint64_t>(i);
        all.bounces.reset();
        first.bounces = 1;
        const std::vector<statistics::Estimate> total = measure(scene, sensor, all, progress);
        const std::vector<statistics::Estimate> once = measure(scene, sensor, first, progress);
        for (std::size_t j = 0; j < total.size(); ++j) differences.push_back(total[j].value - once[j].value);
    }
    return statistics::estimate_readings({differences, sensor.size()});
}

}  // namespace stilb::papers
