// Measuring points on the faces of objects: rasters on walls, ceilings and floors.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "geometry/shape.h"
#include "sensors/areas/area.h"

namespace stilb::sensors {

/// Triangles that lie in one plane and share edges.
struct PlaneFace {
    std::vector<std::array<Vec3, 3>> triangles;
    Vec3 normal;  ///< unit, on the measured side
    double area_m2 = 0;
};

/// The plane faces of a mesh, measured inside where they close a space, else on their front.
std::vector<PlaneFace> plane_faces(const Mesh& mesh);

/// Walls are within 45 degrees of the vertical; floors face upwards, ceilings downwards.
bool is_of_part(const PlaneFace& face, SurfacePart part);

/// Makes the points of an area: on each face a raster along its longest edge, with cells as near to the same
/// size on all faces as whole numbers allow. By default the spacing is that of EN 12464-1 for the largest
/// face. Faces narrower than half the spacing have points only as far as their share of the area asks for.
/// At least one face. A fault where there would be too many points.
std::optional<Fault> place_on(std::span<const PlaneFace> faces, Area& area);

}  // namespace stilb::sensors
