// Triangle meshes from OBJ and PLY files.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
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

// What the mesh readers share: putting a MeshFile together.

/// Coordinates beyond it (in the file's units) are wrong input: products of four must stay finite.
inline constexpr double kLargestCoordinate = 1e30;
inline bool is_coordinate(double value) { return std::abs(value) <= kLargestCoordinate; }

/// The names of one kind of part (materials, groups), in the order of their first triangles.
class PartNames {
  public:
    void use(std::string_view name) {
        current_ = name;
        index_.reset();
    }
    /// Of the name in use; a name that no triangle asks for is never listed.
    std::uint32_t index();
    std::vector<std::string> names() && { return std::move(names_); }

  private:
    std::vector<std::string> names_;
    std::unordered_map<std::string, std::uint32_t> indices_;
    std::string current_;
    std::optional<std::uint32_t> index_;
};

/// Takes vertices and polygons one by one. Indices count from 0 and are checked by the reader, who knows the
/// line.
class MeshBuilder {
  public:
    /// Room for that many. Only for counts that are known to be in the file.
    void reserve_vertices(std::size_t count) { file_.mesh.vertices.reserve(count); }
    std::size_t vertex_count() const { return file_.mesh.vertices.size(); }
    void add_vertex(const Vec3& position) { file_.mesh.vertices.push_back(position); }
    std::size_t normal_count() const { return file_.mesh.normals.size(); }
    /// Of any length; zero: of no use.
    void add_normal(const Vec3& normal);

    /// The names for the polygons that follow; "" before the first call.
    void use_material(std::string_view name) { materials_.use(name); }
    void use_group(std::string_view name) { groups_.use(name); }

    /// A simple planar polygon of three corners or more. `normals`: of its corners, or kNoNormal; empty where
    /// normals have the vertices' indices, or there are none.
    void add_polygon(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> normals = {});
    void add_triangle(const Triangle& triangle, const std::optional<Triangle>& normals = std::nullopt);

    /// Throws InputError where no triangle has come together; `remedy` says what the format would need.
    MeshFile finish(const std::string& name, std::string_view remedy) &&;

  private:
    /// Normals that no triangle is given.
    void drop_unused_normals();

    MeshFile file_;
    PartNames materials_, groups_;
    std::vector<Vec3> polygon_;
};

}  // namespace stilb::io
