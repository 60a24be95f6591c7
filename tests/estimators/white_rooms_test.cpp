// Closed rooms that reflect nearly all light. All of their surfaces shine alike, so light is L / (1 -
// reflectance) everywhere: exact, at every point and in corners.
#include <gtest/gtest.h>

#include "estimators/estimates.h"
#include "estimators/estimator_list.h"
#include "exact/closed_rooms.h"
#include "support/scene_builder.h"

namespace stilb::estimators {
namespace {

constexpr double kLuminance = 100;

Scene furnace(double reflectance) {
    Scene scene;
    add_area_light(scene, inward(Box{{0, 0, 0}, {2, 2, 2}}), Rgb::grey(kLuminance), diffuse(reflectance));
    return scene;
}

class WhiteRoom : public testing::TestWithParam<std::tuple<Maker, double>> {};

TEST_P(WhiteRoom, HasAllOfItsLight) {
    const auto& [make, reflectance] = GetParam();
    const MeasuredScene room(furnace(reflectance), {MeasuringPoint{{0.7, 1.1, 0.4}, {0, 0, 1}},
                                                    MeasuringPoint{{1, 1, 0}, {0, 0, 1}}});
    const double exact_lx = exact::furnace_illuminance_lx(kLuminance, reflectance);
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

}  // namespace
}  // namespace stilb::estimators
