#include <gtest/gtest.h>

#include "../support/scene_builder.h"
#include "checks/checks.h"

namespace stilb::checks {
namespace {

Sensor sensor_in(const std::string& name, const Vec3& room) {
    return {name, IlluminancePoints{{{room + Vec3{1, 1, 0}, {0, 0, 1}}}}};
}

/// Two rooms so far apart, with a sensor each.
std::vector<std::string> warnings_of(double apart_m) {
    Scene scene;
    const Vec3 other{apart_m, 0, 0};
    for (const Vec3& at : {Vec3{}, other}) add_object(scene, Box{at, at + Vec3{4, 3, 2.5}}, diffuse(0.5));
    const std::vector<Sensor> sensors{sensor_in("here", {}), sensor_in("there", other)};
    return precision_warnings(rays::RayCaster(scene, Monitor::none(), sensors::measured_points(sensors)),
                              sensors);
}

TEST(Precision, SensorsInRoomsThatAreFarApart) {
    EXPECT_EQ(warnings_of(100), std::vector<std::string>{});
    const auto warnings = warnings_of(5000);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("m from the middle of what is measured"), std::string::npos) << warnings[0];
}

/// The sensor is in the middle of a cube, far away, whose walls are so many offsets away.
TEST(Precision, OffsetsOfAThousandthOfTheDistancesAreNamed) {
    const Vec3 far{1e5, 0, 0};
    const std::vector<Sensor> sensors{{"here", IlluminancePoints{{{{0, 0, 0}, {0, 0, 1}}}}},
                                      {"there", IlluminancePoints{{{far, {0, 0, 1}}}}}};
    const auto look = [&](double half_m, const auto& at) {
        Scene scene;
        const Vec3 corner{half_m, half_m, half_m};
        for (const Vec3& middle : {Vec3{}, far})
            add_object(scene, Box{middle - corner, middle + corner}, diffuse(0.5));
        const rays::RayCaster caster(scene, Monitor::none(), sensors::measured_points(sensors));
        return at(caster);
    };
    // Rays are most exact at one of the two sensors.
    const auto larger_offset_m = [&](const rays::RayCaster& caster) {
        return std::max(caster.offset_m({}, 0), caster.offset_m(far, 0));
    };
    const double offset_m = look(10, larger_offset_m);
    const auto warnings_at = [&](double offsets) {
        return look(offsets * offset_m, [&](const rays::RayCaster& caster) {
            EXPECT_NEAR(larger_offset_m(caster) / offset_m, 1, 0.001);
            return precision_warnings(caster, sensors).size();
        });
    };
    EXPECT_EQ(warnings_at(990), 1u);
    EXPECT_EQ(warnings_at(1010), 0u);
}

TEST(Precision, FarThingsWithoutSensorsDoNotMatter) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.5}}, diffuse(0.5));
    add_object(scene, Sphere{{1e6, 0, 0}, 100}, diffuse(0.5));
    const std::vector<Sensor> sensors{sensor_in("here", {})};
    const rays::RayCaster caster(scene, Monitor::none(), sensors::measured_points(sensors));
    EXPECT_EQ(precision_warnings(caster, sensors), std::vector<std::string>{});
}

}  // namespace
}  // namespace stilb::checks
