#include "papers/multiply_reflected.h"

#include "papers/estimate_series.h"

namespace stilb::papers {
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
