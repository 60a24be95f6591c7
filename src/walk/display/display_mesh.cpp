#include "walk/display/display_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "stilb/error.h"
#include "walk/display/refinement.h"

namespace stilb::walk {
namespace {

void require_walkable(const patches::Patches& patches) {
    if (patches.count() <= kMostWalkPatches) return;
    throw InputError(fmt::format(
        "the surfaces are {} patches, too many to walk through: a browser takes {} at most. Choose a larger "
        "patch size, or meshes of fewer triangles.",
        patches.count(), kMostWalkPatches));
}

/// Builds the mesh of one scene.
class DisplayBuilder {
  public:
    DisplayBuilder(const Scene& scene, const rays::RayCaster& caster, const patches::Patches& patches,
                   const DisplayOptions& options, const Monitor& monitor)
        : caster_(caster),
          options_(options),
          monitor_(monitor),
          direct_(scene, caster),
          light_(scene, caster, patches, direct_),
          scene_{scene, patches, light_},
          surface_(make_display_surface(scene, caster, patches)),
          is_emitter_(scene.objects.size()) {
        lights_.lights = direct_.count();
        for (const Light& light : scene.lights) {
            const auto surface = lights::emitting_object(light);
            if (surface) is_emitter_[index_of(*surface)] = true;
        }
    }

    DisplayMesh run(const std::vector<bool>& carries_light) {
        remove_sealed();
        const auto is_certain = [&](const SurfaceTriangle& triangle) {
            return carries_light[triangle.side] || scene_.is_specular(triangle.side) || emits(triangle.side);
        };
        light_all(1, [&](const SurfaceTriangle& triangle) { return !is_certain(triangle); });
        remove_unseen(is_certain);
        const std::size_t most = surface_.triangles.size() > kManyTriangles ? 1 : kMostAround;
        light_all(most, [&](const SurfaceTriangle& triangle) { return !scene_.is_specular(triangle.side); });
        const std::vector<float> errors =
            refine(scene_, options_, typical_lx(), 2 * caster_.half_extent_m(), surface_, lights_, monitor_);
        return assembled(errors);
    }

  private:
    /// Triangles around a vertex that are looked at.
    static constexpr std::size_t kMostAround = 12;
    /// With more triangles, these are so small that contacts need no care.
    static constexpr std::size_t kManyTriangles = 500'000;

    /// Light at the vertices of triangles that meet a condition. `most`: triangles around each vertex that
    /// are looked at. With one, contacts are not found.
    template <typename Condition>
    void light_all(std::size_t most, const Condition& condition) {
        const TrianglesAround triangles(surface_);
        std::vector<std::vector<Adjoining>> around(surface_.vertices.size());
        for (std::uint32_t v = 0; v < around.size(); ++v) {
            for (const std::uint32_t t : triangles.of(v)) {
                const SurfaceTriangle& triangle = surface_.triangles[t];
                if (around[v].size() == most) break;
                if (condition(triangle)) around[v].push_back({surface_.opposite(triangle, v), triangle.side});
            }
        }
        light_vertices(scene_, surface_, 0, around, lights_, monitor_);
    }

    bool emits(std::uint32_t side) const {
        const ObjectId object = scene_.patches.object_of(scene_.patches.patch_of(side));
        return scene_.patches.is_front(side) && is_emitter_[index_of(object)];
    }

    /// Removes the insides of bodies.
    void remove_sealed() {
        const std::vector<bool> is_sealed = sealed_sides(scene_.scene);
        std::erase_if(surface_.triangles,
                      [&](const SurfaceTriangle& triangle) { return is_sealed[object_side_of(triangle)]; });
        remove_unused_vertices();
    }

    std::size_t object_side_of(const SurfaceTriangle& triangle) const {
        const patches::Patches& patches = scene_.patches;
        return ObjectSide{patches.object_of(patches.patch_of(triangle.side)), patches.is_front(triangle.side)}
            .number();
    }

    /// Removes triangles that are dark, and remembers the sides of objects that are left.
    template <typename Condition>
    void remove_unseen(const Condition& is_certain) {
        std::vector<bool> is_reached(2 * scene_.scene.objects.size());
        std::erase_if(surface_.triangles, [&](const SurfaceTriangle& triangle) {
            if (!is_certain(triangle) && !is_lit(triangle)) return true;
            is_reached[object_side_of(triangle)] = true;
            return false;
        });
        remove_unused_vertices();
        light_.set_reached(std::move(is_reached));
    }

    bool is_lit(const SurfaceTriangle& triangle) const {
        return std::ranges::any_of(triangle.corners,
                                   [&](std::uint32_t corner) { return lights_.sum_lx(corner) > 0; });
    }

