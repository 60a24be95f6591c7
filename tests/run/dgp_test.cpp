// The Daylight Glare Probability against its formula, where all of its parts are known.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "materials/black.h"
#include "run/run.h"
#include "statistics/hypothesis.h"
#include "support/lamp_in_environment.h"
#include "support/scene_builder.h"
#include "transport/glare/glare.h"

namespace stilb {
namespace {

constexpr double kSky = 3000, kWindowLeft = -0.8, kWindowRight = 0.6, kWindowLow = 1.4, kWindowHigh = 2.4,
                 kDistance = 2;

/// Integrates over the window, seen from the eye.
template <typename Value>
double over_window(const Value& value) {
    constexpr int steps = 400;
    double sum = 0;
    const double dx = (kWindowRight - kWindowLeft) / steps, dz = (kWindowHigh - kWindowLow) / steps;
    for (int i = 0; i < steps; ++i) {
        for (int k = 0; k < steps; ++k) {
            const Vec3 to{kWindowLeft + (i + 0.5) * dx, kDistance,
                          kWindowLow + (k + 0.5) * dz - kEye.position.z};
            const double distance = length(to);
            sum += value(to / distance) * kDistance / (distance * distance * distance) * dx * dz;
        }
    }
    return sum;
}

/// A large black wall with a window: E, and the sum of L^2 w / p^2, are integrals over the window.
Scene window() {
    Scene scene;
    add_environment(scene, Rgb::grey(kSky));
    const auto add = [&](double x0, double x1, double z0, double z1) {
        add_object(scene, Rectangle{{x0, kDistance, z0}, {x1 - x0, 0, 0}, {0, 0, z1 - z0}}, Black{});
    };
    add(-1000, 1000, -1000, kWindowLow);
    add(-1000, 1000, kWindowHigh, 1000);
    add(-1000, kWindowLeft, kWindowLow, kWindowHigh);
    add(kWindowRight, 1000, kWindowLow, kWindowHigh);
    return scene;
}

double window_illuminance_lx() {
    return kSky * over_window([](const Vec3& w) { return w.y; });
}
double window_glare() {
    return kSky * kSky * over_window([](const Vec3& w) {
               return 1 / std::pow(transport::position_index(w, kEye.normal), 2);
           });
}

run::RunResult rated(const Scene& scene, const Dgp& sensor, std::uint64_t seed = 1,
                     const char* method = "auto", std::uint64_t paths = 1 << 15) {
    RunOptions options;
    options.method = method;
    options.paths = paths;
    options.seed = seed;
    const std::vector<Sensor> sensors{{"eye", sensor}};
    return run::measure(scene, sensors, options);
}

TEST(DaylightGlareProbability, OfAWindowIsTheFormula) {
    const double exact = dgp(window_illuminance_lx(), window_glare());
    for (const char* method : {"auto", "path", "local"}) {
        const run::RunResult result = rated(window(), Dgp{{kEye}}, 1, method, 1 << 17);
        const statistics::Estimate& rating = result.sensors.at(0).readings.at(0).estimate;
        EXPECT_NEAR(rating.value, exact, 0.002) << method << " " << window_illuminance_lx();
        EXPECT_LT(rating.upper - rating.lower, 0.02) << method;
        EXPECT_TRUE(result.warnings.empty()) << result.warnings[0].text;
    }
}

/// With a threshold above the sky there is no source.
TEST(DaylightGlareProbability, HasAThreshold) {
    const auto value = [](double threshold_cd_m2) {
        return rated(window(), Dgp{{kEye}, threshold_cd_m2}).sensors[0].readings[0].estimate;
    };
    EXPECT_LT(std::abs(statistics::z_score(value(3500), dgp(window_illuminance_lx(), 0))), 4);
    EXPECT_NEAR(value(1500).value, dgp(window_illuminance_lx(), window_glare()), 0.002);
}

TEST(DaylightGlareProbability, OfALampIsTheFormula) {
    const run::RunResult result = rated(lamp_in_an_environment(), Dgp{{kEye}});
    const statistics::Estimate& rating = result.sensors.at(0).readings.at(0).estimate;
    EXPECT_LT(std::abs(statistics::z_score(rating, lamp_dgp())), 4) << rating.value << " " << lamp_dgp();
    EXPECT_LT(rating.standard_error, 0.001);
}

TEST(DaylightGlareProbability, SaysWhatItIsNotMadeFor) {
    Scene scene = lamp_in_an_environment();
    scene.lights.pop_back();
    add_point_light(scene, {1, 2, 2}, Rgb::grey(10));
    const run::RunResult result = rated(scene, Dgp{{kEye}});
    ASSERT_EQ(result.warnings.size(), 2u);
    EXPECT_NE(result.warnings[0].text.find("is below 380 lx in 1 of 1 views"), std::string::npos)
        << result.warnings[0].text;
    EXPECT_NE(result.warnings[1].text.find("is missing from DGP"), std::string::npos)
        << result.warnings[1].text;
}

/// 380 lx under an even sky, which is no source.
TEST(DaylightGlareProbability, WarnsOfEyesWithLittleLight) {
    const auto warnings_at = [](double illuminance_lx) {
        Scene scene;
        add_environment(scene, Rgb::grey(illuminance_lx / std::numbers::pi));
        return rated(scene, Dgp{{kEye}}, 1, "path", 64).warnings.size();
    };
    EXPECT_EQ(warnings_at(379.9), 1u);
    EXPECT_EQ(warnings_at(380.1), 0u);
}

/// Where there is neither light nor glare, the constant of the formula is left.
TEST(DaylightGlareProbability, InTheDarkIsTheConstant) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 4, 3}}, Black{});
    add_object(scene, Box{{5, 0, 0}, {6, 1, 2}}, Black{});
    add_area_light(scene, Sphere{{2, 1, 2}, 0.1}, Rgb::grey(5000));
    const Dgp eyes{{{{5.5, 0.5, 1}, {1, 0, 0}}, {{2, 3, 1.5}, {0, -1, 0}}}};
    const run::RunResult result = rated(scene, eyes);
    const std::vector<Reading>& readings = result.sensors.at(0).readings;
    EXPECT_EQ(readings.at(0).estimate.value, 0.16);
    EXPECT_EQ(readings.at(0).estimate.standard_error, 0);
    EXPECT_GT(readings.at(1).estimate.value, 0.2);
    EXPECT_EQ(result.sensors[0].summary.minimum.value, 0.16);
}

