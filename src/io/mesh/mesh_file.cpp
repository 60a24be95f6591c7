
#include "io/mesh/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/leaning_normals.h"
#include "io/import/gltf/gltf_mesh.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {

namespace {

MeshFile read_pieces(MeshFile (*read)(UnreadBytes, const std::string&), const std::filesystem::path& path,
                     const Monitor& monitor) {
    FilePieces file(path, monitor);
    return read(file, path.string());
}

}  // namespace

MeshFile read_mesh_file(const std::filesystem::path& path, const Monitor& monitor,
                        TextureCoordinates of_obj) {
    const std::string extension = extension_of(path);
    if (extension == ".obj") {
        FilePieces file(path, monitor);
        return read_obj(file, path.string(), of_obj);
    }
    if (extension == ".ply") return read_pieces(read_ply, path, monitor);
    if (extension == ".gltf" || extension == ".glb") return read_gltf_mesh(path);
    if (extension.empty()) read_beginning(path, 1);  // names folders, and files that are not there
    throw InputError(
        fmt::format("the extension {} is not a supported mesh format: use .obj, .ply, .gltf or .glb",
                    in_quotes(extension)),
        {path.string()});
}

namespace {

/// Whether the triangle has no area beyond rounding, so that it is a line or a point.
bool is_degenerate(const Vec3& a, const Vec3& b, const Vec3& c) {
    constexpr double kThinnest = 1e-12;  // height over longest side
    const double longest_squared =
        std::max({squared_length(b - a), squared_length(c - b), squared_length(a - c)});
    return !(length(cross(b - a, c - a)) > kThinnest * longest_squared);
}

}  // namespace

std::uint32_t PartNames::index() {
    if (!index_) {
        const auto [entry, is_new] =
            indices_.try_emplace(current_, static_cast<std::uint32_t>(names_.size()));
        if (is_new) names_.push_back(current_);
        index_ = entry->second;
    }
    return *index_;
}

void MeshBuilder::reserve_triangles(std::size_t count) {
    file_.mesh.triangles.reserve(count);
    file_.material_of_triangle.reserve(count);
    file_.group_of_triangle.reserve(count);
}

void MeshBuilder::add_normal(const Vec3& normal) {
    const double size = largest_coordinate(normal);
    constexpr double kSmallest = 1e-100;  // its square is still a number
    const bool is_usable = size > kSmallest && is_finite(normal);
    file_.mesh.normals.push_back(is_usable ? normalized(normal / size) : Vec3{});
}

void MeshBuilder::add_of_last_triangle(std::vector<Triangle>& list, const std::optional<Triangle>& indices) {
    static_assert(kNoNormal == kNoCoordinates);
    if (!indices) return;
    // Triangles before the first that has some may have been added without.
    list.resize(file_.mesh.triangles.size() - 1, Triangle{kNoNormal, kNoNormal, kNoNormal});
    list.push_back(*indices);
}

void MeshBuilder::add_triangle(const Triangle& t, const std::optional<Triangle>& normals,
                               const std::optional<Triangle>& coordinates) {
    const std::vector<Vec3>& vertices = file_.mesh.vertices;
    if (is_degenerate(vertices[t[0]], vertices[t[1]], vertices[t[2]])) {
        ++file_.degenerate_triangles;
        return;
    }
    file_.mesh.triangles.push_back(t);
    add_of_last_triangle(file_.mesh.corner_normals, normals);
    add_of_last_triangle(file_.corner_coordinates, coordinates);
    file_.material_of_triangle.push_back(materials_.index());
    file_.group_of_triangle.push_back(groups_.index());
}

void MeshBuilder::add_polygon(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> normals,
                              std::span<const std::uint32_t> coordinates) {
    const auto add = [&](const Triangle& t) {
        const auto of = [&](std::span<const std::uint32_t> indices) {
            std::optional<Triangle> found;
            if (!indices.empty()) found = {indices[t[0]], indices[t[1]], indices[t[2]]};
            return found;
        };
        add_triangle(*of(corners), of(normals), of(coordinates));
    };
    if (corners.size() == 3) return add({0, 1, 2});
    polygon_.clear();
    for (const std::uint32_t corner : corners) polygon_.push_back(file_.mesh.vertices[corner]);
    for (const Triangle& t : triangulate_polygon(polygon_)) add(t);
}

void MeshBuilder::drop_unused_normals() {
    Mesh& mesh = file_.mesh;
    const auto has_normals = [](const Triangle& t) { return std::ranges::count(t, kNoNormal) == 0; };
    if (mesh.corner_normals.empty() || std::ranges::any_of(mesh.corner_normals, has_normals)) return;
    mesh.normals.clear();
    mesh.corner_normals.clear();
}

MeshFile MeshBuilder::finish(const std::string& name, std::string_view remedy) && {
    if (file_.mesh.triangles.empty()) {
        const std::string dropped =
            file_.degenerate_triangles == 0
                ? ""
                : fmt::format(" ({} without area left out)", file_.degenerate_triangles);
        throw InputError(fmt::format("no triangle found{}, so there is no surface; {}", dropped, remedy),
                         {name});
    }
    file_.leaning_triangles = geometry::drop_leaning_normals(file_.mesh);
    drop_unused_normals();
    file_.material_names = std::move(materials_).names();
    file_.group_names = std::move(groups_).names();
    return std::move(file_);
}

std::vector<std::string> mesh_warnings(const MeshFile& file) {
    std::vector<std::string> warnings = file.remarks;
    if (file.degenerate_triangles > 0)
        warnings.push_back(fmt::format("{} triangles without area are left out.", file.degenerate_triangles));
    if (file.leaning_triangles > 0)
        warnings.push_back(leaning_warning(fmt::format("{} triangles", file.leaning_triangles)));
    return warnings;
}

std::string leaning_warning(std::string_view which) {
    return fmt::format(
        "the normals of {} lean more than {:.0f} degrees away from their faces; these are flat.", which,
        geometry::kMostLean_deg);
}

}  // namespace stilb::io
