// Points exactly on edges, in corners and in the planes of walls, and lines of sight that end there, by all
// methods: readings are the limits from inside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "estimators/estimator_list.h"
#include "exact/configuration_factors.h"
#include "materials/black.h"
#include "rays/ray_caster.h"
#include "run/run.h"
#include "sensors/place.h"
#include "statistics/hypothesis.h"
#include "support/random_pairs.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

constexpr double kWallLuminance = 100, kWallReflectance = 0.5;
/// In a furnace, and everywhere in it.
constexpr double kFurnace_cd_m2 = kWallLuminance / (1 - kWallReflectance);
const Box kCube{{0, 0, 0}, {2, 2, 2}};
const Box kStanding{{0.5, 0.5, 0}, {1.2, 0.9, 0.6}};

void add_furnace(Scene& scene, const Shape& shape) {
    add_area_light(scene, shape, Rgb::grey(kWallLuminance), diffuse(kWallReflectance));
}

/// In one mesh, and in six objects; with a box that stands on the floor, whose inside is dark.
std::vector<Scene> furnaces() {
    std::vector<Scene> scenes(2);
    add_furnace(scenes[0], inward(kCube));
    for (std::size_t i = 0; i < 6; ++i)
        add_furnace(scenes[1], wall(kCube, i / 2, i % 2 == 0 ? Side::low : Side::high));
    for (Scene& scene : scenes) add_furnace(scene, kStanding);
    return scenes;
}

struct Point {
    std::string name;
    MeasuringPoint point;
};
std::vector<Point> points_on_edges() {
    const Vec3 up{0, 0, 1};
    return {{"edge", {{0, 1, 0}, up}},
            {"another edge", {{1.5, 2, 0}, up}},
            {"corner", {{0, 0, 0}, up}},
            {"corner of the ceiling", {{2, 2, 2}, {-1, 0, 0}}},
            {"in a wall", {{0, 1, 0.8}, up}},
            {"in two walls", {{0, 0, 0.8}, up}},
            {"on a wall", {{0, 1, 0.8}, {1, 0, 0}}},
            {"on an edge, obliquely", {{0, 1, 0}, normalized({1, 0, 1})}},
            {"in a corner, obliquely", {{2, 0, 0}, normalized({-1, 1, 1})}},
            {"upright on the floor", {{1.5, 1.5, 0}, {1, 0, 0}}},
            {"obliquely on the floor", {{1.5, 1.5, 0}, normalized({1, 0, 3})}},
            {"foot of the box", {{0.5, 0.7, 0}, up}},
            {"corner of its foot", {{0.5, 0.5, 0}, up}},
            {"its side, at the foot", {{0.5, 0.7, 0}, {-1, 0, 0}}},
            {"its upper edge", {{0.5, 0.7, 0.6}, up}},
            {"its upper corner", {{1.2, 0.9, 0.6}, up}},
            {"its side, at the upper edge", {{0.5, 0.7, 0.6}, {-1, 0, 0}}},
            {"in its side", {{0.5, 0.7, 0.3}, up}}};
}

Sensor edge_sights() {
    const Vec3 eye{0.1, 0.3, 1};
    std::vector<Measurand> lines;
    for (const Vec3& end : {Vec3{2, 2, 2}, Vec3{2, 2, 1}, Vec3{2, 1, 0}, Vec3{2, 2, 1.99999},
                            Vec3{0.5, 0.7, 0}, Vec3{0.5, 0.5, 0}, Vec3{0.5, 0.5, 0.6}})
        lines.push_back(LineOfSight{eye, normalized(end - eye)});
    lines.push_back(LineOfSight{{0, 0, 1}, {1, 0, 0}});
    lines.push_back(LineOfSight{{0, 0, 1}, normalized({1, 1, 0.3})});
    return {"sights", Luminance{lines}};
}

/// With both of `auto`, and without those that this does not suit: connections without bounds have an
/// infinite variance next to bright walls, and the form factors of method radiosity an error of per cents
/// between patches that touch.
std::vector<std::string> methods() {
    std::vector<std::string> names;
    for (const estimators::EstimatorEntry& method : estimators::estimator_list()) {
        if (method.name != "local" && method.name != "double-local" && method.name != "radiosity")
            names.emplace_back(method.name);
    }
    return names;
}

RunOptions edge_options(const std::string& method) {
    RunOptions options;
    options.method = method;
    options.paths =
        method == "ray-bundle" || method == "guided" ? 512 : 1 << 13;  // a step does more than a path
    options.patch_m = 0.25;
    return options;
}

