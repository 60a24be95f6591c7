#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "verification/case_families.h"
#include "verification/case_scenes.h"
#include "verification/sobolev_scene.h"

namespace stilb::verification {
namespace {

constexpr double kLargestRadius = 5;
/// Beyond it light is so rare that methods which trace paths from every point take many times as long.
constexpr double kFarRadius = 2.5;

/// The luminance rho E / pi of plane 1 at two radii towards ten directions each, as it leaves the plane and
/// as it is seen from a little way off.
std::vector<ExactReading> seen_lower_plane(const exact::ParallelPlanes& planes) {
    constexpr double distance_m = 0.4;
    const exact::SobolevProblem problem(planes);
    std::vector<ExactReading> readings;
    for (const double radius_m : {0.0, 0.6}) {
        const auto [position, normal] = sobolev_point(planes, exact::Plane::first, radius_m, radius_m);
        const double luminance_cd_m2 = planes.reflectance_1 * std::numbers::inv_pi *
                                       problem.illuminance_lx(exact::Plane::first, radius_m);
        for (const Vec3& direction : spread_directions(20)) {
            if (direction.z < 0) continue;
            readings.push_back({EmergentRay{position, normal, direction}, luminance_cd_m2});
            readings.push_back({LineOfSight{position + distance_m * direction, -direction}, luminance_cd_m2});
        }
    }
    return readings;
}

/// Illuminance near the axis for all methods, and far from it; luminance.
std::array<VerificationCase, 3> cases_between(const exact::ParallelPlanes& planes) {
    constexpr int radii = 20;
    const exact::SobolevProblem problem(planes);
    const std::string variant =
        fmt::format("p1 {}, p2 {}, h1 {}", planes.reflectance_1, planes.reflectance_2, planes.distance_1_m);
    const Scene scene = make_sobolev_scene(planes, kLargestRadius);
    const std::string note = fmt::format(
        "squares stand in for the infinite planes, so large that the exact values change by less than {} %.\n"
        "  Of the {} radii from 0 to {}, those beyond {} (\"far\") are for method local alone: so little "
        "light\n"
        "  comes there that the others take 10 to 100 times as long.",
        100 * kLargestTruncation, radii, kLargestRadius, kFarRadius);
    VerificationCase near{"sobolev", variant + ", near", scene, {}, "", note};
    VerificationCase far{"sobolev", variant + ", far", scene, {}, "local", note};
    for (int i = 0; i < radii; ++i) {
        const double radius_m = kLargestRadius * i / (radii - 1);
        for (const exact::Plane plane : {exact::Plane::first, exact::Plane::second}) {
            (radius_m < kFarRadius ? near : far)
                .readings.push_back({sobolev_point(planes, plane, radius_m, i * kGoldenAngle),
                                     problem.illuminance_lx(plane, radius_m)});
        }
    }
    return {near, far, {"sobolev", variant + ", luminance", scene, seen_lower_plane(planes), "", note}};
}

}  // namespace

std::vector<VerificationCase> sobolev_cases() {
    std::vector<VerificationCase> cases;
    constexpr std::array<std::array<double, 3>, 4> values{
        {{0.5, 0.5, 0.5}, {0.8, 0.3, 0.25}, {0.7, 0.9, 0.5}, {0.2, 0.7, 0.8}}};
    for (const auto& [reflectance_1, reflectance_2, distance_1_m] : values) {
        const exact::ParallelPlanes planes{reflectance_1, reflectance_2, distance_1_m, 1 - distance_1_m, 1};
        for (VerificationCase& c : cases_between(planes)) {
            cases.push_back(std::move(c));
        }
    }
    return cases;
}

}  // namespace stilb::verification
