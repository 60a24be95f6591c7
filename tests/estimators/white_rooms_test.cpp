// Closed rooms that reflect nearly all light. All of their surfaces shine alike, so light is L / (1 -
// reflectance) everywhere: exact, at every point and in corners.
#include <gtest/gtest.h>

#include <cmath>

#include "estimators/estimates.h"
#include "estimators/estimator_list.h"
#include "exact/closed_rooms.h"
#include "support/scene_builder.h"

namespace stilb::estimators {
namespace {

constexpr double kWallLuminance = 100;

Scene furnace(double reflectance) {
    Scene scene;
    add_area_light(scene, inward(Box{{0, 0, 0}, {2, 2, 2}}), Rgb::grey(kWallLuminance), diffuse(reflectance));
    return scene;
}

class WhiteRoom : public testing::TestWithParam<std::tuple<Maker, double>> {};

TEST_P(WhiteRoom, HasAllOfItsLight) {
    const auto& [make, reflectance] = GetParam();
    const MeasuredScene room(furnace(reflectance), {MeasuringPoint{{0.7, 1.1, 0.4}, {0, 0, 1}},
                                                    MeasuringPoint{{1, 1, 0}, {0, 0, 1}}});
    const double exact_lx = exact::furnace_illuminance_lx(kWallLuminance, reflectance);
    // About as many reflections for each reflectance; a sample by a guess is 32 paths.
    const double paths = make == make_guided ? 60 : 2000;
    const auto samples = static_cast<std::uint64_t>(std::max(1., paths * (1 - reflectance)));
    for (const statistics::Estimate& reading : room.by(make, samples)) {
        const statistics::Estimate exact{exact_lx, 0, exact_lx, exact_lx};
        EXPECT_LT(distance_of(reading, exact), 3.9)
            << reading.value << " +- " << reading.standard_error << ", exact " << exact_lx;
        EXPECT_LT(reading.standard_error, 0.2 * exact_lx);
    }
}

constexpr auto kNumber = [](const auto& of) { return std::to_string(of.index); };

INSTANTIATE_TEST_SUITE_P(All, WhiteRoom,
                         testing::Combine(testing::Values(make_path, make_balanced, make_guided, make_local),
                                          testing::Values(0.9, 0.99, 0.999)),
                         kNumber);
/// Light paths would take a minute.
INSTANTIATE_TEST_SUITE_P(Whitest, WhiteRoom,
                         testing::Combine(testing::Values(make_path), testing::Values(0.9999)), kNumber);

/// Between two boards from which light soon escapes, a per mille of reflectance changes it by half a per cent
/// at most: around the reflectances from which on walks end in another way (weights.h, kMostSurvival 0.999
/// and kWhite 0.99999).
TEST(WhiteBoards, ReflectAlikeWhereverWalksEndInAnotherWay) {
    const auto readings = [](double reflectance, Maker make) {
        Scene scene;
        add_area_light(scene, Rectangle{{0, 0, 0.2}, {0, 1, 0}, {1, 0, 0}}, Rgb::grey(kWallLuminance),
                       diffuse(reflectance));
        add_object(scene, Rectangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, diffuse(reflectance));
        const MeasuredScene boards(std::move(scene), {MeasuringPoint{{0.5, 0.5, 0}, {0, 0, 1}},
                                                      MeasuringPoint{{0.2, 0.3, 0}, {0, 0, 1}}});
        return boards.by(make, make == make_guided ? 64 : 4096);
    };
    const auto expected = readings(0.998, make_path);
    for (const double reflectance : {0.9989, 0.999, 0.9991, 0.99998, 0.99999, 0.999991, 1.0}) {
        for (const Maker make : {make_path, make_balanced, make_guided, make_local}) {
            const auto found = readings(reflectance, make);
            for (std::size_t j = 0; j < found.size(); ++j) {
                const double error = std::hypot(found[j].standard_error, expected[j].standard_error);
                EXPECT_NEAR(found[j].value, expected[j].value, 4.5 * error + 0.008 * expected[j].value)
                    << reflectance << ", " << j;
                EXPECT_LT(error, 0.02 * expected[j].value) << reflectance;
            }
        }
    }
}

}  // namespace
}  // namespace stilb::estimators