/// By z-scores; `rounding`: the relative error of patches and of single precision.
void expect_exact(const SensorResult& sensor, int replicates, double exact, double rounding,
                  const std::vector<Point>& points = {}) {
    for (std::size_t i = 0; i < sensor.readings.size(); ++i) {
        const statistics::Estimate& e = sensor.readings[i].estimate;
        const double error = std::hypot(e.standard_error, rounding * exact);
        EXPECT_LT(error, 0.05 * exact);
        const double z = statistics::equivalent_z((e.value - exact) / error, replicates - 1);
        EXPECT_LT(std::abs(z), 4.2) << sensor.sensor.name << ' '
                                    << (points.empty() ? std::to_string(i) : points[i].name) << ": "
                                    << e.value << " +- " << e.standard_error << ", right: " << exact;
    }
}

class EdgePointsBy : public testing::TestWithParam<std::string> {};

TEST_P(EdgePointsBy, ReadTheFurnacesTheyAreIn) {
    const std::string& method = GetParam();
    const std::vector<Point> points = points_on_edges();
    std::vector<MeasuringPoint> at;
    for (const Point& point : points) at.push_back(point.point);
    const std::vector<Sensor> sensors{point_sensor(at), edge_sights()};
    for (const Scene& scene : furnaces()) {
        SCOPED_TRACE(scene.objects.size() == 2 ? "one mesh" : "six objects");
        const RunResult result = measure(scene, sensors, edge_options(method));
        expect_exact(result.sensors[0], result.replicates, kPi * kFurnace_cd_m2, 1e-3, points);
        expect_exact(result.sensors[1], result.replicates, kFurnace_cd_m2, 1e-3);
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, EdgePointsBy, testing::ValuesIn(methods()), [](const auto& method) {
    std::string name = method.param;
    std::erase(name, '-');
    return name;
});

/// From above into the corners and edges of a box that stands in a room: by rounding, one ray in six slips
/// into the box and meets a face from behind, which no light reaches.
TEST(EdgePoints, SightsIntoCornersEndWhereTheEyeSeesThem) {
    for (const Scene& scene : furnaces()) {
        const rays::RayCaster caster(scene);
        RandomPairs random(3);
        std::size_t ends = 0, unseen = 0;
        while (ends < 10'000) {
            Vec3 eye;
            for (double* x : {&eye.x, &eye.y, &eye.z}) *x = 0.02 + 1.96 * random.next();
            if (eye.z < 0.7) continue;  // above the box
            for (const double x : {0.5, 0.8, 1.2}) {
                for (const double y : {0.5, 0.9}) {
                    for (const double z : {0.0, 0.6}) {
                        const Vec3 end{x, y, z};
                        const auto hit = caster.closest(eye, normalized(end - eye));
                        if (!hit || length(hit->position - end) > 1e-4) continue;
                        const rays::Hit clear = sensors::clear_of_walls(*hit, eye, caster);
                        ++ends;
                        if (caster.occluded(eye, clear.lifted) || !clear.on_front) ++unseen;
                    }
                }
            }
        }
        EXPECT_LT(unseen, 0.001 * static_cast<double>(ends));
    }
}

/// Only a wall that is as near as rounding errors may be crossed.
TEST(EdgePoints, StayOnTheirSideOfAWall) {
    Scene scene;
    add_object(scene, Box{{-50, -50, -50}, {50, 50, 50}}, diffuse(0.5));
    add_object(scene, Box{{0, 0, 0}, {0.1, 0.1, 0.1}}, diffuse(0.5));
    const rays::RayCaster caster(scene);
    const double offset_m = caster.offset_m({}, caster.lift().largest_size_m());
    for (const double offsets : {-7.0, -5.0, -3.0, 3.0, 5.0, 7.0}) {
        for (const Vec3& normal : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0, -1, 0}}) {
            const double x = offsets * offset_m;
            const sensors::Place place = sensors::place_of(MeasuringPoint{{x, 0.05, 0.05}, normal}, caster);
            EXPECT_EQ(place.position.x > 0, offsets > 0) << offsets;
            EXPECT_EQ(place.lifted.x > 0, offsets > 0) << offsets;
        }
    }
}

/// A sphere on an edge lies on the floor, which hides half of it; the wall does not.
TEST(EdgePoints, ASphereOnAnEdgeSeesTheUpperHalf) {
    const std::vector<Sensor> spheres{{"spheres", Spherical{{{0, 1, 0}, {2, 2, 0}}}}};
    for (const Scene& scene : furnaces()) {
        const RunResult result = measure(scene, spheres, edge_options("path"));
        expect_exact(result.sensors[0], result.replicates, kPi * kFurnace_cd_m2 / 2, 1e-3);
    }
}

