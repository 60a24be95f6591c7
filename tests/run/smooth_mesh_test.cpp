// Coarse meshes with vertex normals look like the bodies that they stand for.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "materials/phong.h"
#include "materials/rough_conductor.h"
#include "run/run.h"
#include "support/scene_builder.h"

namespace stilb {
namespace {

const Sphere kBall{{0, 0, 0}, 1};
const Vec3 kDistantEye{6, 0, 0};

/// Sights of the ball, but for its rim: outlines of meshes are as coarse as they are.
std::vector<Measurand> ball_sights() {
    constexpr int kSteps = 60;
    std::vector<Measurand> all;
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
            const Vec3 to{0, 2.2 * ((i + 0.5) / kSteps - 0.5), 2.2 * ((j + 0.5) / kSteps - 0.5)};
            if (to.y * to.y + to.z * to.z > 0.8 * 0.8) continue;
            all.emplace_back(LineOfSight{kDistantEye, normalized(to - kDistantEye)});
        }
    }
    return all;
}

/// Reflected once, which is exact under a point light.
std::vector<double> luminances(const Shape& ball, const Material& material, const Vec3& light) {
    Scene scene;
    add_object(scene, ball, material);
    add_point_light(scene, light, Rgb::grey(1000));
    RunOptions options;
    options.method = "double-local";
    options.paths = 32;
    options.bounces = 1;
    const std::vector<Sensor> sensors{{"sights", Luminance{ball_sights()}}};
    const RunResult result = run::measure(scene, sensors, options);
    std::vector<double> values;
    for (const Reading& reading : result.sensors[0].readings) values.push_back(reading.estimate.value);
    return values;
}

/// Root mean square of what is off, over that of the ball itself.
double off_by(const std::vector<double>& mesh, const std::vector<double>& ball) {
    double squares = 0, all = 0;
    for (std::size_t i = 0; i < ball.size(); ++i) {
        squares += (mesh[i] - ball[i]) * (mesh[i] - ball[i]);
        all += ball[i] * ball[i];
    }
    return std::sqrt(squares / all);
}

TEST(SmoothMesh, LooksMoreLikeTheBodyThanItsFacets) {
    struct Case {
        std::string name;
        Material material;
        double most;  ///< what is off with vertex normals over what is off with facets
    };
    const std::vector<Case> cases{{"diffuse", diffuse(0.8), 0.6},
                                  {"phong", Phong{Rgb::grey(0.3), Rgb::grey(0.5), 20}, 0.6},
                                  {"rough", RoughConductor({Rgb::grey(0.9), 0.3}), 0.6}};
    for (const Case& of : cases) {
        for (const Vec3& light : {Vec3{10, 0, 3}, Vec3{5, 8, 5}, Vec3{-3, 8, 5}}) {
            const std::vector<double> ball = luminances(kBall, of.material, light);
            const double facets = off_by(luminances(icosphere(kBall, 2), of.material, light), ball);
            const double smooth = off_by(luminances(smooth_icosphere(kBall, 2), of.material, light), ball);
            EXPECT_LT(smooth, of.most * facets) << of.name << ' ' << light.x;
            RecordProperty(of.name + std::to_string(light.x), std::to_string(smooth / facets));
        }
    }
}

}  // namespace
}  // namespace stilb
