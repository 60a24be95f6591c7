
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "materials/diffuse.h"
#include "math/sampling.h"
#include "verification/verification.h"

namespace stilb::verification {

namespace {

using exact::Plane;

/// The smallest power of two for which the bound of the loss at `radius_m` is small enough. The loss grows
/// with the radius.
double half_size_m(const exact::ParallelPlanes& planes, double radius_m) {
    const exact::SobolevProblem problem(planes);
    const auto is_enough = [&](Plane plane, double half_size) {
        return problem.truncation_bound_lx(plane, radius_m, half_size) <=
               kLargestTruncation * problem.illuminance_lx(plane, radius_m);
    };
    double half_size = planes.distance_1_m + planes.distance_2_m;
    while (half_size <= radius_m || !is_enough(Plane::first, half_size) ||
           !is_enough(Plane::second, half_size)) {
        half_size *= 2;
    }
    return half_size;
}

Rectangle square(double z, double half_size) {
    return {{-half_size, -half_size, z}, {2 * half_size, 0, 0}, {0, 2 * half_size, 0}};
}

}  // namespace

Scene make_sobolev_scene(const exact::ParallelPlanes& planes, double largest_radius_m) {
    const double separation_m = planes.distance_1_m + planes.distance_2_m;
    const double half_size = half_size_m(planes, largest_radius_m);
    Scene scene;
    scene.materials = {{"plane 1", Diffuse{Rgb::grey(planes.reflectance_1)}},
                       {"plane 2", Diffuse{Rgb::grey(planes.reflectance_2)}}};
    scene.objects = {{"plane 1", square(0, half_size), {MaterialId{0}}},
                     {"plane 2", square(separation_m, half_size), {MaterialId{1}}}};
    scene.lights = {{"source", PointLight{{0, 0, planes.distance_1_m}, Rgb::grey(planes.intensity_cd)}}};
    return scene;
}

MeasuringPoint sobolev_point(const exact::ParallelPlanes& planes, Plane plane, double radius_m,
                             double azimuth_rad) {
    const double x = radius_m * std::cos(azimuth_rad), y = radius_m * std::sin(azimuth_rad);
    if (plane == Plane::first) return {{x, y, 0}, {0, 0, 1}};
    return {{x, y, planes.distance_1_m + planes.distance_2_m}, {0, 0, -1}};
}

namespace {

constexpr double kLargestRadius = 5;
/// The largest radius for all methods: beyond it light is so rare that methods which trace paths from every
/// point take many times as long.
constexpr double kFarRadius = 2.5;

/// The luminance rho E / pi of plane 1 at two radii in ten directions each, as emergent rays and
/// as lines of sight from a small distance.
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
        "squares replace the infinite planes, so large that the exact values change by less than {} %.\n"
        "  Of the {} radii from 0 to {}, those beyond {} (\"far\") are for method local alone: so little "
        "light\n"
        "  arrives there that the other methods take 10 to 100 times as long.",
        100 * kLargestTruncation, radii, kLargestRadius, kFarRadius);
    VerificationCase near{"sobolev", variant + ", near", scene, {}, "", note};
    VerificationCase far{"sobolev", variant + ", far", scene, {}, "local", note};
    for (int i = 0; i < radii; ++i) {
        const double radius_m = kLargestRadius * i / (radii - 1);
        for (const exact::Plane plane : {exact::Plane::first, exact::Plane::second}) {
            (radius_m < kFarRadius ? near : far)
                .readings.push_back({sobolev_point(planes, plane, radius_m, i * math::kGoldenAngle),
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
