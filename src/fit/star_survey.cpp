
#include "fit/star_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include "materials/black.h"

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

/// Rays from outside may continue through the centre to the other side: then they met nothing.
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

namespace {

constexpr int kParallels = 317;
constexpr double kSamePosition = 1e-5;  ///< of the size
const double kCosineApart = std::cos(10 * std::numbers::pi / 180);

bool is_apart(const Vec3& direction, const Vec3& other) { return dot(direction, other) < kCosineApart; }

/// The first ones that are separated from each other.
std::vector<Fold> separate(const std::vector<Fold>& folds) {
    std::vector<Fold> chosen;
    for (const Fold& fold : folds) {
        if (chosen.size() == kMostNamed) break;
        const bool is_new = std::all_of(chosen.begin(), chosen.end(), [&](const Fold& other) {
            return is_apart(fold.direction, other.direction);
        });
        if (is_new) chosen.push_back(fold);
    }
    return chosen;
}

}  // namespace

StarSurvey survey(const RadialCaster& caster, const Vec3& center, double size) {
    StarSurvey survey{geometry::even_grid(kParallels), {}, 0, 0, {}, {}};
    const std::vector<Vec3> directions = survey.grid.directions();
    survey.outermost = caster.outermost(center, directions);
    const std::vector<double> innermost = caster.innermost(center, directions);
    std::vector<Fold> folds, misses;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const double share = survey.grid.weights_sr[i / survey.grid.azimuths] / (4 * std::numbers::pi);
        const double depth = survey.outermost[i] - innermost[i];
        if (std::isnan(depth)) {
            survey.missed_share += share;
            misses.push_back({directions[i], 0});
        } else if (depth > kSamePosition * size) {
            survey.folded_share += share;
            folds.push_back({directions[i], depth});
        }
    }
    std::stable_sort(folds.begin(), folds.end(),
                     [](const Fold& a, const Fold& b) { return a.depth > b.depth; });
    survey.worst_folds = separate(folds);
    for (const Fold& miss : separate(misses)) survey.misses.push_back(miss.direction);
    return survey;
}

Angles angles_of(const Vec3& direction) {
    constexpr double degrees = 180 / std::numbers::pi;
    const double phi = std::atan2(direction.y, direction.x) * degrees;
    return {std::acos(std::clamp(direction.z, -1.0, 1.0)) * degrees, phi < 0 ? phi + 360 : phi};
}

std::string named_direction(const Vec3& direction) {
    const Angles angles = angles_of(direction);
    return fmt::format("({:.3f}, {:.3f}, {:.3f}), theta {:.1f}, phi {:.1f} degrees", direction.x, direction.y,
                       direction.z, angles.theta_deg, angles.phi_deg);
}

}  // namespace stilb::fit
