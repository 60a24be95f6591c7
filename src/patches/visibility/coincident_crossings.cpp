#include "patches/visibility/coincident_crossings.h"

#include <algorithm>
#include <cmath>

namespace stilb::patches {
namespace {

constexpr double kRelativeTolerance = 0x1p-19;
/// Surfaces that are seen more edge-on than this cosine are crossed too seldom to matter.
constexpr double kLeastCosine = 1e-3;

}  // namespace

CoincidentCrossings::CoincidentCrossings(const Patches& patches, const Bounds& bounds, const Vec3& direction)
    : patches_(patches), direction_(direction), tolerance_m_(kRelativeTolerance * bounds.half_extent()) {}

void CoincidentCrossings::remove_from(std::vector<Crossing>& crossings) const {
    const auto same = [&](const Crossing& before, const Crossing& after) { return is_same(before, after); };
    crossings.erase(std::unique(crossings.begin(), crossings.end(), same), crossings.end());
}

bool CoincidentCrossings::is_same(const Crossing& before, const Crossing& after) const {
    const double gap_m = double{after.distance} - double{before.distance};
    // Looking for normals all over the patches takes time, and most are far apart.
    if (gap_m * kLeastCosine > tolerance_m_) return false;
    return patches_.is_front(before.side) == patches_.is_front(after.side) &&
           gap_m * std::abs(dot(direction_, patches_.normal_of(after.side))) <= tolerance_m_;
}

}  // namespace stilb::patches
