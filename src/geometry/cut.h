// Cuts large triangles into smaller ones, for ray queries in single precision: the errors of a hit, and the
// distance by which rays start off a surface, grow with the triangle (docs/ray-queries.md).
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/shape.h"

namespace stilb::geometry {

/// The vertices of a mesh first, then those of the cuts.
struct CutTriangles {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> parents;  ///< the triangle of the mesh that each is a part of
};

/// Halves the edges that are longer than `size_m` and than their distance from `center`, until there are
/// none. Whether and where an edge is cut depends on its end points alone, so that no gap opens between
/// triangles with a common edge, even of different meshes. A mesh without such edges keeps its triangles, in
/// their order.
CutTriangles cut_large_triangles(const Mesh& mesh, const Vec3& center, double size_m);
/// Whether it would cut any triangle.
bool has_large_triangles(const Mesh& mesh, const Vec3& center, double size_m);

}  // namespace stilb::geometry
