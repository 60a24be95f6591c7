// The thresholds from which lines of sight and guesses leave light by mirrors to random paths:
//
//     line_of_sight.cpp   kMostFollowed 32           mirrors that a line of sight is followed by
//                         kLeastTransmission 0.005   the share of its luminance that is followed
//     light_guess.cpp     kSharp 100                 gloss in a guess, or traced as a mirror is
#include <gtest/gtest.h>

#include <cmath>

#include "estimators/estimates.h"
#include "estimators/estimator_list.h"
#include "exact/closed_rooms.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "support/scene_builder.h"

namespace stilb::estimators {
namespace {

constexpr double kLuminance = 100;

statistics::Estimate exact(double value) { return {value, 0, value, value}; }

/// A room one metre high whose floor and ceiling are mirrors. Its walls shine.
Scene mirrored_room(double mirror, double reflectance_of_walls) {
    const Box room{{0, 0, 0}, {40, 1, 1}};
    Scene scene;
    for (const Side side : {Side::low, Side::high}) {
        add_object(scene, wall(room, 2, side), Mirror{Rgb::grey(mirror)});
        for (const std::size_t axis : {0, 1})
            add_area_light(scene, wall(room, axis, side), Rgb::grey(kLuminance),
                           diffuse(reflectance_of_walls));
    }
    return scene;
}

/// From halfway up at one end to the other end, by so many mirrors.
LineOfSight by_mirrors(int mirrors) {
    return {{0.1, 0.5, 0.5}, normalized(Vec3{39.9, 0, static_cast<double>(mirrors)})};
}

/// `samples`: 64 of which share a path that goes on behind the last mirror, except in path tracing.
void expect_luminance(const Scene& scene, int mirrors, double exact_cd_m2, std::uint64_t samples) {
    const MeasuredScene measured(scene, {by_mirrors(mirrors)});
    for (const Maker make : {make_path, make_balanced, make_guided}) {
        statistics::Estimate found = measured.by(make, samples).front();
        // Where all paths survive, or as many in each replicate, replicates agree: by one path at most. One
        // that survives roulette brings an eighth of the luminance, or all that is left.
        const double of_path =
            std::max(exact_cd_m2, kLuminance / 8) * 64 / static_cast<double>(kReplicates * samples);
        if (found.standard_error == 0 && found.value != exact_cd_m2) found.standard_error = of_path;
        EXPECT_LT(distance_of(found, exact(exact_cd_m2)), 3.9)
            << mirrors << " mirrors: " << found.value << " +- " << found.standard_error << ", exact "
            << exact_cd_m2;
        EXPECT_LT(found.standard_error, 0.2 * exact_cd_m2);
    }
}

TEST(LineOfSight, IsFollowedByMirrorsOrGoesOnAsAPath) {
    for (const int mirrors : {31, 32, 33, 34}) {
        expect_luminance(mirrored_room(1, 0.5), mirrors, exact::furnace_luminance_cd_m2(kLuminance, 0.5), 16);
        expect_luminance(mirrored_room(0.98, 0), mirrors, std::pow(0.98, mirrors) * kLuminance, 1024);
    }
}

TEST(LineOfSight, IsFollowedWhereItKeepsEnoughLight) {
    for (const double reflectance : {0.0049, 0.005, 0.0051})
        expect_luminance(mirrored_room(reflectance, 0), 1, reflectance * kLuminance, 4096);
    for (const double reflectance : {0.0706, 0.0708})  // squared 0.00498 and 0.00501
        expect_luminance(mirrored_room(reflectance, 0), 2, reflectance * reflectance * kLuminance, 4096);
}

TEST(Guess, TakesGlossOrTracesItAsAMirror) {
    for (const double exponent : {393.0, 396.9, 397.1, 401.0}) {
        const Phong gloss{Rgb{}, Rgb::grey(0.8), exponent};
        EXPECT_EQ(mean_concentration(gloss) > 100, exponent > 397);
        Scene scene;
        add_object(scene, inward(Box{{0, 0, 0}, {3, 3, 2.5}}), diffuse(0.5));
        add_object(scene, wall(Box{{0.001, 0.5, 0.5}, {3, 2.5, 2}}, 0, Side::low), gloss);
        add_area_light(scene, Rectangle{{2, 1, 2.4}, {0, 0.8, 0}, {0.8, 0, 0}}, Rgb::grey(1000));
        std::vector<Measurand> measurands;
        for (const double x : {0.2, 0.6, 1.5, 2.5})
            measurands.push_back(MeasuringPoint{{x, 1.4, 0}, {0, 0, 1}});
        measurands.push_back(LineOfSight{{2.8, 1.5, 1.2}, {-1, 0, 0}});
        const MeasuredScene measured(scene, measurands);
        const auto expected = measured.by(make_path, 4096, 5);
        const auto found = measured.by(make_guided, 128);
        for (std::size_t j = 0; j < measurands.size(); ++j) {
            EXPECT_LT(distance_of(found[j], expected[j]), 3.9)
                << exponent << ", " << j << ": " << found[j].value << " +- " << found[j].standard_error
                << ", " << expected[j].value << " +- " << expected[j].standard_error;
            EXPECT_LT(found[j].standard_error, 0.03 * expected[j].value) << exponent << ", " << j;
        }
    }
}

}  // namespace
}  // namespace stilb::estimators
