// Derived values and requirements.
#include <gtest/gtest.h>

#include <cmath>

#include "run/readings/sensor_estimates.h"
#include "run/run.h"
#include "stilb/error.h"
#include "support/coarser.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

/// A room of 4 m x 4 m x 3 m with a lamp in the ceiling and a table.
Scene rated_room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 4, 3}}, diffuse(0.5));
    add_object(scene, Box{{1, 1, 0}, {2, 2, 0.7}}, diffuse(0.3));
    add_area_light(scene, Rectangle{{1.5, 1.5, 2.9}, {0, 1, 0}, {1, 0, 0}}, Rgb::grey(1000));
    return scene;
}

Sensor desk() { return {"desk", Grid{{0.5, 2.5, 0.8}, {3, 0, 0}, {0, 1, 0}, {4, 2}}}; }
Sensor eye() { return {"eye", Cylindrical{{{2.5, 2.5, 1.2}}}}; }
Sensor derived(const std::string& formula) { return {"derived", Derived{Expression(formula)}}; }

RunOptions rating_options(std::string_view method, std::uint64_t seed = 1) {
    RunOptions options;
    options.method = method;
    options.paths = 2048;
    options.seed = seed;
    options.patch_m = 1;
    return options;
}

SensorResult measure_derived(const std::string& formula, const RunOptions& options) {
    const std::vector<Sensor> sensors{derived(formula), desk(), eye()};
    return measure(rated_room(), sensors, options).sensors.at(0);
}

const statistics::Estimate& value_of(const SensorResult& result) { return result.readings.at(0).estimate; }

TEST(DerivedValues, ErrorsContainCorrelations) {
    for (const char* method : {"auto", "path", "radiosity", "particles"}) {
        const RunOptions options = rating_options(method);
        const SensorResult none = measure_derived("desk.mean - desk.mean", options);
        EXPECT_EQ(value_of(none).value, 0) << method;
        EXPECT_EQ(value_of(none).standard_error, 0) << method;
        const SensorResult sum = measure_derived("desk.mean + eye", options);
        const std::vector<Sensor> sensors{desk(), eye()};
        const RunResult parts = measure(rated_room(), sensors, options);
        const auto& a = parts.sensors[0].summary.mean;
        const auto& b = parts.sensors[1].readings[0].estimate;
        EXPECT_NEAR(value_of(sum).value, a.value + b.value, 1e-9) << method;
        EXPECT_GT(value_of(sum).standard_error, 0) << method;
        // Not the root of the sum of squares: both share light.
        EXPECT_LE(value_of(sum).standard_error, a.standard_error + b.standard_error + 1e-12) << method;
        EXPECT_EQ(sum.replicate_means.size(), static_cast<std::size_t>(parts.replicates)) << method;
        const auto again = statistics::estimate_from_replicates(sum.replicate_means);
        EXPECT_NEAR(again.value, value_of(sum).value, 1e-9) << method;
        EXPECT_NEAR(again.standard_error, value_of(sum).standard_error, 1e-9) << method;
    }
}

TEST(DerivedValues, AgreeWithTheSummary) {
    const RunOptions options = rating_options("path");
    const std::vector<Sensor> sensors{derived("desk.minimum / desk.mean"),
                                      derived("desk.minimum / desk.maximum"), desk()};
    const RunResult result = measure(rated_room(), sensors, options);
    const statistics::GridSummary& summary = result.sensors[2].summary;
    EXPECT_NEAR(value_of(result.sensors[0]).value, summary.uniformity.value, 1e-12);
    EXPECT_NEAR(value_of(result.sensors[0]).standard_error, summary.uniformity.standard_error, 1e-12);
    EXPECT_NEAR(value_of(result.sensors[1]).value, summary.diversity.value, 1e-12);
    EXPECT_NEAR(value_of(result.sensors[1]).standard_error, summary.diversity.standard_error, 1e-12);
}

