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
