// Two lamps in one place give the light, and show the luminance, of one with that of both.
#include <gtest/gtest.h>

#include "estimators/estimator_list.h"
#include "materials/plastic.h"
#include "run/run.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

const Rectangle kPanel{{1.7, 1.2, 2.5}, {0, 0.6, 0}, {0.6, 0, 0}};

Scene room_with(const std::vector<double>& luminances_cd_m2, const std::vector<Shape>& shapes) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.8}}, diffuse(0.5));
    // Glossy, so that rays by the BRDF find the lamps, too.
    add_object(scene, Rectangle{{1, 1, 0.5}, {1, 0, 0}, {0, 1, 0}},
               Plastic(Plastic::Parameters{Rgb::grey(0.2), 1.5, 0.2}));
    for (std::size_t i = 0; i < shapes.size(); ++i)
        add_area_light(scene, shapes[i], Rgb::grey(luminances_cd_m2[i]));
    return scene;
}

std::vector<statistics::Estimate> readings_of(const Scene& scene, const Sensor& sensor,
                                              std::string_view method) {
    RunOptions options;
    options.method = method;
    options.paths = 4096;
    options.patch_m = 1;
    std::vector<statistics::Estimate> readings;
    const RunResult result = measure(scene, {&sensor, 1}, options);
    for (const Reading& reading : result.sensors[0].readings) readings.push_back(reading.estimate);
    return readings;
}

void expect_equal(const std::vector<statistics::Estimate>& a, const std::vector<statistics::Estimate>& b,
                  std::string_view method) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double error = std::hypot(a[i].standard_error, b[i].standard_error);
        EXPECT_NEAR(a[i].value, b[i].value, 4 * error + 1e-6 * b[i].value) << method << ' ' << i;
    }
}

TEST(LampsInOnePlace, AddUp) {
    // The same corners, beginning with another one.
    const Rectangle turned{kPanel.corner + kPanel.edge_u, kPanel.edge_v, -kPanel.edge_u};
    const Scene two = room_with({1000, 300}, {kPanel, turned}), one = room_with({1300}, {kPanel});
    const Sensor points = point_sensor({{{2, 1.5, 0.8}, {0, 0, 1}}, {{0, 1.5, 1}, {1, 0, 0}}});
    const Sensor sights{"sights", Luminance{{LineOfSight{{1, 1, 1}, normalized({1, 0.5, 1.5})},
                                             LineOfSight{{1.2, 1.3, 1.5}, normalized({0.3, 0.2, -1})},
                                             LineOfSight{{1, 1, 1}, {1, 0, 0}}}}};
    for (const char* method : {"auto", "local", "path"})
        expect_equal(readings_of(two, points, method), readings_of(one, points, method), method);
    for (const char* method : {"auto", "double-local", "path"}) {
        const auto seen = readings_of(two, sights, method);
        EXPECT_NEAR(seen[0].value, 1300, 1e-3) << method;
        expect_equal(seen, readings_of(one, sights, method), method);
    }
}

/// Lamps whose planes only cross, or that face away from each other, stay apart.
TEST(LampsInOnePlace, OnlyWhereTheyCoincide) {
    const Rectangle back{kPanel.corner, kPanel.edge_v, kPanel.edge_u};
    const Sensor sights{"sights", Luminance{{LineOfSight{{1, 1, 1}, normalized({1, 0.5, 1.5})},
                                             LineOfSight{{1.9, 1.4, 2.7}, {0, 0, -1}}}}};
    Rectangle below = kPanel;
    below.corner.z -= 0.001;
    const Scene scene = room_with({1000, 300, 100}, {below, back, kPanel});
    const auto seen = readings_of(scene, sights, "path");
    EXPECT_NEAR(seen[0].value, 1000, 1e-3);
    EXPECT_NEAR(seen[1].value, 300, 1e-3);
}

}  // namespace
}  // namespace stilb::run