TEST(DerivedValues, ContainTheErrorOfPatches) {
    const std::vector<Sensor> sensors{derived("desk.mean * 2"), desk()};
    const RunResult result = measure(rated_room(), sensors, rating_options("particles"));
    const statistics::Estimate& twice = value_of(result.sensors[0]);
    const statistics::Estimate& mean = result.sensors[1].summary.mean;
    EXPECT_NEAR(twice.upper, 2 * mean.upper, 1e-9 * mean.upper);
    EXPECT_NEAR(twice.lower, 2 * mean.lower, 1e-9 * mean.upper);
    EXPECT_GT(twice.upper - twice.value, 2.5 * twice.standard_error) << "the bound of the patches";
}

TEST(DerivedValues, AreUndefinedInTheDark) {
    Scene dark = rated_room();
    dark.lights.clear();
    const std::vector<Sensor> sensors{derived("desk.mean / eye"), desk(), eye()};
    EXPECT_TRUE(std::isnan(value_of(measure(dark, sensors, rating_options("path")).sensors[0]).value));
}

TEST(DerivedValues, NeedTheirSensors) {
    const std::vector<Sensor> sensors{derived("desk.mean / eye"), desk()};
    try {
        measure(rated_room(), sensors, rating_options("path"));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(),
                     "sensor \"derived\": there is no sensor \"eye\" to measure. Allowed: desk.");
    }
}

TEST(DerivedValues, ChangeNothingElse) {
    RunOptions options = rating_options("auto");
    options.paths.reset();
    options.error = 0.02;
    const Sensor grid{"desk", Grid{{0.5, 2.5, 0.8}, {3, 0, 0}, {0, 1, 0}, {10, 8}}};
    const RunResult alone = measure(rated_room(), {&grid, 1}, options);
    const std::vector<Sensor> sensors{derived("desk.maximum / desk.mean"), grid};
    const RunResult both = measure(rated_room(), sensors, options);
    EXPECT_EQ(both.replicates, 8) << "as where all sensors are large grids";
    EXPECT_EQ(both.samples, alone.samples);
    EXPECT_EQ(both.sensors[1].summary.uniformity, alone.sensors[0].summary.uniformity);
}

/// Modelling index, and the minimum of the task over the mean of another place, with 200 seeds.
TEST(DerivedValues, IntervalsHold) {
    const std::vector<Sensor> sensors{derived("eye / desk[5]"), derived("desk.minimum / eye"), desk(), eye()};
    RunOptions options = rating_options("path");
    options.paths = 1 << 17;
    const RunResult truth = measure(rated_room(), sensors, options);
    options.paths = 64;
    constexpr std::uint64_t seeds = 200;
    for (std::size_t s = 0; s < 2; ++s) {
        const double exact = value_of(truth.sensors[s]).value;
        std::uint64_t held = 0;
        for (std::uint64_t seed = 10; seed < 10 + seeds; ++seed) {
            options.seed = seed;
            const statistics::Estimate estimate =
                value_of(measure(rated_room(), sensors, options).sensors[s]);
            held += estimate.lower <= exact && exact <= estimate.upper;
        }
        // 95 %, with three standard errors of 1.5 %; minima may be conservative.
        EXPECT_GE(held, seeds * 905 / 1000) << s;
        if (s == 0) {
            EXPECT_LE(held, seeds * 995 / 1000);
        }
    }
}

// Requirements.

std::vector<RatedRequirement> rated(std::string_view key, double limit,
                                    const statistics::Estimate& estimate) {
    const auto criterion = std::ranges::find(sensors::kCriteria, key, &sensors::Criterion::key);
    const Requirement requirement{criterion, limit};
    statistics::GridSummary summary;
    summary.mean = summary.minimum = summary.maximum = summary.uniformity = summary.diversity = estimate;
    return rate({&requirement, 1}, run::SensorEstimates{{}, summary});
}

