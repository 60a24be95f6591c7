// Lamps that are much weaker than others which do not reach the readings.
#include <gtest/gtest.h>

#include <cmath>

#include "estimators/estimator_list.h"
#include "materials/black.h"
#include "run/readings/possible_light.h"
#include "run/run.h"
#include "support/scene_builder.h"
#include "transport/receiver.h"

namespace stilb::run {
namespace {

Sensor below(const Vec3& lamp, double radius_m) {
    return {"below", IlluminancePoints{{{lamp - Vec3{0, 0, radius_m}, {0, 0, 1}}}}};
}

statistics::Estimate measured(const Scene& scene, const Sensor& sensor, const char* method,
                              std::int64_t paths, std::uint64_t seed) {
    RunOptions options;
    options.method = method;
    options.paths = paths;
    options.seed = seed;
    return measure(scene, {&sensor, 1}, options).sensors[0].readings[0].estimate;
}

/// The mean of some seeds is right, its error is known, and the error is not 0.
void expect_value(const Scene& scene, const Sensor& sensor, const char* method, std::int64_t paths,
                  double value_lx) {
    constexpr int seeds = 8;
    double sum_lx = 0, squares = 0;
    int missed = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
        const auto found = measured(scene, sensor, method, paths, static_cast<std::uint64_t>(seed));
        EXPECT_GT(found.standard_error, 0) << method;
        sum_lx += found.value;
        squares += found.standard_error * found.standard_error;
        missed += found.lower > value_lx || found.upper < value_lx;
    }
    EXPECT_LT(std::abs(sum_lx - seeds * value_lx), 4 * std::sqrt(squares)) << method << sum_lx / seeds;
    EXPECT_LE(missed, 3) << method;
}

/// A closed ball with a lamp in its middle: illuminance flux / (4 pi r^2) / (1 - reflectance).
TEST(WeakLamp, InABallBesideOneWithAStrongLamp) {
    for (const double strong : {1e2, 1e3, 1e9}) {
        Scene scene;
        add_object(scene, Sphere{{0, 0, 0}, 1}, diffuse(0.5));
        add_object(scene, Sphere{{3, 0, 0}, 1}, diffuse(0.5));
        add_point_light(scene, {0, 0, 0}, Rgb::grey(strong / (4 * kPi)));
        add_point_light(scene, {3, 0, 0}, Rgb::grey(1 / (4 * kPi)));
        const Sensor sensor = below({3, 0, 0}, 1);
        for (const char* method : {"auto", "path", "local", "double-local"})
            expect_value(scene, sensor, method, 16384, 2 / (4 * kPi));
    }
}

Scene room_beside_one_with(double strong_lm) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 4, 3}}, diffuse(0.6));
    add_point_light(scene, {2, 2, 2.5}, Rgb::grey(1 / (4 * kPi)));
    if (strong_lm == 0) return scene;
    add_object(scene, Box{{4.1, 0, 0}, {8, 4, 3}}, diffuse(0.6));
    add_point_light(scene, {6, 2, 2.5}, Rgb::grey(strong_lm / (4 * kPi)));
    return scene;
}

/// The walls of the other room are nearer and brighter than most of this one's, and hidden.
TEST(WeakLamp, InARoomBesideOneWithAStrongLamp) {
    const Sensor sensor{"desk", IlluminancePoints{{{{3, 1, 0.8}, {0, 0, 1}}}}};
    const auto alone = measured(room_beside_one_with(0), sensor, "path", 1 << 20, 1);
    ASSERT_LT(alone.standard_error, 3e-4 * alone.value);
    for (const double strong_lm : {100., 1e3, 1e4, 1e9}) {
        const Scene scene = room_beside_one_with(strong_lm);
        expect_value(scene, sensor, "guided", 256, alone.value);
    }
}

TEST(WeakLamp, InAClosedBallBelowTheSky) {
    Scene scene;
    add_object(scene, Disk{{0, 0, -1}, {0, 0, 1}, 300}, diffuse(0.7));
    add_object(scene, Sphere{{0, 0, 1}, 1.5}, diffuse(0.7));
    add_environment(scene, Rgb::grey(20000));
    add_point_light(scene, {0, 0, 1}, Rgb::grey(20 / (4 * kPi)));
    const Sensor sensor = below({0, 0, 1}, 1.5);
    for (const char* method : {"auto", "path", "local"})
        expect_value(scene, sensor, method, 8192, 20 / (4 * kPi * 2.25) / 0.3);
}

