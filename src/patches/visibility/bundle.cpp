#include "patches/visibility/bundle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace stilb::patches {
namespace {

/// Room before and behind the patches, for rounding.
constexpr double kRelativeMargin = 0x1p-18;

double half_extent_along(const Vec3& axis, const Vec3& half) {
    return std::abs(axis.x) * half.x + std::abs(axis.y) * half.y + std::abs(axis.z) * half.z;
}

int line_count(double extent_m, double spacing_m) {
    const double count = std::ceil(extent_m / spacing_m);
    if (spacing_m > 0 && count <= kMostLines) return static_cast<int>(count);
    throw InputError(
        fmt::format("the rays of a bundle are {} m apart: {} m must be covered by {} of them at most. Take "
                    "{:.2g} m or more.",
                    spacing_m, extent_m, kMostLines, extent_m / kMostLines));
}

}  // namespace

void CrossedLines::clear() {
    origins_.clear();
    first_crossing_.resize(1);
    sides_.clear();
    distances_m_.clear();
}

void CrossedLines::add(const Vec3& origin, std::span<const Crossing> crossings) {
    if (crossings.empty()) return;
    origins_.push_back(origin);
    for (const Crossing& crossing : crossings) {
        sides_.push_back(crossing.side);
        distances_m_.push_back(crossing.distance);
    }
    first_crossing_.push_back(sides_.size());
}

LineGrid::LineGrid(const Bounds& bounds, const Bundle& bundle) {
    if (bounds.is_empty()) return;
    const auto& [u, v, w] = bundle.frame;
    const Vec3 middle = 0.5 * (bounds.min + bounds.max), half = bounds.max - middle;
    const double half_u = half_extent_along(u, half), half_v = half_extent_along(v, half);
    const double half_w = half_extent_along(w, half) + kRelativeMargin * bounds.half_extent();
    width = line_count(2 * half_u, bundle.spacing_m);
    height = line_count(2 * half_v, bundle.spacing_m);
    step_x = bundle.spacing_m * u;
    step_y = bundle.spacing_m * v;
    first =
        middle - half_u * u - half_v * v - half_w * w + bundle.offset[0] * step_x + bundle.offset[1] * step_y;
    depth_m = 2 * half_w;
}

}  // namespace stilb::patches