TEST(Requirements, AreDecidedByTheWholeInterval) {
    const statistics::Estimate estimate{500, 5, 490, 512};
    for (const char* key : {"mean", "minimum", "uniformity", "diversity"}) {
        EXPECT_EQ(rated(key, 489, estimate)[0].verdict, Verdict::pass) << key;
        EXPECT_EQ(rated(key, 490, estimate)[0].verdict, Verdict::pass) << key;
        EXPECT_EQ(rated(key, 491, estimate)[0].verdict, Verdict::undecided) << key;
        EXPECT_EQ(rated(key, 512, estimate)[0].verdict, Verdict::undecided) << key;
        EXPECT_EQ(rated(key, 513, estimate)[0].verdict, Verdict::fail) << key;
    }
    EXPECT_EQ(rated("maximum", 513, estimate)[0].verdict, Verdict::pass);
    EXPECT_EQ(rated("maximum", 500, estimate)[0].verdict, Verdict::undecided);
    EXPECT_EQ(rated("maximum", 489, estimate)[0].verdict, Verdict::fail);
    const statistics::Estimate exact{500, 0, 500, 500};
    EXPECT_EQ(rated("mean", 500, exact)[0].verdict, Verdict::pass);
    EXPECT_EQ(rated("maximum", 500, exact)[0].verdict, Verdict::pass);
    const double nan = std::nan("");
    EXPECT_EQ(rated("uniformity", 0.5, {nan, nan, nan, nan})[0].verdict, Verdict::undecided);
}

/// A decision ends these runs, also where a sanitizer makes them thirty times as long.
constexpr double kMoreThanEnough_s = 3600;

Sensor required(Sensor sensor, std::string_view key, double limit) {
    sensor.requirements.push_back(
        {std::ranges::find(sensors::kCriteria, key, &sensors::Criterion::key), limit});
    return sensor;
}

TEST(Requirements, EndARunOnceTheyAreDecided) {
    RunOptions options;
    options.method = "path";
    options.time_s = kMoreThanEnough_s;
    const Sensor easy = required(desk(), "mean", 50);
    const RunResult soon = measure(rated_room(), {&easy, 1}, options);
    // About seven times as many samples are needed to be sure of half an interval's width.
    const statistics::Estimate& mean = soon.sensors[0].summary.mean;
    const Sensor hard = required(desk(), "mean", mean.value - (mean.upper - mean.value) / 2);
    options.seed = 2;
    const RunResult late = measure(rated_room(), {&hard, 1}, options);
    for (const RunResult* result : {&soon, &late}) {
        EXPECT_EQ(result->stop_reason, StopReason::requirements_decided);
        EXPECT_TRUE(result->converged);
        EXPECT_EQ(result->sensors[0].requirements.at(0).verdict, Verdict::pass);
        EXPECT_EQ(verdict_of(*result), Verdict::pass);
    }
    EXPECT_LT(soon.samples, late.samples);
    const Sensor missed = required(desk(), "uniformity", 0.99);
    EXPECT_EQ(verdict_of(measure(rated_room(), {&missed, 1}, options)), Verdict::fail);
}

TEST(Requirements, DoNotEndARunThatHasAnErrorToReach) {
    const Sensor easy = required(desk(), "mean", 1);
    RunOptions options;
    options.method = "path";
    options.error = 0.01;
    const RunResult result = measure(rated_room(), {&easy, 1}, options);
    EXPECT_EQ(result.stop_reason, StopReason::target_reached);
    EXPECT_TRUE(result.converged);
    EXPECT_LE(result.attained_error, 0.01);
    EXPECT_EQ(verdict_of(result), Verdict::pass);
}

TEST(Requirements, OfDerivedValuesAreDecidedToo) {
    const std::vector<Sensor> sensors{required(derived("eye / desk.mean"), "maximum", 0.9),
                                      required(desk(), "mean", 1), eye()};
    RunOptions options;
    options.method = "path";
    options.time_s = kMoreThanEnough_s;
    const RunResult result = measure(rated_room(), sensors, options);
    EXPECT_EQ(result.stop_reason, StopReason::requirements_decided);
    EXPECT_EQ(result.sensors[0].requirements.at(0).verdict, Verdict::pass);
}

TEST(Requirements, DoNotChangeARunOfAGivenNumberOfPaths) {
    const Sensor easy = required(desk(), "mean", 1);
    const RunResult result = measure(rated_room(), {&easy, 1}, rating_options("path"));
    EXPECT_EQ(result.stop_reason, StopReason::paths_done);
    EXPECT_EQ(result.samples, 2048U);
    EXPECT_EQ(verdict_of(result), Verdict::pass);
}