/// Three halls, each lamp a thousandth of the next, and many of them: every strength has its share.
TEST(WeakLamp, OfThreeStrengths) {
    Scene scene;
    const std::array<double, 3> flux_lm{1, 1e3, 1e6};
    for (std::size_t ball = 0; ball < 3; ++ball) {
        const Vec3 center{3.0 * static_cast<double>(ball), 0, 0};
        add_object(scene, Sphere{center, 1}, diffuse(0.5));
        // In the middle within a micrometre.
        for (int i = 0; i < 15; ++i)
            add_point_light(scene, center + Vec3{0, 0, 1e-7 * i}, Rgb::grey(flux_lm[ball] / 15 / (4 * kPi)));
    }
    for (const char* method : {"auto", "path", "local"})
        expect_value(scene, below({0, 0, 0}, 1), method, 16384, 2 / (4 * kPi));
}

/// Equal replicates prove nothing where samples could have found light: the interval reaches up.
TEST(WeakLamp, ThatNoSampleFoundIsAllowedFor) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 4, 3}}, Black{});
    add_object(scene, Rectangle{{0.1, 1.999, 1.499}, {0, 0.002, 0}, {0, 0, 0.002}}, diffuse(0.9));
    add_point_light(scene, {2, 2, 2.5}, Rgb::grey(100));
    const Sensor sensor{"desk", IlluminancePoints{{{{2, 2, 0.8}, {0, 0, 1}}}}};
    const auto found = measured(scene, sensor, "path", 32, 1);
    const double direct_lx = 100 / (1.7 * 1.7);
    EXPECT_NEAR(found.value, direct_lx, 1e-6 * direct_lx);
    EXPECT_GT(found.upper, direct_lx);
    // Without reflection nothing is missed.
    scene.materials[1].material = Black{};
    const auto black = measured(scene, sensor, "path", 32, 1);
    EXPECT_EQ(black.upper, black.lower);
}

/// A small ball close to a lamp reflects to a point far from both, and no path meets it. The direct light is
/// sampled, as the lamp has an area, and the ball gets a thousand times the light of the point. The second
/// method is local estimation, whose light paths meet the ball.
TEST(WeakLamp, LightOfSmallThingsThatNoSampleFoundIsAllowedFor) {
    Scene scene;
    add_object(scene, Sphere{{0, 0, 0.1}, 0.02}, diffuse(0.9));
    add_area_light(scene, Sphere{{0, 0, 0.13}, 0.005}, Rgb::grey(1e4));
    const Sensor sensor{"far", IlluminancePoints{{{{2.5, 0, 0.12}, {-1, 0, 0}}}}};
    const auto whole = measured(scene, sensor, "local", 1 << 18, 1);
    const auto found = measured(scene, sensor, "path", 1024, 1);
    EXPECT_LT(found.standard_error, 1e-3 * whole.value);
    EXPECT_GT(whole.value - found.value, 0.04 * whole.value);
    EXPECT_GT(found.upper, whole.value);
}

/// A ground far below the room does not make its walls seem too near to reflect light.
/// The light that samples of `method` may miss.
double missed_lx(const Scene& scene, const MeasuringPoint& at, const char* method, int max_reflections = 100,
                 double largest_lx = 0, std::uint64_t samples = 1000) {
    const rays::RayCaster caster(scene);
    const Measurand measurand = at;
    estimators::Problem problem{.scene = scene,
                                .caster = caster,
                                .max_reflections = max_reflections,
                                .preparation_key = {math::RandomKey{1}}};
    problem.measurands = {&measurand, 1};
    const auto estimator = estimators::find_estimator(method).make(problem);
    return PossibleLight(scene, caster, max_reflections, *estimator).missed(measurand, largest_lx, samples);
}

TEST(WeakLamp, IsPossibleWhateverLiesElsewhere) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {3, 3, 1.5}}, diffuse(0.5));
    add_point_light(scene, {1, 1, 1}, Rgb::grey(1));
    const MeasuringPoint floor{{1, 2, 0}, {0, 0, 1}};
    const double alone_lx = missed_lx(scene, floor, "local");
    EXPECT_GT(alone_lx, 0);
    add_object(scene, Rectangle{{-5e5, -5e5, -1}, {1e6, 0, 0}, {0, 1e6, 0}}, diffuse(0.5));
    EXPECT_NEAR(missed_lx(scene, floor, "local"), alone_lx, 1e-9 * alone_lx);
}

