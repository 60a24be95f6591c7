#include "math/morton.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/vec.h"

namespace stilb::math {
namespace {

/// The lowest 21 bits, moved to every third bit.
std::uint64_t spread_bits(std::uint64_t x) {
    x = (x | x << 32) & 0x1f00000000ffffull;
    x = (x | x << 16) & 0x1f0000ff0000ffull;
    x = (x | x << 8) & 0x100f00f00f00f00full;
    x = (x | x << 4) & 0x10c30c30c30c30c3ull;
    return (x | x << 2) & 0x1249249249249249ull;
}

}  // namespace

std::vector<std::uint64_t> morton_codes(std::span<const Vec3> points) {
    Bounds bounds;
    for (const Vec3& point : points) bounds.include(point);
    const Vec3 extent = bounds.max - bounds.min;
    const double longest = std::max({extent.x, extent.y, extent.z, std::numeric_limits<double>::min()});
    std::vector<std::uint64_t> codes;
    codes.reserve(points.size());
    for (const Vec3& point : points) {
        const Vec3 q = (point - bounds.min) * (0x1fffff / longest);
        codes.push_back(spread_bits(static_cast<std::uint64_t>(q.x)) |
                        spread_bits(static_cast<std::uint64_t>(q.y)) << 1 |
                        spread_bits(static_cast<std::uint64_t>(q.z)) << 2);
    }
    return codes;
}

std::vector<std::uint32_t> morton_order(std::span<const Vec3> points) {
    const std::vector<std::uint64_t> codes = morton_codes(points);
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return codes[i]; });
    return order;
}

}  // namespace stilb::math
