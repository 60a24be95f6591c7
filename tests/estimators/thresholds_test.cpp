// The numbers at which estimators take another way, crossed one by one: below, at and above each of them the
// same readings have the same values. The list:
//
// numbers of readings
//     auto.cpp              kMostReadings 64       few readings by path tracing or light paths, more by
//     pilots
//                           kVeryFew 16            worth twice the work of planning
//                           kRun 16, kMostInPilots 128   readings in runs of a pilot, and in all of it
//     base/rays.h           kPacketWidth 16        receivers of a tile
//     local_estimation.cpp  paths_per_selected()   doubles at 80, 320, 1280 ... receivers
//     split_plan.cpp        planning_rays_per_point()   fewer rays from 8 receivers on, the least from 512 on
//                           kMostSurveyed 1024     tiles that are planned; the others take the plan of these
// numbers of lamps
//     bounded_direct.h      kEach 4                lamps with an area: all of them, or some that are chosen
//                           kEach x samples        the same of point lights: 8 (kSideDirect 2) and 32
//                                                  (kResidualDirect 8)
// numbers of samples
//     local_estimation.cpp  kPathBlock 512         light paths that are connected together
//     guided_light.cpp      kSamplesTogether 64    samples whose vertices are selected together
//     path.cpp              kSideBySide 256        paths that are traced together
//     connection.cpp        kBlock 64              vertices that are connected together
// reflectances
//     weights.h             kMostSurvival 0.999, kWhite 0.99999   white_rooms_test.cpp
// dark readings
//     statistics/interval.h kDarkShare 0.01        statistics: stopping_test.cpp
//
// Elsewhere: packets with paces (pace_test.cpp, run: paces_test.cpp), patches without an area (patches:
// regular_patches_test.cpp). Constants that weigh costs or densities (kWorthPlanning, kSobolGain, kDefensive,
// kFloor, kResidualSplit ...) change the noise alone; auto_test.cpp has choices on both sides of those of
// auto.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "estimators/estimates.h"
#include "estimators/estimator_list.h"
#include "support/coarser.h"
#include "support/scene_builder.h"

