#include "patches/bundle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace stilb {
namespace {

/// Room before and behind the patches, for rounding.
constexpr double kRelativeMargin = 0x1p-18;
constexpr double kRelativeCoincidence = 0x1p-19;
/// Surfaces that are seen more edge-on than this cosine are crossed too seldom to matter.
constexpr double kLeastCosine = 1e-3;

double largest_half_m(const Vec3& half) { return std::max({half.x, half.y, half.z}); }

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

Bounds bounds_of(const Patches& patches) {
    Bounds bounds;
    for (const Float3& vertex : patches.vertices) bounds.include(Vec3(vertex));
    return bounds;
}

LineGrid::LineGrid(const Bounds& bounds, const Bundle& bundle) {
    if (bounds.is_empty()) return;
    const auto& [u, v, w] = bundle.frame;
    const Vec3 middle = 0.5 * (bounds.min + bounds.max), half = bounds.max - middle;
    const double half_u = half_extent_along(u, half), half_v = half_extent_along(v, half);
    const double half_w = half_extent_along(w, half) + kRelativeMargin * largest_half_m(half);
    width = line_count(2 * half_u, bundle.spacing_m);
    height = line_count(2 * half_v, bundle.spacing_m);
    step_x = bundle.spacing_m * u;
    step_y = bundle.spacing_m * v;
    first =
        middle - half_u * u - half_v * v - half_w * w + bundle.offset[0] * step_x + bundle.offset[1] * step_y;
    depth_m = 2 * half_w;
}

CoincidentCrossings::CoincidentCrossings(const Patches& patches, const Bounds& bounds, const Vec3& direction)
    : patches_(patches),
      direction_(direction),
      tolerance_m_(kRelativeCoincidence * largest_half_m(0.5 * (bounds.max - bounds.min))) {}

void CoincidentCrossings::remove_from(std::vector<Crossing>& crossings) const {
    const auto same = [&](const Crossing& before, const Crossing& after) { return is_same(before, after); };
    const auto superfluous = std::ranges::unique(crossings, same);
    crossings.erase(superfluous.begin(), superfluous.end());
}

bool CoincidentCrossings::is_same(const Crossing& before, const Crossing& after) const {
    const double gap_m = double{after.distance} - double{before.distance};
    // Looking for normals all over the patches takes time, and most are far apart.
    if (gap_m * kLeastCosine > tolerance_m_) return false;
    return patches_.is_front(before.side) == patches_.is_front(after.side) &&
           gap_m * std::abs(dot(direction_, patches_.normal_of(after.side))) <= tolerance_m_;
}

}  // namespace stilb
