// Shapes: what surfaces are made of. Plain values in metres, in world coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

#include "base/vec.h"

namespace stilb {

using Triangle = std::array<std::uint32_t, 3>;

/// Front: the side from which the vertices run counterclockwise. Every index is below vertices.size().
struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
};

/// The parallelogram corner + s edge_u + t edge_v, 0 <= s, t <= 1; its front is edge_u x edge_v.
struct Rectangle {
    Vec3 corner, edge_u, edge_v;
};

/// Axis-parallel; its front is the outside.
struct Box {
    Vec3 min, max;
};

/// Its front is the outside.
struct Sphere {
    Vec3 center;
    double radius = 1;
};

/// `normal` is a unit vector and points to the front.
struct Disk {
    Vec3 center, normal;
    double radius = 1;
};

using Shape = std::variant<Mesh, Rectangle, Box, Sphere, Disk>;

/// m2, one side.
double area_m2(const Shape& shape);
/// Two triangles with the rectangle's front.
Mesh triangulated(const Rectangle& rectangle);
/// Twelve triangles with the box's front.
Mesh triangulated(const Box& box);
/// The inscribed icosahedron with the sphere's front: twenty triangles, all vertices on the sphere.
Mesh inscribed_icosahedron(const Sphere& sphere);

}  // namespace stilb
