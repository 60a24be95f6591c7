// Triangle meshes from OBJ, PLY and glTF files.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/monitor.h"
#include "geometry/shape.h"
#include "io/text/unread_bytes.h"
#include "io/text/utf8.h"

namespace stilb::io {

inline constexpr std::uint32_t kNoCoordinates = ~0u;

/// The contents of a mesh file: coordinates untransformed (glTF: with z upwards), polygons triangulated.
struct MeshFile {
    Mesh mesh;
    /// Names of the file's parts and, for each triangle, indices into them. Unnamed parts have the name "".
    std::vector<std::string> material_names;
    std::vector<std::uint32_t> material_of_triangle;
    std::vector<std::string> group_names;
    std::vector<std::uint32_t> group_of_triangle;
    /// OBJ's texture coordinates, if asked for, and for each triangle those of its corners, or
    /// kNoCoordinates.
    std::vector<std::array<float, 2>> texture_coordinates;
    std::vector<Triangle> corner_coordinates;
    /// Other files with parts of the mesh (buffers of glTF).
    std::vector<std::filesystem::path> other_files;
    /// Names of files with materials (OBJ's mtllib), as written.
    std::vector<std::string> material_libraries;
    /// The number of triangles without area (with a repeated vertex, or faces of one or two corners), which
    /// are left out.
    std::size_t degenerate_triangles = 0;
    /// Triangles that are flat, because their normals lean far away from them.
    std::size_t leaning_triangles = 0;
    /// Sentences about what the reader has left out.
    std::vector<std::string> remarks;
};

/// Sentences about everything that is left out.
std::vector<std::string> mesh_warnings(const MeshFile& file);
/// `which`: "3 triangles".
std::string leaning_warning(std::string_view which);

/// Selects the reader by the file's extension (.obj, .ply, .gltf, .glb; any case). Throws InputError with
/// file and line, and Cancelled as the monitor does, which takes the share that is read of OBJ and PLY.
enum class TextureCoordinates { ignored, kept };
MeshFile read_mesh_file(const std::filesystem::path& path, const Monitor& monitor = Monitor::none(),
                        TextureCoordinates of_obj = TextureCoordinates::ignored);

/// The readers for a text in memory, or for a file piece by piece; `name` is used in messages only.
MeshFile read_obj(UnreadBytes content, const std::string& name);
MeshFile read_obj(UnreadBytes content, const std::string& name, TextureCoordinates coordinates);
MeshFile read_ply(UnreadBytes content, const std::string& name);

/// The content of an OBJ file, with seven digits of each coordinate.
std::string to_obj(const Mesh& mesh);
/// The same with all digits, with normals, and with a material for each triangle: an index into `names`.
std::string to_obj(const Mesh& mesh, std::span<const std::uint32_t> part_of_triangle,
                   std::span<const std::string> names);

enum class PlyNumbers { float32, float64 };
/// The content of a binary PLY file; with normals where the mesh has them.
std::string to_ply(const Mesh& mesh, PlyNumbers numbers);

/// Triangles (indices into `polygon`) of a simple planar polygon, convex or not, with the same orientation.
std::vector<Triangle> triangulate_polygon(const std::vector<Vec3>& polygon);

// The common part of the mesh readers: building a MeshFile.

/// The limit of coordinates (in the file's units): products of four of them must stay finite.
inline constexpr double kLargestCoordinate = 1e30;
inline bool is_coordinate(double value) { return std::abs(value) <= kLargestCoordinate; }

/// The names of one kind of part (materials, groups), in the order of their first triangles.
class PartNames {
  public:
    void use(std::string name) {
        current_ = std::move(name);
        index_.reset();
    }
    /// The index of the present name; a name without triangles is never listed.
    std::uint32_t index();
    std::vector<std::string> names() && { return std::move(names_); }

  private:
    std::vector<std::string> names_;
    std::unordered_map<std::string, std::uint32_t> indices_;
    std::string current_;
    std::optional<std::uint32_t> index_;
};

/// Takes vertices and polygons one by one. Indices count from 0; the reader checks them, so that it can
/// report the line.
class MeshBuilder {
  public:
    /// Reserves memory. Only for counts that the file's size confirms.
    void reserve_vertices(std::size_t count) { file_.mesh.vertices.reserve(count); }
    void reserve_triangles(std::size_t count);
    std::size_t vertex_count() const { return file_.mesh.vertices.size(); }
    void add_vertex(const Vec3& position) { file_.mesh.vertices.push_back(position); }
    std::size_t triangle_count() const { return file_.mesh.triangles.size(); }
    std::size_t normal_count() const { return file_.mesh.normals.size(); }
    /// Normals may have any length; a zero normal, or one that is not finite, is ignored.
    void add_normal(const Vec3& normal);

    /// The names of the following polygons; "" before the first call.
    void use_material(std::string_view name) { materials_.use(as_utf8(name)); }
    void use_group(std::string_view name) { groups_.use(as_utf8(name)); }
    void add_material_library(std::string_view name) { file_.material_libraries.emplace_back(name); }

    void add_remark(std::string remark) { file_.remarks.push_back(std::move(remark)); }

    void add_texture_coordinates(const std::array<float, 2>& uv) { file_.texture_coordinates.push_back(uv); }

    /// A simple planar polygon of three corners or more. `normals`: those of its corners, or kNoNormal; empty
    /// where normals have the vertices' indices, or there are none. `coordinates`: likewise, of all polygons
    /// or none.
    void add_polygon(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> normals = {},
                     std::span<const std::uint32_t> coordinates = {});
    /// Counts a face of one or two corners, which has no area.
    void leave_out_face() { ++file_.degenerate_triangles; }
    void add_triangle(const Triangle& triangle, const std::optional<Triangle>& normals = std::nullopt,
                      const std::optional<Triangle>& coordinates = std::nullopt);

    /// Throws InputError where there is no triangle; `remedy` says what the format requires.
    MeshFile finish(const std::string& name, std::string_view remedy) &&;

  private:
    /// Adds the indices of the last triangle's corners to their list.
    void add_of_last_triangle(std::vector<Triangle>& list, const std::optional<Triangle>& indices);
    /// Removes normals that no triangle uses.
    void drop_unused_normals();

    MeshFile file_;
    PartNames materials_, groups_;
    std::vector<Vec3> polygon_;
};

}  // namespace stilb::io
