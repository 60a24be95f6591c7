// Meshes with their fronts outside.
#pragma once

#include <cstddef>

#include "geometry/shape.h"

namespace stilb::fit {

struct OutwardMesh {
    Mesh mesh;
    std::size_t turned = 0;      ///< triangles that were turned for it
    std::size_t open_edges = 0;  ///< edges in which not two triangles meet
    std::size_t parts = 0;       ///< that hang together along edges of two triangles
};

/// Triangles that meet in an edge, two of them, are given the same side; then each part is turned so that the
/// volume that it encloses (open ones: with a lid towards the middle of the part) is above 0. Parts that are
/// one-sided have no outside, and keep some edges with different sides.
OutwardMesh outward(const Mesh& mesh);

}  // namespace stilb::fit
