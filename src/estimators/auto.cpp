// Method auto: local estimation balanced with path tracing (local/local_estimation.cpp) or, for few readings,
// path tracing alone (path/path.cpp), whichever has less variance for the same work. Light paths pay where
// many readings share them, and where path tracing finds light rarely.
//
// Both are unbiased, and the choice depends on the samples of a pilot with random keys of its own: the result
// is unbiased, too.

#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "estimators/estimator_list.h"
#include "estimators/limits.h"

namespace stilb::estimators {
namespace {

/// With more readings light paths always pay (docs/performance.md).
constexpr std::size_t kMostReadings = 64;
/// The same for all seeds, so that a scene is measured by one method, and a number of paths means the same.
constexpr math::RandomKey kPilotKey{0x5ee0f7e57a11ed00};
/// Independent parts of a pilot, for its variances.
constexpr std::size_t kPilots = 16;

/// The readings of a pilot: of each part, the mean over its samples.
struct Pilot {
    std::vector<std::vector<double>> parts;
    double cost = 0;  ///< of each part
};

/// The samples of a part of this cost, at least as many as the method makes together.
std::uint64_t samples_for(double cost, const Estimator& method) {
    const std::uint64_t granularity = method.batch_granularity();
    const double granules = cost / (method.cost_per_sample() * static_cast<double>(granularity));
    return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(granules)) * granularity;
}

Pilot run_pilot(const Estimator& method, std::size_t readings, double cost, math::RandomKey key) {
    const std::uint64_t samples = samples_for(cost, method);
    Pilot pilot{std::vector<std::vector<double>>(kPilots),
                static_cast<double>(samples) * method.cost_per_sample()};
    parallel_for(kPilots, [&](std::size_t part) {
        ReadingSums sums(readings);
        method.run_batch({key.derived(part), 0, samples}, sums);
        for (std::size_t j = 0; j < readings; ++j) {
            const Rgb mean = method.known_part()[j] + sums.sum[j] * (1 / static_cast<double>(samples));
            pilot.parts[part].push_back(mean.luminance());
        }
    });
    return pilot;
}

/// The variance of the parts' means of a reading, and their mean.
struct Moments {
    double mean = 0, variance = 0;
};
Moments moments_of(const Pilot& pilot, std::size_t reading) {
    Moments moments;
    for (const auto& part : pilot.parts) moments.mean += part[reading] / kPilots;
    for (const auto& part : pilot.parts) {
        const double deviation = part[reading] - moments.mean;
        moments.variance += deviation * deviation / (kPilots - 1);
    }
    return moments;
}

/// Whether path tracing has less variance for the same work, over all readings, relative to their values.
bool path_pays(const Pilot& path, const Pilot& balanced, std::span<const double> weights) {
    double of_path = 0, of_balanced = 0;
    for (std::size_t j = 0; j < path.parts.front().size(); ++j) {
        const Moments a = moments_of(path, j), b = moments_of(balanced, j);
        // Where one of them has found nothing, its variance says nothing.
        if (!(a.mean > 0)) return false;
        const double value = std::max(a.mean, b.mean), weight = weights.empty() ? 1 : weights[j];
        of_path += weight * a.variance / (value * value);
        of_balanced += weight * b.variance / (value * value);
    }
    return of_path * path.cost < of_balanced * balanced.cost;
}

}  // namespace

std::unique_ptr<Estimator> make_auto(const Problem& problem) {
    std::unique_ptr<Estimator> balanced = make_balanced(problem);
    const std::size_t readings = problem.measurands.size();
    if (problem.camera || readings == 0 || readings > kMostReadings ||
        has_light_for_light_paths_only(problem.scene))
        return balanced;
    std::unique_ptr<Estimator> path = make_path(problem);
    const double cost = balanced->cost_per_sample() * static_cast<double>(balanced->batch_granularity());
    const Pilot of_path = run_pilot(*path, readings, cost, kPilotKey.derived(0));
    const Pilot of_balanced = run_pilot(*balanced, readings, cost, kPilotKey.derived(1));
    return path_pays(of_path, of_balanced, problem.weights) ? std::move(path) : std::move(balanced);
}

}  // namespace stilb::estimators
