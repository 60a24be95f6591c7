// Adds triangles to patches, object by object.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "patches/patches.h"
#include "patches/refinement.h"

namespace stilb::patches {

/// Keeps a reference to the patches, whose centre is set.
class PatchCollector {
  public:
    explicit PatchCollector(Patches& patches) : patches_(patches) {}

    /// Adds the next object. `materials`: one, or those of the parents. Triangles without area are left out:
    /// returns the numbers of the others.
    std::vector<std::uint32_t> add(const RefinedMesh& fine, std::span<const MaterialId> materials);

  private:
    bool add_triangle(const Mesh& mesh, const Triangle& t, MaterialId material);

    Patches& patches_;
    std::vector<Triangle> triangles_;  ///< of the object, by its own vertices
    std::vector<Vec3> normals_;
};

}  // namespace stilb::patches