TEST(Requirements, StayUndecidedWhereTimeDoesNotSuffice) {
    const Sensor plain = desk();
    RunOptions options = rating_options("path");
    options.paths = 1 << 17;
    const double mean = measure(rated_room(), {&plain, 1}, options).sensors[0].summary.mean.value;
    const Sensor close = required(desk(), "mean", mean);
    options.paths.reset();
    options.time_s = coarser(1);  // of the same seed: its paths are nearly those of the limit
    const RunResult result = measure(rated_room(), {&close, 1}, options);
    EXPECT_EQ(result.stop_reason, StopReason::time_over);
    EXPECT_EQ(verdict_of(result), Verdict::undecided);
}

TEST(Requirements, AreAllNeeded) {
    RunResult result;
    EXPECT_FALSE(verdict_of(result));
    SensorResult& sensor = result.sensors.emplace_back();
    const auto set = [&](std::initializer_list<Verdict> verdicts) {
        sensor.requirements.clear();
        for (const Verdict verdict : verdicts) sensor.requirements.push_back({{}, verdict});
        return verdict_of(result);
    };
    EXPECT_EQ(set({Verdict::pass, Verdict::pass}), Verdict::pass);
    EXPECT_EQ(set({Verdict::undecided, Verdict::pass}), Verdict::undecided);
    EXPECT_EQ(set({Verdict::pass, Verdict::undecided}), Verdict::undecided);
    EXPECT_EQ(set({Verdict::undecided, Verdict::fail, Verdict::pass}), Verdict::fail);
    EXPECT_EQ(set({Verdict::unsure, Verdict::pass}), Verdict::unsure);
    EXPECT_EQ(set({Verdict::pass, Verdict::unsure}), Verdict::unsure);
    EXPECT_EQ(set({Verdict::unsure, Verdict::undecided}), Verdict::undecided);
    EXPECT_EQ(set({Verdict::undecided, Verdict::unsure}), Verdict::undecided);
    EXPECT_EQ(set({Verdict::unsure, Verdict::fail}), Verdict::fail);
}

TEST(TargetMean, AimsAtMeansAndMinima) {
    const Sensor sensor = desk();
    RunOptions options;
    options.method = "path";
    options.error = 0.001;
    options.target = "mean";
    const RunResult means = measure(rated_room(), {&sensor, 1}, options);
    const statistics::GridSummary& summary = means.sensors[0].summary;
    EXPECT_EQ(means.stop_reason, StopReason::target_reached);
    EXPECT_LE(relative_half_width(summary.mean), 0.001);
    EXPECT_LE(relative_half_width(summary.minimum), 0.001);
    EXPECT_EQ(means.attained_error,
              std::max(relative_half_width(summary.mean), relative_half_width(summary.minimum)));
    EXPECT_NE(means.attained_error, means.sensors[0].attained_error) << "that of single readings";
}

// Areas.

Sensor area(const std::vector<Vec3>& corners, double spacing_m) {
    Area made{.polygon = {corners, {}}, .spacing_m = spacing_m};
    made.settle(sensors::GivenKeys({"corners"}));
    return {"area", made};
}

/// Points at 0.35 m over a floor that a table of 1 m x 1 m stands on; the outermost are outside of the room.
TEST(Areas, LeaveOutPointsInBodiesAndOutsideOfTheRoom) {
    const Sensor wide = area({{-1, -1, 0.35}, {5, -1, 0.35}, {5, 5, 0.35}, {-1, 5, 0.35}}, 0.25);
    const RunResult result = measure(rated_room(), {&wide, 1}, rating_options("path"));
    const SensorResult& measured = result.sensors.at(0);
    const auto& left = std::get<Area>(measured.sensor.kind);
    EXPECT_EQ(left.size(), 16U * 16 - 4 * 4);
    EXPECT_EQ(left.left_out, 24U * 24 - left.size());
    EXPECT_EQ(measured.readings.size(), left.size());
    for (const MeasuringPoint& point : left.points) {
        const Vec3& p = point.position;
        EXPECT_TRUE(p.x > 0 && p.x < 4 && p.y > 0 && p.y < 4);
        EXPECT_FALSE(p.x > 1 && p.x < 2 && p.y > 1 && p.y < 2);
    }
    EXPECT_GT(measured.summary.minimum.value, 0);
}

