// The Unified Glare Rating against its formula, where all of its parts are known.
#include "transport/glare.h"

#include <gtest/gtest.h>

#include <cmath>

#include "run/run.h"
#include "statistics/hypothesis.h"
#include "support/scene_builder.h"

namespace stilb {
namespace {

constexpr double kBackground = 20, kLamp = 5000, kRadius = 0.15;
const MeasuringPoint kEye{{0, 0, 1.2}, {0, 1, 0}};
const Vec3 kMiddle{0.5, 3, 2.2};

/// A lamp that faces the eye in a uniform environment: E - Ed is what the lamp leaves of the environment.
Scene lamp_in_an_environment() {
    Scene scene;
    add_area_light(scene, Disk{kMiddle, normalized(kEye.position - kMiddle), kRadius}, Rgb::grey(kLamp));
    add_environment(scene, Rgb::grey(kBackground));
    return scene;
}

double exact_ugr() {
    const Vec3 towards = kMiddle - kEye.position;
    const double distance = length(towards);
    const double solid_angle = 2 * kPi * (1 - distance / std::hypot(distance, kRadius));
    const double p = transport::position_index(normalized(towards), kEye.normal);
    // Of the lamp's disk as seen from the eye: sin^2 of its angular radius times the cosine of its middle.
    const double sine_squared = kRadius * kRadius / (distance * distance + kRadius * kRadius);
    const double hidden_sr = kPi * sine_squared * dot(normalized(towards), kEye.normal);
    const double background = kBackground * (1 - hidden_sr / kPi);
    return 8 * std::log10(0.25 / background * kLamp * kLamp * solid_angle / (p * p));
}

run::RunResult rated(const Scene& scene, std::uint64_t seed, const char* method = "auto") {
    RunOptions options;
    options.method = method;
    options.paths = 1 << 15;  // one in 500 rays to the background meets the lamp
    options.seed = seed;
    const std::vector<Sensor> sensors{{"eye", Ugr{{kEye}}}};
    return run::measure(scene, sensors, options);
}

TEST(UnifiedGlareRating, IsTheFormula) {
    const Scene scene = lamp_in_an_environment();
    for (const char* method : {"auto", "path", "local"}) {
        const run::RunResult result = rated(scene, 1, method);
        const statistics::Estimate& rating = result.sensors.at(0).readings.at(0).estimate;
        EXPECT_LT(std::abs(statistics::z_score(rating, exact_ugr())), 4) << method << " " << rating.value;
        EXPECT_LT(rating.standard_error, 0.1) << method;
        EXPECT_LT(rating.lower, rating.value);
        EXPECT_GT(rating.upper, rating.value);
        EXPECT_TRUE(result.warnings.empty()) << result.warnings[0];
    }
}

TEST(UnifiedGlareRating, HasIntervalsThatCover) {
    const Scene scene = lamp_in_an_environment();
    constexpr int kSeeds = 200;
    int covered = 0;
    for (int seed = 1; seed <= kSeeds; ++seed) {
        const run::RunResult result = rated(scene, seed);
        const statistics::Estimate& rating = result.sensors.at(0).readings.at(0).estimate;
        covered += rating.lower <= exact_ugr() && exact_ugr() <= rating.upper;
    }
    // 95 % of 200 within three standard deviations.
    EXPECT_GE(covered, 181);
    EXPECT_LE(covered, 199);
}

TEST(UnifiedGlareRating, SaysWhatItLeavesOut) {
    Scene scene = lamp_in_an_environment();
    add_point_light(scene, {1, 2, 2}, Rgb::grey(10));
    add_area_light(scene, Sphere{{0, 4, 1.2}, 0.02}, Rgb::grey(1e6));
    const run::RunResult result = rated(scene, 1);
    ASSERT_EQ(result.warnings.size(), 2u);
    EXPECT_NE(result.warnings[0].find("is less than 0.0003 sr"), std::string::npos) << result.warnings[0];
    EXPECT_NE(result.warnings[1].find("a point has no luminous area"), std::string::npos)
        << result.warnings[1];
}

TEST(UnifiedGlareRating, IsZeroWithoutALampInView) {
    Scene scene;
    add_environment(scene, Rgb::grey(kBackground));
    const statistics::Estimate rating = rated(scene, 1).sensors.at(0).readings.at(0).estimate;
    EXPECT_EQ(rating.value, 0);
    EXPECT_EQ(rating.upper, 0);
}

}  // namespace
}  // namespace stilb
