#include "statistics/stopping.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stilb::statistics {

double attained_error(std::span<const Estimate> readings, double share) {
    std::vector<double> half_widths(readings.size());
    std::transform(readings.begin(), readings.end(), half_widths.begin(), relative_half_width);
    return attained_error_of(std::move(half_widths), share);
}

double attained_error_of(std::vector<double> half_widths, double share) {
    if (half_widths.empty()) return 0;
    // The small number keeps 0.95 * 20 from counting as more than 19.
    const double needed = std::ceil(share * static_cast<double>(half_widths.size()) - 1e-9);
    const auto last =
        half_widths.begin() + std::max<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(needed) - 1, 0);
    std::nth_element(half_widths.begin(), last, half_widths.end());
    return *last;
}

double attained_error(std::span<const Estimate> readings, std::span<const double> weights, double share) {
    std::vector<std::pair<double, double>> half_widths;  // with their weights
    double needed = 0;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        half_widths.emplace_back(relative_half_width(readings[i]), weights[i]);
        needed += share * weights[i];
    }
    std::sort(half_widths.begin(), half_widths.end());
    double reached = 0;
    for (const auto& [half_width, weight] : half_widths) {
        reached += weight;
        if (reached >= needed) return half_width;
    }
    return half_widths.empty() ? 0 : half_widths.back().first;
}

std::uint64_t next_look(std::uint64_t done, std::uint64_t first) {
    std::uint64_t look = first;
    while (2 * look <= done) look *= 2;
    if (done < look) return look;
    const std::uint64_t half_more = look + look / 2;
    return done < half_more ? half_more : 2 * look;
}

}  // namespace stilb::statistics