/// Where few of the samples find the light of an eye, replicates have none of it, and others much.
TEST(DaylightGlareProbability, HasAValueWhereReplicatesSeeNoLight) {
    Scene scene;
    add_environment(scene, Rgb::grey(1000));
    const auto wall = [&](double x0, double x1) {
        add_object(scene, Rectangle{{x0, 2, -50}, {x1 - x0, 0, 0}, {0, 0, 100}}, Black{});
    };
    wall(-50, -0.02);
    wall(0.02, 50);
    int without_light = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const run::RunResult result = rated(scene, Dgp{{kEye}, 500}, seed, "path", 1024);
        const statistics::Estimate& rating = result.sensors.at(0).readings.at(0).estimate;
        EXPECT_TRUE(std::isfinite(rating.lower + rating.upper)) << rating.lower << " " << rating.upper;
        without_light += rating.standard_error > 0;
    }
    EXPECT_GT(without_light, 0);
}

TEST(DaylightGlareProbability, IsTheSameForAnyNumberOfThreads) {
    RunOptions options;
    options.paths = 1 << 13;
    const std::vector<Sensor> sensors{{"eye", Dgp{{kEye}}}};
    options.threads = 1;
    const auto one = run::measure(window(), sensors, options).sensors[0].readings[0].estimate;
    options.threads = 3;
    EXPECT_EQ(one, run::measure(window(), sensors, options).sensors[0].readings[0].estimate);
}

}  // namespace
}  // namespace stilb
