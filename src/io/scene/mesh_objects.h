// Objects of shape "mesh".
#pragma once

#include <filesystem>
#include <map>
#include <memory>

#include "io/scene/mesh_parts.h"
#include "io/scene/sections.h"

namespace stilb::io {

/// The mesh files of a scene's objects: each is read once, and its objects share a mesh that is large.
class MeshFiles {
  public:
    /// Keeps references to the directory, the scene and the monitor.
    MeshFiles(const std::vector<NamedTable>& objects, const std::filesystem::path& directory, SceneFile& file,
              const Monitor& monitor);

    /// The object of such a table, untransformed and without a name, and the parts of its file.
    Object read(const TomlTable& table, MeshParts& parts);

  private:
    struct Loaded {
        std::shared_ptr<Mesh> mesh;
        MeshParts parts;
        SharedList<MaterialId> materials;  ///< of the last object
    };
    Loaded& load(const TomlTable& table);

    const std::filesystem::path& directory_;
    SceneFile& file_;
    const Monitor& monitor_;
    std::map<std::filesystem::path, std::size_t> uses_;
    std::map<std::filesystem::path, Loaded> loaded_;
};

/// The material of the scene that the item names.
MaterialId read_material(const TomlItem& item, const Scene& scene);

/// What the reader of the mesh has left out, as warnings of the scene.
void add_mesh_warnings(const std::string& where, const MeshFile& mesh, SceneFile& file);

}  // namespace stilb::io
