// Closed meshes, and whether they lose rays.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "geometry/transform.h"
#include "math/sampling.h"
#include "rays/ray_caster.h"
#include "support/random_pairs.h"
#include "support/scene_builder.h"

namespace stilb {

struct ClosedMesh {
    Mesh mesh;
    Vec3 inside;
};

inline ClosedMesh plain_box(double size_m) {
    const Vec3 edges{size_m, 0.7 * size_m, 0.6 * size_m};
    return {triangulated(Box{{0, 0, 0}, edges}), 0.5 * edges};
}

/// 20,480 triangles, every vertex moved towards or away from the middle.
inline ClosedMesh rough_sphere(double size_m) {
    Mesh mesh = icosphere({{}, size_m / 2}, 5);
    RandomPairs random(3);
    for (Vec3& vertex : mesh.vertices) vertex = (1 + 0.02 * random.next()) * vertex;
    return {mesh, {}};
}

/// Turned by odd angles, and moved a thousand times its size away.
inline ClosedMesh distant_box(double size_m) {
    ClosedMesh box = plain_box(size_m);
    geometry::Transform place = compose(geometry::Transform::rotation(normalized(Vec3{1, 2, 3}), 37.3),
                                        geometry::Transform::rotation({0, 1, 0}, 11.7));
    place.translation = size_m * Vec3{1000, -700, 300};
    for (Vec3& vertex : box.mesh.vertices) vertex = place.point(vertex);
    return {box.mesh, place.point(box.inside)};
}

/// Two large faces that meet at 10 degrees.
inline ClosedMesh acute_wedge(double size_m) {
    const double height = size_m * std::tan(10 * std::numbers::pi / 180);
    const Mesh mesh{{{0, 0, 0},
                     {size_m, 0, 0},
                     {size_m, 0, height},
                     {0, size_m, 0},
                     {size_m, size_m, 0},
                     {size_m, size_m, height}},
                    {{0, 1, 2}, {3, 5, 4}, {0, 4, 1}, {0, 3, 4}, {1, 4, 5}, {1, 5, 2}, {0, 2, 5}, {0, 5, 3}}};
    return {mesh, {0.6 * size_m, 0.5 * size_m, 0.3 * height}};
}

struct ClosedMeshEntry {
    std::string_view name;
    ClosedMesh (*make)(double size_m);
};
inline constexpr std::array kClosedMeshes{
    ClosedMeshEntry{"PlainBox", plain_box}, ClosedMeshEntry{"RoughSphere", rough_sphere},
    ClosedMeshEntry{"DistantBox", distant_box}, ClosedMeshEntry{"AcuteWedge", acute_wedge}};

/// How rays look for surfaces: scattered packets take another way than single rays.
enum class Queries { single, packets };

/// How many of about `rays` rays find no surface, of sixteen walks by diffuse reflection that begin inside
/// and begin anew where a ray is lost. Convex meshes lose every walk that gets outside.
inline std::uint64_t lost_rays(const Scene& scene, const Vec3& inside, Queries queries, std::uint64_t rays,
                               std::uint64_t seed) {
    const rays::RayCaster caster(scene);
    RandomPairs random(seed);
    const auto from_inside = [&] {
        const auto [u1, u2] = random.next_pair();
        return rays::Ray{inside, math::sample_sphere(u1, u2).direction};
    };
    std::vector<rays::Ray> walks;
    for (std::size_t i = 0; i < kPacketWidth; ++i) walks.push_back(from_inside());
    std::vector<std::optional<rays::Hit>> hits(walks.size());
    std::uint64_t lost = 0;
    for (std::uint64_t done = 0; done < rays; done += walks.size()) {
        if (queries == Queries::packets) {
            caster.closest(walks, rays::Coherence::scattered, hits);
        } else {
            std::ranges::transform(walks, hits.begin(), [&](const rays::Ray& ray) {
                return caster.closest(ray.origin, ray.direction);
            });
        }
        for (std::size_t i = 0; i < walks.size(); ++i) {
            if (!hits[i]) {
                ++lost;
                walks[i] = from_inside();
                continue;
            }
            const auto [u1, u2] = random.next_pair();
            walks[i] = {
                hits[i]->lifted,
                Frame::around(hits[i]->normal).to_world(math::sample_cosine_hemisphere(u1, u2).direction)};
        }
    }
    return lost;
}

inline std::uint64_t lost_rays(const ClosedMesh& closed, Queries queries, std::uint64_t rays,
                               std::uint64_t seed) {
    Scene scene;
    add_object(scene, closed.mesh, diffuse(0.5));
    return lost_rays(scene, closed.inside, queries, rays, seed);
}

}  // namespace stilb
