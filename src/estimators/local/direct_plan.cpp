#include "estimators/local/direct_plan.h"

#include <algorithm>
#include <cmath>

namespace stilb::estimators {
namespace {

/// The power of two that is nearest in ratio, from 1 to `most`.
std::uint64_t rounded(double paths, std::uint64_t most) {
    if (!(paths > 1)) return 1;
    const double exponent = std::min(std::round(std::log2(paths)), 62.0);
    return std::min(std::uint64_t{1} << static_cast<unsigned>(exponent), most);
}

}  // namespace

std::vector<std::uint64_t> plan_direct(std::span<const transport::Receiver> receivers,
                                       std::span<const transport::DirectLight::Remainder> remainders,
                                       std::span<const double> weights, const DirectPilot& pilot,
                                       const SplitPlans& plans, std::uint64_t most) {
    std::vector<double> values = pilot.direct;
    for (std::size_t j = 0; j < receivers.size(); ++j)
        values[receivers[j].reading()] += plans.of_receivers[j].indirect;
    // The variance of a light that is seen or not, unseen in all samples but one of four times as many.
    const double least = 0.25 / (pilot.samples + 1);
    std::vector<std::uint64_t> paths_per_sample;
    for (std::size_t t = 0; t < remainders.size(); ++t) {
        const std::size_t first = t * kPacketWidth;
        const auto tile =
            receivers.subspan(first, std::min<std::size_t>(kPacketWidth, receivers.size() - first));
        double variance = 0;
        for (std::size_t i = 0; i < tile.size(); ++i) {
            const std::uint32_t reading = tile[i].reading();
            const double value = values[reading];
            if (value > 0)
                variance += weights[reading] * (pilot.variances[first + i] / (value * value) + least);
        }
        const double cost = kDirectRayCost * remainders[t].rays(tile.size());
        // Minimises variance * paths + price * cost / paths.
        paths_per_sample.push_back(rounded(std::sqrt(cost * plans.variance_per_cost / variance), most));
    }
    return paths_per_sample;
}

}  // namespace stilb::estimators
