// Rays that go through the edge between two patches meet both of them, though they cross one surface.
#pragma once

#include <vector>

#include "base/bounds.h"
#include "base/vec.h"
#include "patches/patches.h"
#include "patches/visibility/patch_caster.h"

namespace stilb::patches {

/// Keeps one crossing of those that are one and the same: where the next one has the same orientation (both
/// fronts or both backs) and lies no farther behind than 2^-19 of half the bounding box, as measured across
/// the patch. Left alone, the two patches would see each other, one from its wrong side. What is thicker
/// keeps both its sides, and so does everything closed, however thin, whose two sides are of different
/// orientation.
class CoincidentCrossings {
  public:
    /// For rays along a unit vector. Keeps a reference to the patches.
    CoincidentCrossings(const Patches& patches, const Bounds& bounds, const Vec3& direction);
    /// `crossings` are in the order of distances.
    void remove_from(std::vector<Crossing>& crossings) const;

  private:
    bool is_same(const Crossing& before, const Crossing& after) const;

    const Patches& patches_;
    Vec3 direction_;
    double tolerance_m_;
};

}  // namespace stilb::patches
