// The nodes of a glTF scene with their places, and the triangles of their meshes.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "geometry/shape.h"
#include "geometry/transform.h"
#include "io/import/gltf/gltf_file.h"
#include "io/text/grouped_warnings.h"

namespace stilb::io::gltf {

/// Whether the coordinates are numbers that scene files allow.
bool is_placeable(const Vec3& position);

struct PlacedNode {
    const tinygltf::Node* node = nullptr;
    std::string part;  ///< "nodes[3]", for messages
    geometry::Transform to_world;
    int mesh = -1;
    /// Whether it stands for one more copy of the node's mesh alone (EXT_mesh_gpu_instancing).
    bool is_copy = false;
};

/// The nodes of the file's scene, parents first. `root` is applied to all of them. Throws for nodes that are
/// their own descendants, have two parents, or numbers that are not finite.
std::vector<PlacedNode> placed_nodes(const File& file, const geometry::Transform& root);

/// A primitive of a mesh where a node places it.
struct PlacedPrimitive {
    std::size_t node = 0;  ///< index of the placed node
    int material = -1;
    Mesh mesh;
    /// Texture coordinates of the vertices by their sets; sets that the material does not use are empty.
    std::array<std::vector<std::array<double, 2>>, 2> uv{};
};

/// What becomes of a large mesh that several nodes have.
enum class Repeats { copies, instances };

struct PlacedMeshes {
    std::vector<PlacedPrimitive> primitives;
    /// Nodes that are instances of an earlier node, whose primitives stand for theirs.
    std::map<std::size_t, std::size_t> first_of_instance;
};

/// The triangles of all nodes. Warns of points, lines, and what is left out.
PlacedMeshes placed_meshes(const File& file, const std::vector<PlacedNode>& nodes, Repeats repeats,
                           GroupedWarnings& warnings);

}  // namespace stilb::io::gltf
