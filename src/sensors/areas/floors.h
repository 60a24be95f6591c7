// The floors of rooms, found in the scene.
#pragma once

#include <span>
#include <vector>

#include "rays/ray_caster.h"
#include "scene/scene.h"
#include "sensors/areas/plan_pieces.h"

namespace stilb::sensors {

/// Walls are at least so thick: they part rooms without a margin, too.
inline constexpr double kLeastMargin_m = 1e-3;
inline constexpr double kLeastFloor_m2 = 1;

/// A horizontal surface with rooms on it.
struct FloorSurface {
    double z = 0;
    double height_m = 0;   ///< of the free space above: the median of the places where one can stand
    double section_m = 0;  ///< the height above it at which it is cut
    Piece surface;
    Paths walls;                ///< lines: what the cut meets
    std::vector<Piece> floors;  ///< the parts between walls that are floors
};

/// Those of all rooms, from the lowest up, or of those whose floors belong to the objects. What a floor is:
/// working_planes.h.
std::vector<FloorSurface> find_floors(const Scene& scene, const rays::RayCaster& caster,
                                      std::span<const ObjectId> floors_of = {});

}  // namespace stilb::sensors
