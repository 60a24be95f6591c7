// Lamps that are some faces of a mesh, such as the glass of a luminaire: objects of their own, because an
// object shines as a whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace stilb::scene {

/// Moves the triangles of these numbers (some, not all; they increase) from a mesh to a new object, which
/// remembers it (Object::cut_from). Both keep materials and normals, and no ray passes between them.
ObjectId cut_out(Scene& scene, ObjectId object, std::span<const std::uint32_t> triangles, std::string name);

/// Removes the faces of a lamp that lie on others of it (geometry/repeated_faces.h): rays meet one of them
/// only, so that only one may shine. Returns their number.
std::size_t remove_repeated_faces(Object& lamp);

/// The objects that were cut out of this one, in the order of the scene.
std::vector<ObjectId> cut_from(const Scene& scene, ObjectId object);

/// The mesh as it was before something was cut out of it: its own triangles first, then those of each object
/// of cut_from(). Without normals.
Mesh whole_mesh(const Scene& scene, ObjectId object);

}  // namespace stilb::scene
