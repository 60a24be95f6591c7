#include "fit/star_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stilb::fit {
namespace {

constexpr int kParallels = 317;
constexpr double kSamePlace = 1e-5;  ///< of the size
const double kCosineApart = std::cos(10 * std::numbers::pi / 180);

bool is_apart(const Vec3& direction, const Vec3& other) { return dot(direction, other) < kCosineApart; }

/// The first ones that are apart from each other.
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
        } else if (depth > kSamePlace * size) {
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
