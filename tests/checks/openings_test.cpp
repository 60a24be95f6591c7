// Openings of luminaires whose size is that of another unit (lights/opening_shape.h, kSmallestOpening_m 5 mm
// and kLargestOpening_m 10 m).
#include <gtest/gtest.h>

#include "../support/scene_builder.h"
#include "checks/checks.h"

namespace stilb::checks {
namespace {

void add_lamp(Scene& scene, const Vec3& extent_m) {
    const PhotometricSolid downwards({.planes_deg = {0}, .polar_deg = {0, 90}, .intensity_cd = {100, 0}});
    add_opening(scene, {0, 0, 0}, downwards, {lights::Opening::Form::box, extent_m});
}

std::vector<std::string> warnings_of(const Vec3& extent_m) {
    Scene scene;
    add_lamp(scene, extent_m);
    return opening_warnings(scene);
}

TEST(Openings, OfUsualSizesAreFine) {
    for (const double size_m : {0.005, 0.00501, 0.6, 9.99, 10.0})
        EXPECT_EQ(warnings_of({size_m, 0.004, 0}), std::vector<std::string>{}) << size_m;
}

TEST(Openings, OfAnotherUnitAreNamedWithTheirSize) {
    for (const double size_m : {0.0006, 0.00499, 10.01, 600.0}) {
        const auto warnings = warnings_of({0.9 * size_m, size_m, 0});
        ASSERT_EQ(warnings.size(), 1u) << size_m;
        EXPECT_TRUE(warnings[0].starts_with("light \"0\": the luminous opening is ")) << warnings[0];
        EXPECT_NEAR(std::stod(warnings[0].substr(35)), size_m, 0.006 * size_m) << warnings[0];
        EXPECT_NE(warnings[0].find("metres"), std::string::npos);
    }
}

TEST(Openings, OfSeveralLampsGiveOneSentence) {
    Scene scene;
    for (const double size_m : {600.0, 0.6, 1200.0}) add_lamp(scene, {size_m, size_m, 0});
    const auto warnings = opening_warnings(scene);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_TRUE(warnings[0].starts_with("lights \"0\", \"2\": the luminous opening is 600 m large"))
        << warnings[0];
}

TEST(Openings, OfPointsAndOtherLampsAreNone) {
    Scene scene;
    add_point_light(scene, {0, 0, 0}, Rgb::grey(1));
    add_area_light(scene, Rectangle{{0, 0, 0}, {100, 0, 0}, {0, 100, 0}}, Rgb::grey(1));
    EXPECT_EQ(opening_warnings(scene), std::vector<std::string>{});
}

}  // namespace
}  // namespace stilb::checks
