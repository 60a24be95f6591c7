// Compiled files of Radiance: octrees (oconv) and meshes (obj2mesh).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/import/radiance/primitives.h"

namespace stilb::io::radiance {

/// The names of the files of an octree. Throws InputError with the name of the file, also where it is frozen
/// (oconv -f): then it has no files.
std::vector<std::string> files_of_octree(std::string_view content, const std::string& name);

/// Adds the triangles of a compiled mesh. They have the materials of the file unless `modifier` is one.
/// Throws InputError with the name of the file.
void add_compiled_mesh(std::string_view content, const std::string& name, std::optional<std::size_t> modifier,
                       const Primitive& mesh, Collector& collector);

}  // namespace stilb::io::radiance
