#include <fmt/format.h>

#include <numbers>

#include "exact/photometric_sphere.h"
#include "exact/two_surfaces.h"
#include "verification/case_families.h"
#include "verification/case_scenes.h"

namespace stilb::verification {
namespace {

constexpr double kPi = std::numbers::pi;

VerificationCase photometric_sphere_case(double reflectance) {
    constexpr double flux_lm = 1000;
    const exact::PhotometricSphere sphere{2, reflectance};
    const Vec3 center{1, -2, 3};
    const Vec3 source{0.8, -0.5, 0.7};  // from the centre
    VerificationCase result{"photometric sphere", fmt::format("rho {}", reflectance), {}, {}};
    add_object(result.scene, Sphere{center, sphere.radius_m}, diffuse(reflectance));
    result.scene.lights.push_back({"source", PointLight{center + source, Rgb::grey(flux_lm / (4 * kPi))}});
    for (const Vec3& to_wall : spread_directions(12)) {
        result.readings.push_back({MeasuringPoint{center + sphere.radius_m * to_wall, -to_wall},
                                   exact::illuminance_lx(sphere, flux_lm, source, to_wall)});
    }
    return result;
}

VerificationCase concentric_spheres_case(double inner_reflectance, double outer_reflectance) {
    constexpr double inner_m = 0.4, outer_m = 1, luminance_cd_m2 = 100;
    const auto [inner_lx, outer_lx] = exact::two_surface_illuminance_lx(
        {{{kPi * luminance_cd_m2, inner_reflectance}, {0, outer_reflectance}}},
        exact::concentric_sphere_form_factors(inner_m, outer_m));
    VerificationCase result{"concentric spheres",
                            fmt::format("rho {} inside, {} outside", inner_reflectance, outer_reflectance),
                            {},
                            {}};
    add_area_light(result.scene, add_object(result.scene, Sphere{{}, inner_m}, diffuse(inner_reflectance)),
                   luminance_cd_m2);
    add_object(result.scene, Sphere{{}, outer_m}, diffuse(outer_reflectance));
    for (const Vec3& direction : spread_directions(6)) {
        result.readings.push_back({MeasuringPoint{inner_m * direction, direction}, inner_lx});
        result.readings.push_back({MeasuringPoint{outer_m * direction, -direction}, outer_lx});
    }
    return result;
}

}  // namespace

std::vector<VerificationCase> sphere_cases() {
    std::vector<VerificationCase> cases;
    for (const double reflectance : {0.3, 0.8, 0.95}) cases.push_back(photometric_sphere_case(reflectance));
    cases.push_back(concentric_spheres_case(0.5, 0.8));
    return cases;
}

}  // namespace stilb::verification