/// What lies no higher above the reading than rays tell apart reflects nothing to it; what is higher may.
TEST(WeakLamp, IsPossibleWhereSomethingIsAboveTheReading) {
    const auto possible_lx = [](double top_m, double reflectance, int max_reflections) {
        Scene scene;
        add_object(scene, Rectangle{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}, diffuse(0.5));
        add_object(scene, Box{{2, 2, -1}, {2.5, 2.5, top_m}}, diffuse(reflectance));
        add_point_light(scene, {1, 1, 1}, Rgb::grey(1));
        return missed_lx(scene, {{1, 1, 0}, {0, 0, 1}}, "local", max_reflections);
    };
    const double lift_m = 0x1p-19 * 1.5;  // the scene extends 1.5 m around its middle
    EXPECT_EQ(possible_lx(-0.1, 0.5, 100), 0);
    EXPECT_EQ(possible_lx(1.9 * lift_m, 0.5, 100), 0);
    EXPECT_GT(possible_lx(2.1 * lift_m, 0.5, 100), 0);
    EXPECT_GT(possible_lx(0.1, 0.5, 1), 0);
    EXPECT_EQ(possible_lx(0.1, 0.5, 0), 0);
    EXPECT_EQ(possible_lx(0.1, 0, 100), 0);
    EXPECT_GT(possible_lx(0.1, 1e-9, 100), 0);
}

/// A ball beside the lamp reflects a tenth of its light, and few rays meet it: replicates without one agree.
Scene room_with_ball_beside_lamp(const Shape& ball) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 4, 3}}, diffuse(0.02));
    add_object(scene, ball, diffuse(0.8));
    add_point_light(scene, {2, 2, 2.03}, Rgb::grey(100));
    return scene;
}
constexpr Sphere kTinyBall{{2, 2, 2}, 0.02};

TEST(WeakLamp, IntervalsReachLightThatFewRaysMeet) {
    const Scene scene = room_with_ball_beside_lamp(kTinyBall);
    const Sensor sensor{"wall", IlluminancePoints{{{{0, 2, 2.3}, {1, 0, 0}}}}};
    const auto right = measured(scene, sensor, "local", 1 << 22, 1);
    ASSERT_LT(right.standard_error, 2e-3 * right.value);
    for (const char* method : {"path", "guided"}) {
        int narrow = 0, below = 0;
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            const auto found = measured(scene, sensor, method, 512, seed);
            narrow += found.upper < right.value || found.lower > right.value;
            below += found.value + 3 * found.standard_error < right.value;
        }
        EXPECT_GE(below, 4) << method;  // else nothing is rare here
        EXPECT_LE(narrow, 1) << method;
    }
}

TEST(WeakLamp, AllowsForRareLightWhereAMethodNeedsRaysForIt) {
    const MeasuringPoint at{{0, 2, 2.3}, {1, 0, 0}};
    const Scene ball = room_with_ball_beside_lamp(kTinyBall);
    const Scene cube = room_with_ball_beside_lamp(Box{{1.98, 1.98, 1.98}, {2.02, 2.02, 2.02}});
    constexpr double of_walls_lx = 0.02 * 100;
    EXPECT_GT(missed_lx(ball, at, "path", 100, of_walls_lx), 0.01);
    EXPECT_GT(missed_lx(cube, at, "path", 100, of_walls_lx), 0.01);
    // The guess knows the light of flat surfaces, and light paths connect all.
    EXPECT_GT(missed_lx(ball, at, "guided", transport::kUnlimited, of_walls_lx), 0.01);
    EXPECT_EQ(missed_lx(cube, at, "guided", transport::kUnlimited, of_walls_lx), 0);
    EXPECT_EQ(missed_lx(ball, at, "local", 100, of_walls_lx), 0);
}

/// The ball's brightest places, 1 cm below the lamp, reflect 0.8 of 1e6 lx. Its light is 2 lx: one of some
/// 400,000 rays meets where that comes from.
TEST(WeakLamp, CountsAsMetWhereASampleWasHalfAsBrightOrSamplesAreMany) {
    const MeasuringPoint at{{0, 2, 2.3}, {1, 0, 0}};
    const Scene scene = room_with_ball_beside_lamp(kTinyBall);
    EXPECT_GT(missed_lx(scene, at, "path", 100, 0.95 * 4e5), 0);
    EXPECT_EQ(missed_lx(scene, at, "path", 100, 1.01 * 4e5), 0);
    const double few_lx = missed_lx(scene, at, "path", 100, 2, 1000);
    EXPECT_NEAR(missed_lx(scene, at, "path", 100, 2, 100'000), few_lx, 1e-9);
    double before_lx = few_lx;
    for (const std::uint64_t samples : {10'000'000, 100'000'000, 1'000'000'000}) {
        const double lx = missed_lx(scene, at, "path", 100, 2, samples);
        EXPECT_LT(lx, before_lx) << samples;
        EXPECT_LE(lx, 4 * 8e5 / static_cast<double>(samples)) << samples;
        before_lx = lx;
    }
}

}  // namespace
}  // namespace stilb::run
