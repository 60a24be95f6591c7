// Orientation of meshes: all fronts outside.
#pragma once

#include <cstddef>

#include "geometry/shape.h"

namespace stilb::fit {

struct OutwardMesh {
    Mesh mesh;
    std::size_t turned = 0;      ///< triangles that were reversed
    std::size_t open_edges = 0;  ///< edges that do not belong to exactly two triangles
    std::size_t parts = 0;       ///< connected along edges of two triangles
};

/// Neighbouring triangles (two at an edge) are given the same orientation; then each part is oriented so that
/// the volume that it encloses (open ones: with a lid towards the middle of the part) is above 0. Parts that
/// are not orientable have no outside, and keep some edges with different sides.
OutwardMesh outward(const Mesh& mesh);

}  // namespace stilb::fit
