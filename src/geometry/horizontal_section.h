// Shapes as triangles for plans, and their horizontal sections.
#pragma once

#include <array>
#include <optional>

#include "geometry/shape.h"

namespace stilb::geometry {

/// A shape as triangles that are fine enough for a drawing; meshes as they are.
Mesh drawn_as_mesh(const Shape& shape);

/// Where the plane z = height cuts a triangle of a mesh.
std::optional<std::array<Vec3, 2>> cut_at(const Mesh& mesh, const Triangle& triangle, double height_m);

}  // namespace stilb::geometry
