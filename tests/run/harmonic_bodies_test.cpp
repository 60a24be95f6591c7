// Illuminances on a sphere and an ellipsoid that are series, by a point light, against the exact ones.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "run/run.h"
#include "support/harmonic_shapes.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

constexpr double kReflectance = 0.6, kIntensity_cd = 800;
constexpr Vec3 kCenter{5, -3, 2}, kLight{6.5, -1.2, 4.1};

/// The front of an ellipsoid about kCenter, x in its own coordinates.
struct Ellipsoid {
    Vec3 axes;

    Vec3 point_towards(const Vec3& d) const {
        return d / length(Vec3{d.x / axes.x, d.y / axes.y, d.z / axes.z});
    }
    Vec3 normal_at(const Vec3& x) const {
        return normalized({x.x / (axes.x * axes.x), x.y / (axes.y * axes.y), x.z / (axes.z * axes.z)});
    }
};

/// Of cosines: what single precision leaves of positions and normals.
constexpr double kAllowed = 1e-6;

/// Lines of sight onto points all over, each along the normal.
void expect_exact_illuminances(const Ellipsoid& body, int degree) {
    constexpr int count = 400;
    Harmonics harmonics(ellipsoid_surface(body.axes, degree));
    harmonics.center = kCenter;
    Scene scene;
    add_object(scene, harmonics, diffuse(kReflectance));
    add_point_light(scene, kLight, Rgb::grey(kIntensity_cd));

    Numbers numbers(9);
    Luminance lines;
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
        points.push_back(body.point_towards(numbers.direction()));
        const Vec3 normal = body.normal_at(points.back());
        lines.sights.emplace_back(LineOfSight{kCenter + points.back() + normal, -normal});
    }
    RunOptions options;
    options.method = "path";
    options.paths = 64;
    const Sensor sensor{"luminance", lines};
    const RunResult result = measure(scene, {&sensor, 1}, options);

    int lit = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 to_light = kLight - kCenter - points[i];
        const double cosine = dot(body.normal_at(points[i]), normalized(to_light));
        lit += cosine > 0;
        const double per_cosine = kIntensity_cd / squared_length(to_light);
        const double found =
            result.sensors[0].readings[i].estimate.value * std::numbers::pi / kReflectance / per_cosine;
        EXPECT_NEAR(found, std::max(cosine, 0.0), kAllowed) << i;
    }
    EXPECT_GT(lit, count / 8);
}

TEST(HarmonicBodies, AreLitAsSpheresAre) { expect_exact_illuminances({{0.7, 0.7, 0.7}}, 0); }
TEST(HarmonicBodies, AreLitAsEllipsoidsAre) { expect_exact_illuminances({{1, 1.2, 0.9}}, 30); }

}  // namespace
}  // namespace stilb::run
