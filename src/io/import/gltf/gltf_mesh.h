// glTF files as meshes of a scene in TOML.
#pragma once

#include <filesystem>

#include "io/mesh/mesh_file.h"

namespace stilb::io {

/// All meshes of the file's scene as one, in metres and with z upwards. Its parts have the names of the
/// file's materials, and its groups those of the nodes. Throws InputError.
MeshFile read_gltf_mesh(const std::filesystem::path& path);

}  // namespace stilb::io
