#include "fit/radial_caster.h"

#include <cstddef>
#include <optional>

namespace stilb::fit {
namespace {

Scene scene_of(const Mesh& mesh) {
    Scene scene;
    scene.materials.push_back({"surface", Black{}});
    scene.objects.push_back({"mesh", mesh, {MaterialId{0}}});
    return scene;
}

}  // namespace

RadialCaster::RadialCaster(const Mesh& mesh) : scene_(scene_of(mesh)), caster_(scene_) {}

std::vector<double> RadialCaster::outermost(const Vec3& center, std::span<const Vec3> directions) const {
    const double beyond = 1.01 * (length(center - caster_.center()) + 2 * caster_.half_extent_m());
    std::vector<rays::Ray> rays;
    rays.reserve(directions.size());
    for (const Vec3& direction : directions) rays.push_back({center + beyond * direction, -direction});
    return distances(center, directions, rays);
}

std::vector<double> RadialCaster::innermost(const Vec3& center, std::span<const Vec3> directions) const {
    std::vector<rays::Ray> rays;
    rays.reserve(directions.size());
    for (const Vec3& direction : directions) rays.push_back({center, direction});
    return distances(center, directions, rays);
}

/// Rays from outside may go on through the centre to the other side: then they met nothing.
std::vector<double> RadialCaster::distances(const Vec3& center, std::span<const Vec3> directions,
                                            std::span<const rays::Ray> rays) const {
    std::vector<std::optional<rays::Hit>> hits(rays.size());
    // Coherent packets about an axis, where a component of the directions nearly vanishes, lose rays in
    // Embree 3.13.
    caster_.closest(rays, rays::Coherence::scattered, hits);
    std::vector<double> distances;
    distances.reserve(hits.size());
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const double along = hits[i] ? dot(hits[i]->position - center, directions[i]) : -1;
        distances.push_back(along > 0 ? along : kNoSurface);
    }
    return distances;
}

}  // namespace stilb::fit