TEST(Areas, LeaveOutPointsRightBelowASurface) {
    Scene scene = rated_room();
    add_object(scene, Rectangle{{2.5, 2.5, 0.36}, {1, 0, 0}, {0, 1, 0}}, diffuse(0.3));
    const Sensor floor = area({{2, 2, 0.35}, {4, 2, 0.35}, {4, 4, 0.35}, {2, 4, 0.35}}, 0.25);
    const RunResult result = measure(scene, {&floor, 1}, rating_options("path"));
    EXPECT_EQ(std::get<Area>(result.sensors.at(0).sensor.kind).left_out, 16U);
}

/// Something covers points that lie 1 cm apart if it is less than half of that above them.
TEST(Areas, OfDensePointsHaveNearerCovers) {
    for (const double gap_m : {0.0049, 0.0051}) {
        Scene scene = rated_room();
        add_object(scene, Rectangle{{2, 2, 0.35 + gap_m}, {0.1, 0, 0}, {0, 0.05, 0}}, diffuse(0.3));
        const Sensor floor = area({{2, 2, 0.35}, {2.1, 2, 0.35}, {2.1, 2.1, 0.35}, {2, 2.1, 0.35}}, 0.01);
        const RunResult result = measure(scene, {&floor, 1}, rating_options("path"));
        EXPECT_EQ(std::get<Area>(result.sensors.at(0).sensor.kind).left_out, gap_m < 0.005 ? 50U : 0U);
    }
}

/// A room of 4 cm, lower than what covers the points of ordinary areas.
TEST(Areas, OfTinyRoomsKeepTheirPoints) {
    Scene scene;
    add_object(scene, inward(Box{{0, 0, 0}, {0.04, 0.04, 0.015}}), diffuse(0.5));
    add_point_light(scene, {0.01, 0.02, 0.012}, Rgb::grey(1));
    const Sensor floor = area({{0, 0, 0.001}, {0.04, 0, 0.001}, {0.04, 0.04, 0.001}, {0, 0.04, 0.001}}, 0.01);
    const RunResult result = measure(scene, {&floor, 1}, rating_options("path"));
    EXPECT_EQ(std::get<Area>(result.sensors.at(0).sensor.kind).left_out, 0U);
    EXPECT_EQ(result.sensors.at(0).readings.size(), 16U);
}

/// One of two rooms has a lamp. The task area in the other room keeps all of its points, and they read 0.
TEST(Areas, RoomsWithoutLampsAreDark) {
    Scene scene = rated_room();
    add_object(scene, Box{{5, 0, 0}, {9, 4, 3}}, diffuse(0.5));
    const std::vector<Sensor> sensors{desk(),
                                      area({{5, 0, 0.8}, {9, 0, 0.8}, {9, 4, 0.8}, {5, 4, 0.8}}, 0.5)};
    const RunResult result = measure(scene, sensors, rating_options("path"));
    EXPECT_GT(result.sensors.at(0).summary.minimum.value, 0);
    EXPECT_EQ(std::get<Area>(result.sensors.at(1).sensor.kind).left_out, 0U);
    EXPECT_EQ(result.sensors.at(1).readings.size(), 64U);
    EXPECT_EQ(result.sensors.at(1).summary.mean.value, 0);
    EXPECT_TRUE(std::ranges::any_of(texts_of(result.warnings), [](const std::string& warning) {
        return warning.find("sensor \"area\": 64 of 64 points lie") != std::string::npos;
    }));
}

TEST(Areas, WhollyBelowASurfaceAreAnError) {
    Scene scene = rated_room();
    add_object(scene, Rectangle{{2, 2, 0.36}, {2, 0, 0}, {0, 2, 0}}, diffuse(0.3));
    const Sensor floor = area({{2, 2, 0.35}, {4, 2, 0.35}, {4, 4, 0.35}, {2, 4, 0.35}}, 0.25);
    EXPECT_THROW(measure(scene, {&floor, 1}, rating_options("path")), InputError);
}

