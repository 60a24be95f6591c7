// Points and results as rtrace has them, and the choice of the reader by the kind of a file.
#include "io/import/rtrace.h"

#include <fstream>

#include "io/import/scene_formats.h"
#include "io/text/radiance_units.h"
#include "io/text/text.h"
#include "radiance_text.h"

namespace stilb::io {
namespace {

std::string refusal_of_points(const std::string& text) {
    try {
        read_points(text, "grid.pts");
        return "accepted";
    } catch (const InputError& error) {
        return error.what();
    }
}

TEST(Rtrace, PointsAreReadLineByLine) {
    const Sensor sensor = read_points("# header\n0 0 1 0 0 2\n\n\t1.5e0 2 3\t-1 0 0  # wall\r\n", "grid.pts");
    EXPECT_EQ(sensor.name, "points");
    const auto& points = std::get<IlluminancePoints>(sensor.kind).points;
    ASSERT_EQ(points.size(), 2u);
    EXPECT_EQ(points[0].normal, (Vec3{0, 0, 1}));
    EXPECT_EQ(points[1].position, (Vec3{1.5, 2, 3}));
    EXPECT_EQ(points[1].normal, (Vec3{-1, 0, 0}));
}

TEST(Rtrace, WrongPointsAreRefused) {
    EXPECT_EQ(refusal_of_points("0 0 0 0 0 1\n1 2 3 4 5\n"),
              "grid.pts:2: found 5 numbers. Needed: six, the position and the normal, x y z nx ny nz.");
    EXPECT_EQ(refusal_of_points("0 0 x 0 0 1\n"),
              "grid.pts:1: found \"x\". Allowed: numbers from -1e9 to 1e9.");
    EXPECT_EQ(refusal_of_points("0 0 0 0 0 0\n"),
              "grid.pts:1: the normal is 0 0 0. Allowed: any other direction.");
    EXPECT_EQ(refusal_of_points("\n"),
              "grid.pts: there is no point. Needed: lines of six numbers, x y z nx ny nz.");
}

TEST(Rtrace, IrradiancesAreWrittenInTheOrderOfThePoints) {
    RunResult result;
    run::SensorResult sensor;
    sensor.sensor = read_points("0 0 0 0 0 1\n1 0 0 0 0 1\n", "p");
    sensor.readings.resize(2);
    sensor.readings[0].rgb = photometric({{1, 2, 3}});
    sensor.readings[1].rgb = photometric({{0.5, 0, 0.25}});
    result.sensors.push_back(sensor);
    EXPECT_EQ(to_irradiance_lines(result),
              "1.000000e+00\t2.000000e+00\t3.000000e+00\t\n5.000000e-01\t0.000000e+00\t2.500000e-01\t\n");
    EXPECT_NEAR(sensor.readings[0].rgb.luminance(), 179 * (0.265 * 1 + 0.67 * 2 + 0.065 * 3), 1e-12);
}

TEST(SceneFormats, RadianceScenesAreReadByTheirExtension) {
    const auto room = kRadianceData / "room.rad";
    EXPECT_EQ(load_scene(room).scene.lights.size(), 4u);
    const std::vector<std::string> overrides{"run.method=path", "sensors.desk.type=illuminance",
                                             "sensors.desk.position=[1, 1, 0.8]",
                                             "sensors.desk.normal=[0, 0, 1]"};
    const SceneFile measured = load_scene(room, overrides);
    EXPECT_EQ(measured.run.method, "path");
    ASSERT_EQ(measured.sensors.size(), 1u);
    EXPECT_EQ(measured.sensors[0].name, "desk");
    const SceneFile scaled = load_scene(room, std::vector<std::string>{"import.scale=0.01"});
    EXPECT_NEAR(bounds_of(scaled.scene).half_extent(), 0.01 * bounds_of(measured.scene).half_extent(), 1e-9);
    EXPECT_THROW(load_scene(room, std::vector<std::string>{"materials.red.reflectance=0.1"}), InputError);
}

TEST(SceneFormats, AllFilesOfARadianceSceneAreItsSources) {
    const SceneFile file = load_scene(kRadianceData / "room.rad");
    std::vector<std::string> names;
    for (const auto& source : file.sources) names.push_back(source.filename().string());
    EXPECT_EQ(names.front(), "room.rad");
    for (const char* name : {"leg.rad", "chair.rad", "rod.rad", "lamp.rad", "downlight.rad", "downlight.dat"})
        EXPECT_EQ(std::ranges::count(names, name), 1) << name;
    EXPECT_EQ(light_hash(file.sources).size(), 16u);
}

}  // namespace
}  // namespace stilb::io
