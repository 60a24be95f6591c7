#include "run/paces.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace stilb::run {
namespace {

/// One of so many samples at least.
constexpr double kMostEvery = 16;

/// The squares of the relative standard deviations of all replicates but one, as the error that ends a run
/// is relative (statistics::attained_error()); 0 where there is no light. `readings`: of each sensor.
std::vector<double> relative_variances(std::size_t left_out, const statistics::ReplicateTable& table,
                                       std::span<const std::size_t> readings) {
    // The sums are over differences from one of the replicates: equal values have the variance 0, without
    // rounding errors.
    const std::span<const double> first = table.row(left_out == 0 ? 1 : 0);
    std::vector<double> sums(table.readings), squares(table.readings);
    for (std::size_t r = 0; r < table.replicates(); ++r) {
        if (r == left_out) continue;
        const std::span<const double> row = table.row(r);
        for (std::size_t j = 0; j < row.size(); ++j) {
            const double difference = row[j] - first[j];
            sums[j] += difference, squares[j] += difference * difference;
        }
    }
    const auto others = static_cast<double>(table.replicates() - 1);
    std::vector<double> means(table.readings), variances(table.readings);
    for (std::size_t j = 0; j < table.readings; ++j) means[j] = first[j] + sums[j] / others;
    std::size_t begin = 0;
    for (const std::size_t count : readings) {
        const double dark = statistics::dark_level(std::span(means).subspan(begin, count));
        for (std::size_t j = begin; j < begin + count; ++j) {
            const double shift = sums[j] / others, value = std::max(means[j], dark);
            if (value > 0)
                variances[j] = std::max(0.0, squares[j] / others - shift * shift) / (value * value);
        }
        begin += count;
    }
    return variances;
}

/// The means over the packets.
std::vector<double> means_of_packets(std::span<const double> values, std::span<const std::uint32_t> packets) {
    std::vector<double> sums(*std::ranges::max_element(packets) + std::size_t{1}), counts(sums.size());
    for (std::size_t j = 0; j < values.size(); ++j) sums[packets[j]] += values[j], ++counts[packets[j]];
    for (std::size_t p = 0; p < sums.size(); ++p) sums[p] /= std::max(1.0, counts[p]);
    return sums;
}

/// The variance that decides when a run ends: in the worst sensor, that which the share of readings that must
/// meet the target does not exceed.
double deciding_variance(std::span<const double> of_packets, std::span<const std::uint32_t> packets,
                         std::span<const std::size_t> readings) {
    double deciding = 0;
    std::size_t first = 0;
    for (const std::size_t count : readings) {
        std::vector<double> variances;
        for (std::size_t j = first; j < first + count; ++j) variances.push_back(of_packets[packets[j]]);
        deciding = std::max(deciding, statistics::attained_error_of(variances));
        first += count;
    }
    return deciding;
}

}  // namespace

std::vector<estimators::Pace> paces_of(std::size_t replicate, const statistics::ReplicateTable& table,
                                       std::span<const std::uint32_t> packets,
                                       std::span<const std::size_t> readings, std::uint64_t samples,
                                       double reserve) {
    const std::vector<double> variances =
        means_of_packets(relative_variances(replicate, table, readings), packets);
    const double deciding = deciding_variance(variances, packets, readings);
    std::vector<estimators::Pace> paces;
    for (const double variance : variances) {
        // Without a spread, light may be missing.
        const double every = variance > 0 ? std::clamp(deciding / (reserve * variance), 1.0, kMostEvery) : 1;
        paces.push_back({samples, std::bit_floor(static_cast<std::uint64_t>(every)), 0});
    }
    return paces;
}

}  // namespace stilb::run
