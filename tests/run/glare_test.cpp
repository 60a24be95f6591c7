// The Unified Glare Rating against its formula, where all of its parts are known.
#include "transport/glare/glare.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "materials/black.h"
#include "materials/translucent.h"
#include "run/run.h"
#include "statistics/hypothesis.h"
#include "support/scene_builder.h"

namespace stilb {
namespace {

using run::Verdict;

constexpr double kBackground = 20, kLamp = 5000, kRadius = 0.15;
const MeasuringPoint kEye{{0, 0, 1.2}, {0, 1, 0}};
const Vec3 kMiddle{0.5, 3, 2.2};

/// A lamp that faces the eye in a uniform environment: E - Ed is what the lamp leaves of the environment.
Scene lamp_in_an_environment(double background = kBackground) {
    Scene scene;
    add_area_light(scene, Disk{kMiddle, normalized(kEye.position - kMiddle), kRadius}, Rgb::grey(kLamp));
    add_environment(scene, Rgb::grey(background));
    return scene;
}

/// For an eye at the same place, whatever it looks at.
double exact_ugr(double background_cd_m2 = kBackground, const Vec3& sight = kEye.normal) {
    const Vec3 towards = kMiddle - kEye.position;
    const double distance = length(towards);
    const double solid_angle = 2 * kPi * (1 - distance / std::hypot(distance, kRadius));
    const double p = transport::position_index(normalized(towards), sight);
    // Of the lamp's disk as seen from the eye: sin^2 of its angular radius times the cosine of its middle.
    const double sine_squared = kRadius * kRadius / (distance * distance + kRadius * kRadius);
    const double hidden_sr = kPi * sine_squared * dot(normalized(towards), sight);
    const double background = background_cd_m2 * (1 - hidden_sr / kPi);
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
        EXPECT_TRUE(result.warnings.empty()) << result.warnings[0].text;
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

/// Nearly all light at the eye is the lamp's own, so that noise makes backgrounds of replicates negative.
TEST(UnifiedGlareRating, HasHonestIntervalsWhereReplicatesAreNegative) {
    constexpr double dim = 0.06;
    const Scene scene = lamp_in_an_environment(dim);
    RunOptions options;
    options.method = "path";
    options.paths = 32;
    const Vec3 aside = normalized(Vec3{-0.3, 1, 0});  // away from the lamp: this rating is the lower one
    const std::vector<Sensor> sensors{{"eyes", Ugr{{kEye, {kEye.position, aside}}}}};
    const double exact = exact_ugr(dim), exact_aside = exact_ugr(dim, aside);
    ASSERT_LT(exact_aside, exact);
    const auto holds = [](const statistics::Estimate& estimate, double truth) {
        return estimate.lower <= truth && truth <= estimate.upper;
    };
    constexpr int kSeeds = 200;
    int covered = 0, of_smallest = 0, of_largest = 0, unbounded = 0;
    for (int seed = 1; seed <= kSeeds; ++seed) {
        options.seed = static_cast<std::uint64_t>(seed);
        const run::SensorResult result = run::measure(scene, sensors, options).sensors.at(0);
        covered += holds(result.readings.at(0).estimate, exact);
        of_smallest += holds(result.summary.minimum, exact_aside);
        of_largest += holds(result.summary.maximum, exact);
        unbounded += std::isinf(result.summary.maximum.upper);
        EXPECT_FALSE(std::isnan(result.summary.maximum.lower));
    }
    // 95 % of 200 less three standard deviations; extremes may be conservative.
    EXPECT_GE(covered, 181);
    EXPECT_GE(of_smallest, 181);
    EXPECT_GE(of_largest, 181);
    EXPECT_GT(unbounded, kSeeds / 10) << "the case that is tested";
}

Sensor eye_that_requires(double most) {
    const auto ugr = std::ranges::find(sensors::kCriteria, "ugr", &sensors::Criterion::key);
    return {"eye", Ugr{{kEye}}, {{&*ugr, most}}};
}

TEST(UnifiedGlareRating, DecidesARequirementAndEndsTheRun) {
    const Scene scene = lamp_in_an_environment();
    RunOptions options;
    for (const auto& [most, verdict] :
         {std::pair{exact_ugr() + 1, Verdict::pass}, {exact_ugr() - 1, Verdict::fail}}) {
        const Sensor eye = eye_that_requires(most);
        const run::RunResult result = run::measure(scene, {&eye, 1}, options);
        EXPECT_EQ(result.stop_reason, StopReason::requirements_decided);
        EXPECT_EQ(run::verdict_of(result), verdict);
    }
    const Sensor close = eye_that_requires(exact_ugr());
    options.paths = 4096;
    EXPECT_EQ(run::verdict_of(run::measure(scene, {&close, 1}, options)), Verdict::undecided);
}

/// The replicates, their mean and their spread are those of the rating.
TEST(UnifiedGlareRating, HasReplicates) {
    const run::RunResult result = rated(lamp_in_an_environment(), 1);
    const run::SensorResult& eye = result.sensors.at(0);
    ASSERT_EQ(eye.replicate_means.size(), static_cast<std::size_t>(result.replicates));
    const auto again = statistics::estimate_from_replicates(eye.replicate_means);
    EXPECT_NEAR(again.value, eye.readings[0].estimate.value, 1e-9);
    EXPECT_NEAR(again.standard_error, eye.readings[0].estimate.standard_error, 1e-9);
    // The extremes of one reading are the reading; their intervals allow for a choice among several.
    EXPECT_EQ(eye.summary.maximum.value, eye.readings[0].estimate.value);
    EXPECT_NEAR(eye.summary.maximum.upper, eye.readings[0].estimate.upper, 0.1 * again.standard_error);
}

/// A narrow downlight straight above the eye is no source of glare, but its light is no background.
TEST(UnifiedGlareRating, LeavesOutLampsOutsideOfItsField) {
    constexpr double radius = 0.1, height = 1.6;
    Scene scene = lamp_in_an_environment();
    add_area_light(scene, Disk{{0, 0, 1.2 + height}, {0, 0, -1}, radius}, Rgb::grey(1e6));
    // The illuminance of a vertical element by half of a disk above it, over the luminance.
    const double half_disk =
        std::atan(radius / height) - radius * height / (radius * radius + height * height);
    const double hides = exact_ugr(kBackground * (1 - half_disk / kPi));
    const run::RunResult result = rated(scene, 1);
    const run::SensorResult& eye = result.sensors.at(0);
    EXPECT_LT(std::abs(statistics::z_score(eye.readings.at(0).estimate, hides)), 4);
    EXPECT_LT(eye.readings[0].estimate.standard_error, 0.1);
    ASSERT_EQ(eye.glare.at(0).sources.size(), 2u);
    EXPECT_EQ(eye.glare[0].sources[0].standing, run::GlareStanding::counted);
    EXPECT_EQ(eye.glare[0].sources[1].standing, run::GlareStanding::outside);
    EXPECT_TRUE(result.warnings.empty()) << result.warnings[0].text;
}

/// On the line of sight, where the position index is 1.
constexpr double kAway = 4;
Scene with_disk_of(double solid_angle_sr, double luminance) {
    Scene scene = lamp_in_an_environment();
    const double cosine = 1 - solid_angle_sr / (2 * kPi);
    const double radius = kAway * std::sqrt(1 - cosine * cosine) / cosine;
    add_area_light(scene, Disk{kEye.position + Vec3{0, kAway, 0}, {0, -1, 0}, radius}, Rgb::grey(luminance));
    return scene;
}
/// Of such a scene, where the small disk hides nothing that matters.
double exact_with(double solid_angle_sr, double luminance) {
    return 8 * std::log10(std::pow(10, exact_ugr() / 8) +
                          0.25 / kBackground * luminance * luminance * solid_angle_sr);
}

run::RatedRequirement verdict_at(const Scene& scene, double most, const MeasuringPoint& at = kEye) {
    Sensor eye = eye_that_requires(most);
    eye.kind = Ugr{{at}};
    RunOptions options;
    options.time_s = 3600;  // more than enough, also with sanitizers
    const run::RunResult result = run::measure(scene, {&eye, 1}, options);
    EXPECT_EQ(result.stop_reason, StopReason::requirements_decided);
    return result.sensors.at(0).requirements.at(0);
}

TEST(UnifiedGlareRating, DoesNotPassWhereWhatItLeavesOutCouldChangeTheVerdict) {
    constexpr double luminance = 1e5, small = 0.99 * transport::kLeastGlare_sr,
                     counted = 1.01 * transport::kLeastGlare_sr;
    const double counting_all = exact_with(small, luminance);
    ASSERT_GT(counting_all, exact_ugr() + 3);
    const Scene scene = with_disk_of(small, luminance);
    EXPECT_EQ(verdict_at(scene, exact_ugr() - 0.5).verdict, Verdict::fail);
    const run::RatedRequirement between = verdict_at(scene, counting_all - 0.5);
    EXPECT_EQ(between.verdict, Verdict::unsure);
    const std::size_t number = between.reason.find("with it the rating is ");
    ASSERT_NE(number, std::string::npos) << between.reason;
    EXPECT_NEAR(std::stod(between.reason.substr(number + 22)), counting_all, 0.1);
    EXPECT_EQ(verdict_at(scene, counting_all + 0.5).verdict, Verdict::pass);
    // A little larger, it counts.
    const Scene larger = with_disk_of(counted, luminance);
    const double with_it = exact_with(counted, luminance);
    EXPECT_EQ(verdict_at(larger, with_it - 0.5).verdict, Verdict::fail);
    EXPECT_EQ(verdict_at(larger, with_it + 0.5).verdict, Verdict::pass);
}

TEST(UnifiedGlareRating, DoesNotPassWithShadesThatMayGlare) {
    Scene scene = lamp_in_an_environment();
    add_object(scene, Rectangle{{2, 3, 1}, {0.2, 0, 0}, {0, 0, 0.2}},
               materials::Translucent({Rgb::grey(0.4), Rgb::grey(0.5), {}}));
    const run::RatedRequirement rated = verdict_at(scene, 60);
    EXPECT_EQ(rated.verdict, Verdict::unsure);
    EXPECT_NE(rated.reason.find("may glare by the light that it scatters"), std::string::npos)
        << rated.reason;
    // Behind the eye it does not matter.
    EXPECT_EQ(verdict_at(scene, 60, {{0, 4, 1.2}, {0, 1, 0}}).verdict, Verdict::pass);
}

TEST(UnifiedGlareRating, DoesNotPassWithLampsThatItWasNotMadeFor) {
    for (const auto& [solid_angle_sr, verdict] : {std::pair{0.99 * transport::kMostGlare_sr, Verdict::pass},
                                                  {1.01 * transport::kMostGlare_sr, Verdict::unsure}})
        EXPECT_EQ(verdict_at(with_disk_of(solid_angle_sr, 2000), 60).verdict, verdict);
    Scene scene = lamp_in_an_environment();
    add_point_light(scene, {0.5, 3, 1.2}, Rgb::grey(1));
    EXPECT_EQ(verdict_at(scene, 60).verdict, Verdict::unsure);
    // Behind the eye, straight above it and behind something the point does not matter.
    EXPECT_EQ(verdict_at(scene, 60, {{0, 4, 1.2}, {0, 1, 0}}).verdict, Verdict::pass);
    EXPECT_EQ(verdict_at(scene, 60, {{0.5, 2.9, 0.5}, {0, 1, 0}}).verdict, Verdict::pass);
    add_object(scene, Rectangle{{0.4, 2.5, 1.1}, {0.2, 0, 0}, {0, 0, 0.2}}, Black{});
    EXPECT_EQ(verdict_at(scene, 60).verdict, Verdict::pass);
}

TEST(UnifiedGlareRating, SaysWhatItLeavesOut) {
    Scene scene = lamp_in_an_environment();
    add_point_light(scene, {1, 2, 2}, Rgb::grey(10));
    add_area_light(scene, Sphere{{0, 4, 1.2}, 0.02}, Rgb::grey(1e6));
    const run::RunResult result = rated(scene, 1);
    ASSERT_EQ(result.warnings.size(), 2u) << fmt::format("{}", fmt::join(texts_of(result.warnings), "\n"));
    EXPECT_NE(result.warnings[0].text.find("is less than 0.0003 sr"), std::string::npos)
        << result.warnings[0].text;
    EXPECT_NE(result.warnings[1].text.find("a point has no luminous area"), std::string::npos)
        << result.warnings[1].text;
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
