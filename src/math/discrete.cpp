#include "math/discrete.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stilb::math {

DiscreteDistribution::DiscreteDistribution(std::span<const double> weights) : cumulative_(weights.size()) {
    std::partial_sum(weights.begin(), weights.end(), cumulative_.begin());
}

DiscreteChoice choose_by_sums(std::span<const double> sums, double u) {
    if (sums.size() == 1) return {0, 1, u};
    const double total = sums.back(), target = u * total;
    // upper_bound passes over entries of weight zero: it finds the first sum that is greater.
    auto found = std::upper_bound(sums.begin(), sums.end(), target);
    if (found == sums.end()) found = std::lower_bound(sums.begin(), sums.end(), total);
    const double below = found == sums.begin() ? 0 : *(found - 1);
    const double weight = *found - below;
    const double remainder = std::clamp((target - below) / weight, 0.0, std::nextafter(1.0, 0.0));
    return {static_cast<std::size_t>(found - sums.begin()), weight / total, remainder};
}

double DiscreteDistribution::probability(std::size_t index) const {
    return (cumulative_[index] - (index == 0 ? 0 : cumulative_[index - 1])) / total();
}

}  // namespace stilb::math