    void remove_unused_vertices() {
        const std::vector<std::uint32_t> kept = renumber();
        std::vector<SurfaceVertex> vertices;
        vertices.reserve(kept.size());
        for (const std::uint32_t v : kept) vertices.push_back(surface_.vertices[v]);
        surface_.vertices = std::move(vertices);
    }

    /// Numbers the vertices in the order in which triangles use them; returns the old numbers.
    std::vector<std::uint32_t> renumber() {
        constexpr std::uint32_t kUnused = ~0u;
        std::vector<std::uint32_t> number(surface_.vertices.size(), kUnused), old;
        for (SurfaceTriangle& triangle : surface_.triangles) {
            for (std::uint32_t& corner : triangle.corners) {
                if (number[corner] == kUnused) {
                    number[corner] = static_cast<std::uint32_t>(old.size());
                    old.push_back(corner);
                }
                corner = number[corner];
            }
        }
        return old;
    }

    /// The mean direct illuminance of the surfaces.
    double typical_lx() const {
        double sum = 0, area_m2 = 0;
        for (const SurfaceTriangle& triangle : surface_.triangles) {
            if (scene_.is_specular(triangle.side)) continue;
            const double own_m2 = surface_.area_m2(triangle);
            area_m2 += own_m2;
            for (const std::uint32_t corner : triangle.corners) sum += own_m2 / 3 * lights_.sum_lx(corner);
        }
        return area_m2 > 0 ? sum / area_m2 : 0;
    }

    // The result.

    /// Object, back, material.
    std::tuple<std::uint32_t, bool, std::uint32_t> part_of(const SurfaceTriangle& triangle) const {
        const std::uint32_t patch = scene_.patches.patch_of(triangle.side);
        return {index_of(scene_.patches.object_of(patch)), !scene_.patches.is_front(triangle.side),
                index_of(scene_.patches.material_of(scene_.scene, triangle.side))};
    }

    DisplayMesh assembled(const std::vector<float>& interpolation_errors) {
        std::ranges::stable_sort(surface_.triangles, {},
                                 [&](const SurfaceTriangle& triangle) { return part_of(triangle); });
        const std::vector<std::uint32_t> old = renumber();
        DisplayMesh mesh;
        for (const std::uint32_t v : old)
            mesh.vertices.push_back({surface_.vertices[v].position, surface_.vertices[v].normal});
        for (const SurfaceTriangle& triangle : surface_.triangles) add_triangle(triangle, mesh);
        mesh.direct_lx.reserve(lights_.lights * old.size());
        for (std::size_t light = 0; light < lights_.lights; ++light) {
            for (const std::uint32_t v : old) mesh.direct_lx.push_back(lights_.of(v)[light]);
        }
        for (const std::uint32_t v : old)
            mesh.direct_error_lx.push_back(error_lx(v, interpolation_errors[v]));
        return mesh;
    }

    void add_triangle(const SurfaceTriangle& triangle, DisplayMesh& mesh) const {
        const auto [object, is_back, material] = part_of(triangle);
        const DisplayPart part{ObjectId{object}, MaterialId{material}, !is_back, mesh.triangles.size()};
        if (mesh.parts.empty() || mesh.parts.back().object != part.object ||
            mesh.parts.back().material != part.material || mesh.parts.back().is_front != part.is_front)
            mesh.parts.push_back(part);
        ++mesh.parts.back().count;
        mesh.triangles.push_back(triangle.corners);
        for (std::size_t i = 0; i < 3; ++i) {
            DisplayVertex& vertex = mesh.vertices[triangle.corners[i]];
            const auto& [b0, b1, b2] = triangle.barycentric[i];
            vertex.side = triangle.side;
            vertex.barycentric = {b0, b1, b2};
        }
    }

    float error_lx(std::uint32_t vertex, double interpolation) const {
        constexpr double kNormal95 = 1.959964, kHalfPrecision = 0x1p-11;
        const double sampling = kNormal95 * std::sqrt(double{lights_.squared_error_lx2[vertex]});
        const double rounding = kHalfPrecision * lights_.sum_lx(vertex);
        return static_cast<float>(std::hypot(sampling, interpolation, rounding));
    }

    const rays::RayCaster& caster_;
    const DisplayOptions& options_;
    const Monitor& monitor_;
    DirectLight direct_;
    VertexLight light_;
    RefinementScene scene_;
    DisplaySurface surface_;
    VertexLights lights_;
    std::vector<bool> is_emitter_;  ///< per object
};

}  // namespace

DisplayMesh make_display_mesh(const Scene& scene, const rays::RayCaster& caster,
                              const patches::Patches& patches, const std::vector<bool>& carries_light,
                              const DisplayOptions& options, const Monitor& monitor) {
    require_walkable(patches);
    return DisplayBuilder(scene, caster, patches, options, monitor).run(carries_light);
}

}  // namespace stilb::walk
