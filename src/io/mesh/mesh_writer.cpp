// Meshes as PLY and OBJ.
#include <fmt/format.h>

#include <bit>
#include <iterator>

#include "io/mesh/mesh_file.h"

namespace stilb::io {
namespace {

template <typename Number>
void append_numbers(std::string& bytes, const Vec3& v) {
    static_assert(std::endian::native == std::endian::little);
    for (const double value : {v.x, v.y, v.z}) {
        const auto number = static_cast<Number>(value);
        bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
}

/// The shading normal at a corner, the triangle's own where there is none.
Vec3 normal_of_corner(const Mesh& mesh, std::uint32_t triangle, std::size_t corner) {
    const Triangle& t = mesh.triangles[triangle];
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3 across = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
    Vec3 barycentric{0, 0, 0};
    (corner == 0 ? barycentric.x : corner == 1 ? barycentric.y : barycentric.z) = 1;
    return shading_normal(mesh, triangle, barycentric, normalized(across));
}

template <typename Number>
std::string ply_of(const Mesh& mesh, std::string_view type) {
    // With normals every triangle has corners of its own, since a vertex may have several normals.
    const bool has_normals = !mesh.normals.empty();
    const std::size_t vertices = has_normals ? 3 * mesh.triangles.size() : mesh.vertices.size();
    std::string bytes = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", vertices);
    for (const std::string_view axis : {"x", "y", "z"}) bytes += fmt::format("property {} {}\n", type, axis);
    for (const std::string_view axis : {"nx", "ny", "nz"})
        if (has_normals) bytes += fmt::format("property {} {}\n", type, axis);
    bytes += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                         mesh.triangles.size());
    if (!has_normals) {
        for (const Vec3& vertex : mesh.vertices) append_numbers<Number>(bytes, vertex);
    }
    for (std::uint32_t t = 0; has_normals && t < mesh.triangles.size(); ++t) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            append_numbers<Number>(bytes, mesh.vertices[mesh.triangles[t][corner]]);
            append_numbers<Number>(bytes, normal_of_corner(mesh, t, corner));
        }
    }
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        bytes += '\3';
        const Triangle own{3 * t, 3 * t + 1, 3 * t + 2};
        bytes.append(reinterpret_cast<const char*>(has_normals ? own.data() : mesh.triangles[t].data()),
                     sizeof(Triangle));
    }
    return bytes;
}

void append_vectors(std::string& text, std::string_view word, const std::vector<Vec3>& vectors) {
    for (const Vec3& v : vectors)
        fmt::format_to(std::back_inserter(text), "{} {} {} {}\n", word, v.x, v.y, v.z);
}

}  // namespace

std::string to_ply(const Mesh& mesh, PlyNumbers numbers) {
    return numbers == PlyNumbers::float32 ? ply_of<float>(mesh, "float") : ply_of<double>(mesh, "double");
}

std::string to_obj(const Mesh& mesh) {
    std::string text;
    for (const Vec3& v : mesh.vertices) text += fmt::format("v {:.15g} {:.15g} {:.15g}\n", v.x, v.y, v.z);
    for (const auto& [a, b, c] : mesh.triangles) text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    return text;
}

std::string to_obj(const Mesh& mesh, std::span<const std::uint32_t> part_of_triangle,
                   std::span<const std::string> names) {
    std::string text;
    append_vectors(text, "v", mesh.vertices);
    append_vectors(text, "vn", mesh.normals);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (t == 0 || part_of_triangle[t] != part_of_triangle[t - 1])
            text += fmt::format("usemtl {}\n", names[part_of_triangle[t]]);
        text += 'f';
        const Triangle& normals = mesh.corner_normals.empty() ? mesh.triangles[t] : mesh.corner_normals[t];
        for (std::size_t corner = 0; corner < 3; ++corner) {
            text += fmt::format(" {}", mesh.triangles[t][corner] + 1);
            if (!mesh.normals.empty() && normals[corner] != kNoNormal)
                text += fmt::format("//{}", normals[corner] + 1);
        }
        text += '\n';
    }
    return text;
}

}  // namespace stilb::io
