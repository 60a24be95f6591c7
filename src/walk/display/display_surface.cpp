#include "walk/display/display_surface.h"

#include <bit>
#include <cmath>
#include <unordered_map>

#include "base/parallel.h"
#include "estimators/patch_light/first_shot/shadow_rays.h"

namespace stilb::walk {
namespace {

/// Numbers positions: equal ones, bit by bit, get the same number.
class Places {
  public:
    explicit Places(std::size_t about) { numbers_.reserve(about); }

    std::uint32_t of(const patches::Float3& position) {
        const auto next = static_cast<std::uint32_t>(numbers_.size());
        // + 0 makes one zero of both.
        return numbers_.try_emplace({position.x + 0.f, position.y + 0.f, position.z + 0.f}, next)
            .first->second;
    }
    std::uint32_t count() const { return static_cast<std::uint32_t>(numbers_.size()); }

  private:
    using Key = std::array<float, 3>;
    struct Hash {
        std::size_t operator()(const Key& key) const {
            std::uint64_t hash = 0;
            for (const float coordinate : key)
                hash = (hash ^ std::bit_cast<std::uint32_t>(coordinate)) * 0x9e3779b97f4a7c15u;
            return hash ^ hash >> 29;
        }
    };
    std::unordered_map<Key, std::uint32_t, Hash> numbers_;
};

/// Sets the normals of vertices: first the sums over the triangles around, weighted by angle, so that the
/// division of a face into triangles does not matter.
void add_normals(const patches::Patches& patches, DisplaySurface& surface) {
    for (const SurfaceTriangle& triangle : surface.triangles) {
        const Vec3 normal = patches.normal_of(triangle.side);
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3& at = surface.vertices[triangle.corners[i]].position;
            const Vec3 to_next = surface.vertices[triangle.corners[(i + 1) % 3]].position - at;
            const Vec3 to_last = surface.vertices[triangle.corners[(i + 2) % 3]].position - at;
            const double angle = std::atan2(length(cross(to_next, to_last)), dot(to_next, to_last));
            surface.vertices[triangle.corners[i]].normal += angle * normal;
        }
    }
    for (SurfaceVertex& vertex : surface.vertices) {
        const double size = length(vertex.normal);
        vertex.normal = size > 0 ? vertex.normal / size : Vec3{0, 0, 1};
    }
}

std::optional<Vec3> exact_normal(const Shape& shape, const Vec3& position) {
    if (const auto* sphere = std::get_if<Sphere>(&shape)) return normalized(position - sphere->center);
    if (const auto* harmonics = std::get_if<Harmonics>(&shape))
        return harmonics->normal_towards(position - harmonics->center);
    return std::nullopt;
}

bool has_own_normals(const Shape& shape) {
    const Mesh* mesh = geometry::stored_mesh(shape);
    return mesh != nullptr && !mesh->normals.empty();
}

/// The normals that a mesh brings along, found by short rays onto it.
Vec3 shading_normal(const Scene& scene, const rays::RayCaster& caster, const patches::Patches& patches,
                    const DisplaySurface& surface, std::span<const std::uint32_t> around,
                    const SurfaceVertex& vertex) {
    constexpr double kMove = 0.01;
    Vec3 sum;
    for (const std::uint32_t t : around) {
        const SurfaceTriangle& triangle = surface.triangles[t];
        const Vec3 moved = vertex.position + kMove * (surface.middle(triangle) - vertex.position);
        const Vec3 lifted = estimators::lifted_off(scene, patches, caster, triangle.side, moved);
        const auto hit = caster.closest(lifted, -patches.normal_of(triangle.side));
        const bool is_own = hit && hit->object == patches.object_of(patches.patch_of(triangle.side)) &&
                            hit->distance_m < 4 * length(lifted - moved);
        sum += is_own ? hit->shading_normal : patches.normal_of(triangle.side);
    }
    const double size = length(sum);
    return size > 0 ? sum / size : vertex.normal;
}

/// Corrects the normals of objects whose true surface is smooth.
void correct_normals(const Scene& scene, const rays::RayCaster& caster, const patches::Patches& patches,
                     DisplaySurface& surface) {
    const TrianglesAround triangles(surface);
    parallel_for_parts(surface.vertices.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t v = first; v < last; ++v) {
            const auto around = triangles.of(static_cast<std::uint32_t>(v));
            const std::uint32_t side = surface.triangles[around[0]].side;
            const Shape& shape = scene.object(patches.object_of(patches.patch_of(side))).shape;
            SurfaceVertex& vertex = surface.vertices[v];
            if (const auto outwards = exact_normal(shape, vertex.position)) {
                vertex.normal = patches.is_front(side) ? *outwards : -*outwards;
            } else if (has_own_normals(shape)) {
                vertex.normal = shading_normal(scene, caster, patches, surface, around, vertex);
            }
        }
    });
}

}  // namespace

