// Objects as surfaces of one material each.

#include <fmt/format.h>

#include <map>
#include <set>
#include <span>

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
Mesh part_of(const Mesh& mesh, std::span<const MaterialId> materials, MaterialId material) {
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
        if (object.materials.size() > 1) {
            const geometry::MeshInWorld mesh(object.shape);
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
    static Mesh plain(const Instance& instance) { return triangulated(instance); }
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

}  // namespace

std::vector<Surface> surfaces_of(const Scene& scene, Identifiers& identifiers, Output& output) {
    std::map<ObjectId, Rgb> luminances;
    std::set<ObjectId> openings;
    for (const Light& light : scene.lights) {
        if (const auto emission = lights::uniform_emission(light))
            luminances[emission->object] = emission->luminance_cd_m2;
        if (const auto opening = lights::opening_of(light)) openings.insert(*opening);
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

}  // namespace stilb::io::exporting
