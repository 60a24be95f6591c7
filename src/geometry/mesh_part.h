// Parts of meshes as meshes of their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/shape.h"

namespace stilb::geometry {

/// The triangles of these numbers, in this order, with the vertices and normals that they use. Positions stay
/// the same bit by bit, so that parts with a common edge leave no gap for rays.
Mesh part_of(const Mesh& mesh, std::span<const std::uint32_t> triangles);
/// The same of several parts. In time that does not grow with their number times the size of the mesh.
std::vector<Mesh> parts_of(const Mesh& mesh, std::span<const std::vector<std::uint32_t>> parts);

/// The numbers below `count` that are not among these, which increase.
std::vector<std::uint32_t> others(std::size_t count, std::span<const std::uint32_t> numbers);

}  // namespace stilb::geometry
