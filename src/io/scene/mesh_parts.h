// The parts of mesh files, by whose names lights pick faces of an object.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "base/shared_list.h"
#include "io/mesh/mesh_file.h"
#include "io/scene/toml.h"
#include "scene/scene.h"

namespace stilb::io {

/// The names of a mesh file's parts and, for each triangle, indices into them: as in MeshFile.
struct MeshParts {
    std::vector<std::string> material_names;
    SharedList<std::uint32_t> material_of_triangle;
    std::vector<std::string> group_names;
    SharedList<std::uint32_t> group_of_triangle;
};
MeshParts take_parts(MeshFile& file);

/// Of objects that are meshes from files.
using PartsOfObjects = std::map<ObjectId, MeshParts>;

/// Makes the faces that an area light picks an object of their own, named "OBJECT (PART)". `part` is its key
/// `material`, the name of a material of the mesh file or else of the scene, or `mesh_group`, that of a group
/// of the file. Returns the object itself where those are all of its faces.
ObjectId cut_out_lamp(Scene& scene, ObjectId object, const TomlTable::NamedItem& part, PartsOfObjects& parts);

}  // namespace stilb::io
