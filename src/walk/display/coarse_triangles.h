// Fewer triangles of large meshes, for pictures that move on machines that draw slowly.
#pragma once

#include <cstddef>
#include <vector>

#include "walk/display/display_mesh.h"

namespace stilb::walk {

struct CoarseTriangles {
    struct Part {
        std::size_t first = 0, count = 0;
    };
    std::vector<Triangle> triangles;  ///< of the mesh's own vertices, part by part
    std::vector<Part> parts;          ///< one for each part of the mesh
};

/// About `most` triangles with the shape of the mesh: parts with many triangles lose edges where that changes
/// their shape least, as long as it changes by less than 2 % of their extent [Garland, Heckbert 1997, by
/// meshoptimizer]. Empty where the mesh has no more triangles than that.
CoarseTriangles coarse_triangles(const DisplayMesh& mesh, std::size_t most);

}  // namespace stilb::walk
