#include "patches/visibility/viewpoint.h"

#include <algorithm>
#include <cmath>

namespace stilb::patches {
namespace {

/// As RayCaster's offset, for positions relative to the centre.
constexpr double kRelativeLift = 0x1p-19;
constexpr double kEdgeMargin = 8;

double largest_coordinate(const Vec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

double longest_edge_m(const Patches& patches, std::uint32_t patch) {
    const auto& [a, b, c] = patches.corners[patch];
    const Vec3 u(patches.vertices[a]), v(patches.vertices[b]), w(patches.vertices[c]);
    return std::max({length(v - u), length(w - v), length(u - w)});
}

}  // namespace

Viewpoint viewpoint_on(const Patches& patches, std::uint32_t side, const math::Barycentric& place) {
    const std::uint32_t patch = patches.patch_of(side);
    const Vec3 wanted = patches.position(patch, place), middle = patches.middle(patch);
    const double longest_m = longest_edge_m(patches, patch);
    const double lift_m = kRelativeLift * std::max(largest_coordinate(wanted - patches.center), longest_m);
    // A third of the least height is how far the middle is from an edge.
    const double middle_to_edge_m = 2 * patches.areas_m2[patch] / longest_m / 3;
    const double towards_middle = std::min(kEdgeMargin * lift_m / middle_to_edge_m, 1.0);
    const Vec3 normal = patches.normal_of(side);
    return {wanted + towards_middle * (middle - wanted) + lift_m * normal, Frame::around(normal)};
}

}  // namespace stilb::patches