Vec3 DisplaySurface::middle(const SurfaceTriangle& triangle) const {
    const auto& [a, b, c] = triangle.corners;
    return (1. / 3) * (vertices[a].position + vertices[b].position + vertices[c].position);
}

double DisplaySurface::area_m2(const SurfaceTriangle& triangle) const {
    const auto& [a, b, c] = triangle.corners;
    return length(cross(vertices[b].position - vertices[a].position,
                        vertices[c].position - vertices[a].position)) /
           2;
}

DisplaySurface make_display_surface(const Scene& scene, const rays::RayCaster& caster,
                                    const patches::Patches& patches) {
    constexpr std::uint32_t kUnused = ~0u;
    DisplaySurface surface;
    Places places(patches.vertices.size());
    std::vector<std::uint32_t> number(2 * patches.vertices.size(), kUnused);
    const auto vertex_of = [&](std::uint32_t corner, bool is_front) {
        std::uint32_t& vertex = number[is_front ? corner : corner + patches.vertices.size()];
        if (vertex == kUnused) {
            vertex = static_cast<std::uint32_t>(surface.vertices.size());
            const patches::Float3& position = patches.vertices[corner];
            surface.vertices.push_back({patches.center + Vec3(position), {}, places.of(position)});
        }
        return vertex;
    };
    for (std::uint32_t side = 0; side < 2 * patches.count(); ++side) {
        const bool is_front = patches.is_front(side);
        const auto [a, b, c] = patches.corners[patches.patch_of(side)];
        SurfaceTriangle triangle{{vertex_of(a, is_front), vertex_of(b, is_front), vertex_of(c, is_front)},
                                 side,
                                 {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
        if (!is_front) {
            std::swap(triangle.corners[1], triangle.corners[2]);
            std::swap(triangle.barycentric[1], triangle.barycentric[2]);
        }
        surface.triangles.push_back(triangle);
    }
    surface.places = places.count();
    add_normals(patches, surface);
    correct_normals(scene, caster, patches, surface);
    return surface;
}

SurfaceVertex middle_between(const Shape& shape, const SurfaceVertex& a, const SurfaceVertex& b) {
    SurfaceVertex middle{0.5 * (a.position + b.position), a.normal + b.normal};
    const double size = length(middle.normal);
    middle.normal = size > 0 ? middle.normal / size : a.normal;
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
        const Vec3 outwards = normalized((a.position - sphere->center) + (b.position - sphere->center));
        middle.position = sphere->center + sphere->radius * outwards;
        middle.normal = dot(outwards, a.normal) > 0 ? outwards : -outwards;
    } else if (const auto* harmonics = std::get_if<Harmonics>(&shape)) {
        const Vec3 direction = (a.position - harmonics->center) + (b.position - harmonics->center);
        const Vec3 outwards = harmonics->normal_towards(direction);
        middle.position = harmonics->point_towards(direction);
        middle.normal = dot(outwards, middle.normal) > 0 ? outwards : -outwards;
    }
    return middle;
}

TrianglesAround::TrianglesAround(const DisplaySurface& surface)
    : first_(surface.vertices.size() + 1), triangles_(3 * surface.triangles.size()) {
    for (const SurfaceTriangle& triangle : surface.triangles) {
        for (const std::uint32_t corner : triangle.corners) ++first_[corner + 1];
    }
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
        for (const std::uint32_t corner : surface.triangles[t].corners) triangles_[next[corner]++] = t;
    }
}

}  // namespace stilb::walk
