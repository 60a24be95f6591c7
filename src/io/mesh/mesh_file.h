// Triangle meshes from OBJ and PLY files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/shape.h"

namespace stilb::io {

/// A mesh as its file gives it: coordinates untransformed, polygons triangulated, texture coordinates
/// ignored.
struct MeshFile {
    Mesh mesh;
    /// Names of the file's parts and, for each triangle, indices into them. Unnamed parts have the name "".
    std::vector<std::string> material_names;
    std::vector<std::uint32_t> material_of_triangle;
    std::vector<std::string> group_names;
    std::vector<std::uint32_t> group_of_triangle;
    /// Triangles of no area (or with a repeated vertex), which are left out.
    std::size_t degenerate_triangles = 0;
};

/// Reads by the file's extension (.obj, .ply; any case). Throws InputError naming file and line.
MeshFile read_mesh_file(const std::filesystem::path& path);

/// The readers themselves, on the file's content; `name` is used in messages only.
MeshFile read_obj(std::string_view content, const std::string& name);
MeshFile read_ply(std::string_view content, const std::string& name);

/// The content of an OBJ file, with seven digits of each coordinate.
std::string to_obj(const Mesh& mesh);

/// Triangles (indices into `polygon`) of a simple planar polygon, convex or not, in its own orientation.
std::vector<Triangle> triangulate_polygon(const std::vector<Vec3>& polygon);

}  // namespace stilb::io
