// Surfaces that were probably meant to be closed.
#pragma once

#include <string>
#include <vector>

#include "checks/enclosures.h"
#include "geometry/mesh_topology.h"
#include "scene/scene.h"

namespace stilb::checks {

/// A sentence for each object with shells that are open but nearly enclose a space: light goes through their
/// holes. And one for emitters whose triangles do not all face the same side. `shells` are those of every
/// object.
std::vector<std::string> hole_warnings(const Scene& scene,
                                       const std::vector<geometry::ConnectedComponents>& shells);

// Surfaces that lie in one another.

/// Two triangles that lie over each other in one plane and do not look alike: rounding decides which of them
/// a ray meets.
struct Overlap {
    ObjectId first{}, second{};
    Vec3 position, normal;  ///< the middle of what they share; unit normal of the plane
};

/// Pairs of triangles in the same plane (to a few parts in a million of the scene's size) that share more
/// than a thousandth of the smaller one, and differ in material or emission. Ends after the first
/// kMostOverlaps.
std::vector<Overlap> find_overlaps(const Scene& scene);
inline constexpr std::size_t kMostOverlaps = 1000;

/// A sentence for each pair of objects that overlap where light comes: not for the bottom of a cabinet in the
/// floor.
std::vector<std::string> overlap_warnings(const Scene& scene, const rays::RayCaster& caster,
                                          const Enclosures& spaces);

}  // namespace stilb::checks
