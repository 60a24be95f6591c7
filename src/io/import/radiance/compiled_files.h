// Compiled files of Radiance: octrees (oconv) and meshes (obj2mesh).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/import/radiance/primitives.h"

namespace stilb::io::radiance {

/// The scene of an octree: the names of its files, or, where it is frozen (oconv -f), its primitives.
struct Octree {
    std::vector<std::string> files;
    std::vector<Primitive> primitives;
};
/// Throws InputError with the name of the file.
Octree octree_of(std::string_view content, const std::string& name);

/// Adds the triangles of a compiled mesh. They have the materials of the file unless `modifier` is one.
/// Throws InputError with the name of the file.
void add_compiled_mesh(std::string_view content, const std::string& name, std::optional<std::size_t> modifier,
                       const Primitive& mesh, Collector& collector);

}  // namespace stilb::io::radiance
