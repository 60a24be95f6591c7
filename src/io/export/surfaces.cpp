// Objects as surfaces of one material each.

#include <fmt/format.h>

#include <map>
#include <set>

#include "geometry/harmonics/surface.h"
#include "geometry/mesh_part.h"
#include "io/export/parts.h"

namespace stilb::io::exporting {
namespace {

/// Of a body by harmonics: 4 parallels for each degree of its series, at most so many.
constexpr int kMostParallels = 512;

/// The triangles between parallel i and the next one; those at the poles, of no area, are left out.
void add_ring(Mesh& mesh, int i, int parallels, int azimuths) {
    const auto vertex = [&](int parallel, int k) {
        return static_cast<std::uint32_t>(parallel * azimuths + k % azimuths);
    };
    for (int k = 0; k < azimuths; ++k) {
        if (i + 1 < parallels)
            mesh.triangles.push_back({vertex(i, k), vertex(i + 1, k), vertex(i + 1, k + 1)});
        if (i > 0) mesh.triangles.push_back({vertex(i, k), vertex(i + 1, k + 1), vertex(i, k + 1)});
    }
}

/// Points on parallels, with the surface's own normals; the first and last parallel are the poles.
Mesh mesh_of(const Harmonics& body) {
    const int degree = body.surface->radius().degree();
    const int parallels = std::clamp(4 * degree, 32, kMostParallels), azimuths = 2 * parallels;
    Mesh mesh;
    for (int i = 0; i <= parallels; ++i) {
        for (int k = 0; k < azimuths; ++k) {
            const double theta = kPi * i / parallels, phi = 2 * kPi * k / azimuths;
            const Vec3 own{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
            const Vec3 direction = body.axes.to_world(own);
            mesh.vertices.push_back(body.point_towards(direction));
            mesh.normals.push_back(body.normal_towards(direction));
        }
    }
    for (int i = 0; i < parallels; ++i) add_ring(mesh, i, parallels, azimuths);
    const bool is_left_handed = dot(body.axes.to_world({0, 0, 1}),
                                    cross(body.axes.to_world({1, 0, 0}), body.axes.to_world({0, 1, 0}))) < 0;
    if (is_left_handed) {
        for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    }
    return mesh;
}

/// The triangles of one material.
Mesh part_of(const Mesh& mesh, const std::vector<MaterialId>& materials, MaterialId material) {
    std::vector<std::uint32_t> triangles;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (materials[t] == material) triangles.push_back(t);
    }
    return geometry::part_of(mesh, triangles);
}

/// Adds the surfaces of one object.
class Division {
  public:
    Division(std::vector<Surface>& surfaces, Identifiers& identifiers, Output& output)
        : surfaces_(surfaces), identifiers_(identifiers), output_(output) {}

    void add(const Scene& scene, const Object& object, const std::optional<Rgb>& luminance) {
        if (const auto* mesh = std::get_if<Mesh>(&object.shape); mesh && object.materials.size() > 1) {
            for (const MaterialId material :
                 std::set<MaterialId>(object.materials.begin(), object.materials.end())) {
                const std::string name = object.name + "_" + scene.materials[index_of(material)].name;
                push(name, part_of(*mesh, object.materials, material), material, luminance);
            }
            return;
        }
        std::visit(
            [&](const auto& shape) { push(object.name, plain(shape), object.materials[0], luminance); },
            object.shape);
        if (std::holds_alternative<Harmonics>(object.shape)) {
            output_.warn("object", object.name, "the smooth body by harmonics becomes a mesh.");
        }
    }

  private:
    template <typename Shape>
    static const Shape& plain(const Shape& shape) {
        return shape;
    }
    static Mesh plain(const Box& box) { return triangulated(box); }
    static Mesh plain(const Harmonics& body) { return mesh_of(body); }

    template <typename Shape>
    void push(const std::string& name, const Shape& shape, MaterialId material,
              const std::optional<Rgb>& luminance) {
        surfaces_.push_back({identifiers_.make(name), shape, material, luminance});
    }

    std::vector<Surface>& surfaces_;
    Identifiers& identifiers_;
    Output& output_;
};

void append(std::string& bytes, const Vec3& vector) {
    const std::array<float, 3> values{static_cast<float>(vector.x), static_cast<float>(vector.y),
                                      static_cast<float>(vector.z)};
    bytes.append(reinterpret_cast<const char*>(values.data()), sizeof values);
}

/// The shading normal at a corner, the triangle's own where there is none.
Vec3 normal_at(const Mesh& mesh, std::uint32_t triangle, std::size_t corner) {
    const Triangle& t = mesh.triangles[triangle];
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3 across = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
    Vec3 barycentric{0, 0, 0};
    (corner == 0 ? barycentric.x : corner == 1 ? barycentric.y : barycentric.z) = 1;
    return shading_normal(mesh, triangle, barycentric, normalized(across));
}

}  // namespace

std::vector<Surface> surfaces_of(const Scene& scene, Identifiers& identifiers, Output& output) {
    std::map<ObjectId, Rgb> luminances;
    std::set<ObjectId> openings;
    for (const Light& light : scene.lights) {
        if (const auto emission = lights::uniform_emission(light))
            luminances[emission->object] = emission->luminance_cd_m2;
        if (const auto* luminaire = std::get_if<LuminousOpening>(&light.source))
            openings.insert(luminaire->object);
    }
    std::vector<Surface> surfaces;
    Division division(surfaces, identifiers, output);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        if (openings.contains(static_cast<ObjectId>(i))) continue;
        const auto found = luminances.find(static_cast<ObjectId>(i));
        division.add(scene, scene.objects[i],
                     found == luminances.end() ? std::nullopt : std::optional(found->second));
    }
    return surfaces;
}

std::string to_ply(const Mesh& mesh) {
    // With normals every triangle has corners of its own, since a vertex may have several normals.
    const bool has_normals = !mesh.normals.empty();
    const std::size_t vertices = has_normals ? 3 * mesh.triangles.size() : mesh.vertices.size();
    std::string bytes = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
        "property float z\n{}element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        vertices, has_normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
        mesh.triangles.size());
    if (!has_normals) {
        for (const Vec3& vertex : mesh.vertices) append(bytes, vertex);
    }
    for (std::uint32_t t = 0; has_normals && t < mesh.triangles.size(); ++t) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            append(bytes, mesh.vertices[mesh.triangles[t][corner]]);
            append(bytes, normal_at(mesh, t, corner));
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

}  // namespace stilb::io::exporting