namespace stilb::estimators {
namespace {

/// Readings that all counts have in common.
constexpr std::size_t kCommon = 7;
constexpr double kFamilyError = 0.01;
constexpr double kFactor = 1.5;  ///< of coarser()

Scene room() {
    Scene scene;
    add_object(scene, inward(Box{{0, 0, 0}, {4.2, 3.1, 2.6}}), diffuse(0.6));
    add_object(scene, Box{{2.5, 0.4, 0}, {3.3, 1.2, 0.7}}, diffuse(0.4));
    return scene;
}

/// A lamp cut into strips.
Scene room_with_strips(std::size_t count) {
    Scene scene = room();
    const double width_m = 0.8 / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double x = 1.7 + width_m * static_cast<double>(i);
        add_area_light(scene, Rectangle{{x, 1.1, 2.5}, {0, 0.8, 0}, {width_m, 0, 0}}, Rgb::grey(1000));
    }
    return scene;
}

/// A point light cut into lights of the same place.
Scene room_with_points(std::size_t count) {
    Scene scene = room();
    for (std::size_t i = 0; i < count; ++i)
        add_point_light(scene, {2.1, 1.5, 2.2}, Rgb::grey(400 / static_cast<double>(count)));
    return scene;
}

/// The first ones are the same for all counts.
std::vector<Measurand> points(std::size_t count) {
    std::vector<Measurand> all;
    for (std::size_t i = 0; i < count; ++i) {
        const auto n = static_cast<double>(i + 1);
        const double u = n * 0.7548776662466927, v = n * 0.5698402909980532;
        all.push_back(MeasuringPoint{{0.2 + 3.8 * (u - std::floor(u)), 0.2 + 2.7 * (v - std::floor(v)), 0.85},
                                     {0, 0, 1}});
    }
    return all;
}

/// The common readings, by the most direct way.
std::vector<statistics::Estimate> reference(Scene scene) {
    return MeasuredScene(std::move(scene), points(kCommon)).by(make_path, fewer(4096, kFactor), 99);
}

void expect_same(const std::vector<statistics::Estimate>& readings,
                 const std::vector<statistics::Estimate>& expected, std::size_t comparisons,
                 const std::string& where) {
    const double threshold = statistics::sidak_threshold_z(kFamilyError, comparisons * kCommon);
    for (std::size_t j = 0; j < kCommon; ++j) {
        EXPECT_LT(distance_of(readings[j], expected[j]), threshold)
            << where << ", reading " << j << ": " << readings[j].value << " +- " << readings[j].standard_error
            << ", " << expected[j].value << " +- " << expected[j].standard_error;
        EXPECT_LT(readings[j].standard_error, 0.03 * coarser(kFactor) * expected[j].value) << where;
    }
}

TEST(Thresholds, OfNumbersOfReadings) {
    const Scene scene = room_with_strips(1);
    const auto expected = reference(scene);
    const std::vector<std::size_t> counts{7,   8,   9,   15,  16,  17,  63,  64,  65,  79,   80,   81,
                                          127, 128, 129, 319, 320, 321, 511, 512, 513, 1279, 1280, 1281};
    for (const std::size_t count : counts) {
        const MeasuredScene measured(scene, points(count));
        const std::string readings = std::to_string(count) + " readings";
        // Method auto takes one of these.
        expect_same(measured.by(make_balanced, fewer(2048, kFactor), count), expected, 3 * counts.size(),
                    "balanced, " + readings);
        expect_same(measured.by(make_guided, fewer(32, kFactor), count), expected, 3 * counts.size(),
                    "guided, " + readings);
        if (count > 130) continue;
        const std::unique_ptr<Estimator> chosen = make_auto(measured.problem());
        const std::uint64_t samples = fewer(chosen->technique() == "light-paths" ? 2048 : 512, kFactor);
        expect_same(estimates_of(*chosen, count, math::RandomKey{count}, samples), expected,
                    3 * counts.size(), "auto, " + readings);
    }
}

TEST(Thresholds, OfNumbersOfSurveyedTiles) {
    const Scene scene = room_with_strips(1);
    const auto expected = reference(scene);
    for (const std::size_t tiles : {1023, 1024, 1025}) {
        const MeasuredScene measured(scene, points(16 * tiles));
        expect_same(measured.by(make_balanced, fewer(2048, kFactor)), expected, 3,
                    std::to_string(tiles) + " tiles");
    }
}

TEST(Thresholds, OfNumbersOfLamps) {
    const auto expected = reference(room_with_strips(1));
    for (const std::size_t count : {3, 4, 5, 7, 8, 9}) {
        const MeasuredScene measured(room_with_strips(count), points(kCommon));
        const std::string lamps = std::to_string(count) + " strips";
        expect_same(measured.by(make_guided, fewer(128, kFactor), count), expected, 18, "guided, " + lamps);
        expect_same(measured.by(make_balanced, fewer(4096, kFactor), count), expected, 18,
                    "balanced, " + lamps);
        expect_same(measured.by(make_path, fewer(1024, kFactor), count), expected, 18, "path, " + lamps);
    }
}

TEST(Thresholds, OfNumbersOfPointLights) {
    const auto expected = reference(room_with_points(1));
    for (const std::size_t count : {3, 4, 5, 7, 8, 9, 31, 32, 33}) {
        const MeasuredScene measured(room_with_points(count), points(kCommon));
        const std::string lamps = std::to_string(count) + " points";
        expect_same(measured.by(make_guided, fewer(128, kFactor), count), expected, 27, "guided, " + lamps);
        expect_same(measured.by(make_balanced, fewer(4096, kFactor), count), expected, 27,
                    "balanced, " + lamps);
        expect_same(measured.by(make_path, fewer(1024, kFactor), count), expected, 27, "path, " + lamps);
    }
}

TEST(Thresholds, OfNumbersOfSamples) {
    const Scene scene = room_with_strips(1);
    const auto expected = reference(scene);
    const MeasuredScene measured(scene, points(100));
    for (const std::uint64_t samples : {63, 64, 65})
        expect_same(measured.by(make_guided, samples), expected, 9, std::to_string(samples) + " samples");
    for (const std::uint64_t samples : {255, 256, 257})
        expect_same(measured.by(make_path, samples), expected, 9, std::to_string(samples) + " paths");
    // Two paths for each that is selected: the block is twice as long.
    for (const std::uint64_t samples : {896, 1024, 1152}) {
        expect_same(measured.by(make_balanced, samples, samples), expected, 9,
                    std::to_string(samples) + " light paths");
    }
}

}  // namespace
}  // namespace stilb::estimators
