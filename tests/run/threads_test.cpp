// The number of threads changes no bit of a result.
#include <gtest/gtest.h>

#include <optional>

#include "materials/phong.h"
#include "run/run.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

/// As measured by one thread and by others.
void expect_same(const char* method, const Scene& scene, const std::vector<Sensor>& sensors, int replicates,
                 std::optional<double> error = {}) {
    const auto measure = [&](int threads) {
        RunOptions options;
        options.method = method;
        options.paths = 2048;
        options.error = error;
        options.threads = threads;
        return run::measure(scene, sensors, options);
    };
    const RunResult one = measure(1);
    EXPECT_EQ(one.replicates, replicates);
    for (const int threads : {1, 2, 3}) {
        const RunResult other = measure(threads);
        EXPECT_EQ(other.samples, one.samples);
        EXPECT_EQ(other.rays, one.rays);
        EXPECT_EQ(other.attained_error, one.attained_error);
        EXPECT_EQ(other.warnings, one.warnings);
        for (std::size_t s = 0; s < sensors.size(); ++s) {
            EXPECT_EQ(other.sensors[s].summary.uniformity, one.sensors[s].summary.uniformity);
            for (std::size_t j = 0; j < sensors[s].size(); ++j) {
                const Reading &a = other.sensors[s].readings[j], &b = one.sensors[s].readings[j];
                EXPECT_EQ(a.estimate, b.estimate) << threads << " threads, reading " << j;
                EXPECT_EQ(a.rgb, b.rgb) << threads << " threads, reading " << j;
            }
        }
    }
}

class Threads : public testing::TestWithParam<const char*> {};

TEST_P(Threads, ChangeNoBit) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.8}}, Phong{Rgb::grey(0.4), Rgb::grey(0.3), 10});
    add_area_light(scene, Sphere{{2, 1, 2}, 0.2}, {{100, 200, 300}});
    add_point_light(scene, {1, 1, 1}, {{10, 20, 30}});
    const Sensor plane{"plane", Grid{{0.1, 0.1, 0.8}, {3.8, 0, 0}, {0, 2.8, 0}, {9, 8}, Vec3{0, 0, 1}}};
    const Sensor point = point_sensor({{{0.01, 0.02, 0.03}, {1, 0, 0}}});
    // A large grid alone has fewer replicates.
    expect_same(GetParam(), scene, {plane, point}, 32);
    expect_same(GetParam(), scene, {plane}, 8);
    // With paces.
    expect_same(GetParam(), scene, {plane}, 8, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Methods, Threads, testing::Values("auto", "local", "path"),
                         [](const auto& method) { return std::string(method.param); });

}  // namespace
}  // namespace stilb::run
