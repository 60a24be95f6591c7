#include "statistics/rare.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace stilb::statistics {

LargestContributions largest_contributions(std::span<double> of_replicates) {
    const auto middle = of_replicates.begin() + static_cast<std::ptrdiff_t>(of_replicates.size() / 2);
    std::nth_element(of_replicates.begin(), middle, of_replicates.end());
    return {*std::max_element(middle, of_replicates.end()), *middle};
}

double rare_light(const LargestContributions& largest, std::uint64_t samples) {
    constexpr double kMissing = 4;
    return kMissing * (largest.overall - largest.typical) / static_cast<double>(samples);
}

bool rests_on_few_samples(const Estimate& reading, const LargestContributions& largest,
                          std::uint64_t samples) {
    constexpr double kOutstanding = 4, kMostOfReading = 0.02, kMostOfError = 0.7;
    if (largest.overall <= kOutstanding * largest.typical) return false;
    const double count = static_cast<double>(samples);
    const double excess = (largest.overall - largest.typical) / count;
    return excess > std::min(kMostOfReading, 1 / std::sqrt(count)) * reading.value ||
           excess > kMostOfError * reading.standard_error;
}

}  // namespace stilb::statistics