/// In a black box, fronts outside, around a lamp in its middle: the inverse square law. It has no other
/// light, so that a point on the wrong side of a wall reads 0.
TEST(EdgePoints, OfABlackBoxAroundALamp) {
    for (const double side_m : {0.02, 2.0, 200.0}) {
        for (const Vec3& corner : {Vec3{}, Vec3{0.3, -0.7, 0.1}}) {
            Scene scene;
            add_object(scene, Box{corner, corner + Vec3{side_m, side_m, side_m}}, Black{});
            const Vec3 lamp = corner + Vec3{side_m / 2, side_m / 2, side_m / 2};
            add_point_light(scene, lamp, Rgb::grey(100));
            std::vector<MeasuringPoint> points;
            for (const double x : {0.0, 0.4, 1.0}) {
                for (const double y : {0.0, 0.5, 1.0}) {
                    points.push_back({corner + side_m * Vec3{x, y, 0}, {0, 0, 1}});
                    points.push_back({corner + side_m * Vec3{1, x, y}, {-1, 0, 0}});
                    points.push_back({corner + side_m * Vec3{x, 1, y}, {0, -1, 0}});
                }
            }
            const std::vector<Sensor> sensors{point_sensor(points)};
            for (const std::string_view method : {"path", "auto"}) {
                RunOptions options;
                options.method = method;
                options.paths = 64;
                const auto readings = measure(scene, sensors, options).sensors[0].readings;
                for (std::size_t i = 0; i < points.size(); ++i) {
                    const Vec3 to_lamp = lamp - points[i].position;
                    const double exact_lx =
                        100 * dot(to_lamp, points[i].normal) / std::pow(length(to_lamp), 3);
                    EXPECT_NEAR(readings[i].estimate.value / exact_lx, 1, 3e-4)
                        << method << ", side " << side_m << " m, " << i;
                }
            }
        }
    }
}

/// At the foot of a wall that shines, in a black room: half of what is above the floor is the wall. (In the
/// corner with a black wall the limit depends on where it is approached from.)
TEST(EdgePoints, AtTheFootOfAWallThatShines) {
    const Rectangle shining = wall(kCube, 0, Side::low);
    Scene scene;
    add_object(scene, kCube, Black{});
    add_area_light(scene, shining, Rgb::grey(kWallLuminance));
    std::vector<MeasuringPoint> points;
    for (const double y : {0.1, 0.3, 1.0, 1.7}) points.push_back({{0, y, 0}, {0, 0, 1}});
    const std::vector<Sensor> sensors{point_sensor(points)};
    for (const std::string_view method : {"path", "auto", "local"}) {
        RunOptions options;
        options.method = method;
        options.paths = 1 << 13;
        const auto readings = measure(scene, sensors, options).sensors[0].readings;
        for (std::size_t i = 0; i < points.size(); ++i) {
            // Inside by so little that it does not matter.
            const Vec3 inside = points[i].position + 1e-5 * (Vec3{1, 1, 1} - points[i].position);
            const double exact_lx =
                exact::illuminance_by_rectangle_lx({{inside.x, inside.y, 0}, {0, 0, 1}}, shining.corner,
                                                   shining.edge_u, shining.edge_v, kWallLuminance);
            const statistics::Estimate& e = readings[i].estimate;
            EXPECT_NEAR(e.value, exact_lx, 4 * e.standard_error + 1e-3 * exact_lx) << method << ' ' << i;
            EXPECT_LT(e.standard_error, 0.01 * exact_lx) << method << ' ' << i;
        }
    }
}

/// Points that are no nearer to a wall than its rays' offsets need stay where they are.
TEST(EdgePoints, OnlyPointsNearAWallMove) {
    Scene scene;
    add_object(scene, kCube, Black{});
    add_point_light(scene, {1, 1, 1}, Rgb::grey(100));
    const rays::RayCaster caster(scene);
    const double margin_m = rays::kEdgeMargin * caster.offset_m({0, 1, 0}, caster.lift().largest_size_m());
    const auto moves = [&](double x, double z) {
        const MeasuringPoint point{{x, 0.7, z}, {0, 0, 1}};
        return !(place_of(point, caster).position == point.position);
    };
    for (const double z : {0.0, 0.8}) {
        EXPECT_TRUE(moves(0, z));
        EXPECT_TRUE(moves(0.9 * margin_m, z));
        EXPECT_FALSE(moves(1.1 * margin_m, z));
        EXPECT_TRUE(moves(2 - 0.9 * margin_m, z));
        EXPECT_FALSE(moves(2 - 1.1 * margin_m, z));
    }
}

}  // namespace
}  // namespace stilb::run
