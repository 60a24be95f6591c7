#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "materials/black.h"
#include "papers/estimate_series.h"
#include "verification/verification.h"

namespace stilb::papers {
namespace {

constexpr exact::ParallelPlanes kPlanes{0.5, 0.5, 0.5, 0.5, 1};

/// The diffuse planes with a sphere as the source: as bright as the point source, and it hides little.
Scene planes_with_sphere(double radius_m) {
    Scene scene = verification::make_sobolev_scene(kPlanes, 1);
    scene.materials.push_back({"source", Black{}});
    scene.objects.push_back({"source", Sphere{{0, 0, kPlanes.distance_1_m}, radius_m}, {MaterialId{2}}});
    const double luminance = kPlanes.intensity_cd / (std::numbers::pi * radius_m * radius_m);
    scene.lights = {{"source", AreaLight{ObjectId{2}, Rgb::grey(luminance)}}};
    return scene;
}

TEST(MultiplyReflected, IsSobolevsSolutionLessTheFirstReflection) {
    Luminance rays;
    for (const double r : {0.25, 1.0}) rays.sights.emplace_back(EmergentRay{{r, 0, 0}, {0, 0, 1}, {0, 0, 1}});
    const Sensor sensor{"along", rays};
    RunOptions options;
    options.method = "double-local";
    options.paths = 16384;
    options.replicates = 2;
    const std::vector<statistics::Estimate> measured =
        multiply_reflected_cd_m2(planes_with_sphere(0.01), sensor, options, 8);
    const exact::SobolevProblem problem(kPlanes);
    for (std::size_t j = 0; j < measured.size(); ++j) {
        const double r = position_of(rays.sights[j]).x;
        const double direct_lx = 0.5 / std::pow(0.25 + r * r, 1.5);
        const double reflected_lx = problem.illuminance_lx(exact::Plane::first, r) - direct_lx;
        const double exact_cd_m2 = kPlanes.reflectance_1 * reflected_lx / std::numbers::pi;
        EXPECT_NEAR(measured[j].value, exact_cd_m2, 4 * measured[j].standard_error) << r;
        // The first reflection leaves no noise, though at r = 0.25 it is more than five times as bright.
        EXPECT_LT(measured[j].standard_error, 0.01 * exact_cd_m2) << r;
    }
}

}  // namespace
}  // namespace stilb::papers