TEST(Areas, MeasureAsGridsDo) {
    const Sensor polygon = area({{0.5, 2.5, 0.8}, {3.5, 2.5, 0.8}, {3.5, 3.5, 0.8}, {0.5, 3.5, 0.8}}, 0.5);
    const Sensor grid{"grid", Grid{{0.5, 2.5, 0.8}, {3, 0, 0}, {0, 1, 0}, {6, 2}}};
    const RunResult by_area = measure(rated_room(), {&polygon, 1}, rating_options("path"));
    const RunResult by_grid = measure(rated_room(), {&grid, 1}, rating_options("path"));
    EXPECT_EQ(std::get<Area>(by_area.sensors[0].sensor.kind).left_out, 0U);
    EXPECT_EQ(by_area.sensors[0].summary.mean, by_grid.sensors[0].summary.mean);
    EXPECT_EQ(by_area.sensors[0].summary.diversity, by_grid.sensors[0].summary.diversity);
}

/// Against a derived value of the same formula.
TEST(PowerDensity, IsOfAllTaskAreasTogether) {
    Scene scene = rated_room();
    scene.lights.at(0).power_w = 90;
    const Sensor left = area({{0.5, 2.5, 0.8}, {1.5, 2.5, 0.8}, {1.5, 3.5, 0.8}, {0.5, 3.5, 0.8}}, 0.5);
    Sensor right = area({{2, 2.5, 0.8}, {3.5, 2.5, 0.8}, {3.5, 3.5, 0.8}, {2, 3.5, 0.8}}, 0.5);
    right.name = "right";
    Sensor wall = area({{0.01, 1, 1}, {0.01, 3, 1}, {0.01, 3, 2}, {0.01, 1, 2}}, 0.5);
    wall.name = "wall";
    const std::vector<Sensor> sensors{left, right, wall,
                                      derived("9000 / (area.mean * 1 + right.mean * 1.5)")};
    const RunResult result = measure(scene, sensors, rating_options("path"));
    ASSERT_TRUE(result.power_density);
    EXPECT_EQ(result.power.power_w, 90);
    EXPECT_DOUBLE_EQ(result.power_density->area_m2, 2.5) << "without the wall";
    EXPECT_DOUBLE_EQ(result.power_density->w_m2, 36);
    const statistics::Estimate& density = result.power_density->w_m2_per_100_lx;
    const statistics::Estimate& formula = value_of(result.sensors.at(3));
    EXPECT_NEAR(density.value, formula.value, 1e-12 * formula.value);
    EXPECT_NEAR(density.standard_error, formula.standard_error, 1e-9 * formula.value);
    EXPECT_NEAR(density.lower, formula.lower, 1e-9 * formula.value);
    EXPECT_NEAR(density.upper, formula.upper, 1e-9 * formula.value);
    EXPECT_GT(density.standard_error, 0);
}

TEST(PowerDensity, IsUnknownWithoutPowerOrArea) {
    Scene scene = rated_room();
    const Sensor task = area({{0.5, 2.5, 0.8}, {1.5, 2.5, 0.8}, {1.5, 3.5, 0.8}, {0.5, 3.5, 0.8}}, 0.5);
    EXPECT_FALSE(measure(scene, {&task, 1}, rating_options("path")).power_density);
    scene.lights.at(0).power_w = 90;
    const Sensor grid = desk();
    EXPECT_FALSE(measure(scene, {&grid, 1}, rating_options("path")).power_density);
}

TEST(Areas, WhollyInABodyAreDark) {
    const Sensor buried = area({{1.2, 1.2, 0.35}, {1.8, 1.2, 0.35}, {1.8, 1.8, 0.35}}, 0.1);
    const RunResult result = measure(rated_room(), {&buried, 1}, rating_options("path"));
    EXPECT_EQ(result.sensors.at(0).summary.mean.value, 0);
    ASSERT_FALSE(result.warnings.empty());
    EXPECT_NE(result.warnings[0].text.find("which contains no light"), std::string::npos)
        << result.warnings[0].text;
}

}  // namespace
}  // namespace stilb::run
