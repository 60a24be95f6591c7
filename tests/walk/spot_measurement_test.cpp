#include "walk/service/spot_measurement.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>

#include "io/scene/scene_file.h"
#include "run/run.h"
#include "stilb/error.h"

namespace stilb::walk {
namespace {

/// Four lights of four kinds, two of them in one group.
constexpr const char* kSpotRoom = R"(
[materials.wall]
type = "diffuse"
reflectance = [0.7, 0.5, 0.3]
[objects.room]
shape = "box"
min = [0, 0, 0]
max = [4, 3, 2.5]
material = "wall"
[objects.panel]
shape = "rectangle"
corner = [1.7, 1.2, 2.49]
edge_u = [0.0, 0.6, 0.0]
edge_v = [0.6, 0.0, 0.0]
material = "wall"
[lights.panel]
type = "area"
object = "panel"
flux = 2000
[lights.left]
type = "point"
position = [1, 1.5, 2]
flux = 1000
group = "bulbs"
[lights.right]
type = "point"
position = [3, 1.5, 2]
flux = 500
group = "bulbs"
)";

class SpotTest : public testing::Test {
  protected:
    io::SceneFile file_ = io::read_scene(kSpotRoom, "s.toml", ".");
    RunOptions options_;
    SpotMeter meter_{file_.scene, options_};

    SpotReading measure(const std::string& json) { return meter_.measure(read_spot_request(json)); }

    /// By another seed, and more exactly.
    double reference(const Scene& scene, const sensors::SensorKind& kind) const {
        const std::array sensors{Sensor{"s", kind}};
        RunOptions options;
        options.error = 0.002;
        options.seed = 1234;
        return run::measure(scene, sensors, options).sensors[0].readings[0].estimate.value;
    }
};

constexpr const char* kDesk = R"("kind": "illuminance", "position": [2, 1, 0.75], "normal": [0, 0, 1])";
constexpr const char* kSight = R"("kind": "luminance", "position": [2, 1, 1.2], "direction": [0, 3, 0.5])";

std::string request(const std::string& members, const std::string& factors = "") {
    return "{" + members + (factors.empty() ? "" : ", \"factors\": {" + factors + "}") + "}";
}

void expect_agreement(const SpotReading& reading, double reference) {
    EXPECT_GT(reading.half_width, 0);
    EXPECT_LT(reading.half_width, 0.011 * reading.value);
    EXPECT_NEAR(reading.value, reference, 1.5 * reading.half_width + 0.002 * reference);
}

TEST_F(SpotTest, AgreesWithAMeasurement) {
    const SpotReading desk = measure(request(kDesk));
    EXPECT_EQ(desk.unit, "lx");
    EXPECT_LT(desk.time_s, 3);
    expect_agreement(desk, reference(file_.scene, sensors::IlluminancePoints{{{{2, 1, 0.75}, {0, 0, 1}}}}));
    const SpotReading wall = measure(request(kSight));
    EXPECT_EQ(wall.unit, "cd/m2");
    expect_agreement(
        wall,
        reference(file_.scene, sensors::Luminance{{LineOfSight{{2, 1, 1.2}, normalized(Vec3{0, 3, 0.5})}}}));
}

TEST_F(SpotTest, FactorsAreThoseOfADimmedScene) {
    io::SceneFile dimmed = io::read_scene(kSpotRoom, "s.toml", ".");
    for (Light& light : dimmed.scene.lights) {
        if (auto* area = std::get_if<lights::AreaLight>(&light.source)) area->luminance_cd_m2 *= 0.25;
        if (auto* point = std::get_if<lights::PointLight>(&light.source))
            point->intensity_cd *= Rgb{{2.0, 1.0, 0.0}};
    }
    const SpotReading desk = measure(request(kDesk, R"("panel": 0.25, "bulbs": [2, 1, 0])"));
    expect_agreement(desk, reference(dimmed.scene, sensors::IlluminancePoints{{{{2, 1, 0.75}, {0, 0, 1}}}}));
}

TEST_F(SpotTest, LightsThatAreOffAreLeftOut) {
    const SpotReading all = measure(request(kDesk)), panel = measure(request(kDesk, R"("bulbs": 0)")),
                      bulbs = measure(request(kDesk, R"("panel": 0)"));
    EXPECT_NEAR(all.value, panel.value + bulbs.value,
                1.5 * std::hypot(all.half_width, panel.half_width, bulbs.half_width));
    const SpotReading none = measure(request(kDesk, R"("panel": 0, "bulbs": 0)"));
    EXPECT_EQ(none.value, 0);
    EXPECT_EQ(none.half_width, 0);
}

TEST_F(SpotTest, FactorsOfEveryKindOfLight) {
    const std::string sky =
        std::string(kSpotRoom) + "[lights.sky]\ntype = \"environment\"\nluminance = 100\n";
    const io::SceneFile file = io::read_scene(sky, "s.toml", ".");
    const std::array factors{LightFactor{"sky", Rgb::grey(3)}, LightFactor{"panel", {{1.0, 2.0, 3.0}}}};
    const LightGroups groups = scene::light_groups(file.scene);
    const Scene scene = with_factors(file.scene, groups, scene::factors_of_groups(factors, groups.names));
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const Rgb was = scene::flux_lm(file.scene, file.scene.lights[i]),
                  is = scene::flux_lm(scene, scene.lights[i]);
        const std::string& name = scene.lights[i].name;
        const Rgb factor = name == "sky"     ? Rgb::grey(3)
                           : name == "panel" ? Rgb{{1.0, 2.0, 3.0}}
                                             : Rgb::grey(1);
        for (std::size_t b = 0; b < kBands; ++b)
            EXPECT_NEAR(is[b], factor[b] * was[b], 1e-9 * was[b]) << name;
    }
}

TEST_F(SpotTest, FactorsOfAPanorama) {
    Scene scene = file_.scene;
    lights::Panorama::Image image{4, 2, std::vector<std::array<float, 3>>(8, {1.0F, 2.0F, 4.0F})};
    scene.lights = {
        {"sky", lights::EnvironmentLight{{}, std::make_shared<lights::Panorama>(std::move(image))}}};
    const Scene dimmed = with_factors(scene, scene::light_groups(scene), std::array{Rgb{{0.5, 0.25, 2.0}}});
    const auto& sky = std::get<lights::EnvironmentLight>(dimmed.lights[0].source);
    EXPECT_EQ(sky.panorama->luminance_cd_m2({0, 0, 1}), (Rgb{{0.5, 0.5, 8.0}}));
}

TEST_F(SpotTest, MeasurementsAtTheSameTimeWaitForEachOther) {
    std::array<double, 4> values{};
    std::array<std::thread, 4> threads;
    for (std::size_t i = 0; i < threads.size(); ++i)
        threads[i] = std::thread([&, i] { values[i] = measure(request(kDesk)).value; });
    for (std::thread& thread : threads) thread.join();
    for (const double value : values) EXPECT_EQ(value, values[0]);
}

TEST_F(SpotTest, EndsWhereItIsCancelled) {
    std::thread canceller([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        meter_.cancel();
    });
    const auto begin = std::chrono::steady_clock::now();
    try {
        for (;;) measure(request(kSight));
    } catch (const Cancelled&) {
    }
    canceller.join();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(700));
}

TEST_F(SpotTest, WrongRequestsAreRefused) {
    for (const std::string& json :
         {std::string(""),
          std::string("{"),
          std::string("null"),
          std::string("{}"),
          std::string(70'000, '['),
          request(R"("kind": "colour", "position": [1, 1, 1], "normal": [0, 0, 1])"),
          request(R"("kind": 1, "position": [1, 1, 1], "normal": [0, 0, 1])"),
          request(R"("kind": "illuminance", "position": [1, 1, 1])"),
          request(R"("kind": "illuminance", "position": [1, 1, 1], "direction": [0, 0, 1])"),
          request(R"("kind": "illuminance", "position": [1, 1, 1, 1], "normal": [0, 0, 1])"),
          request(R"("kind": "illuminance", "position": "here", "normal": [0, 0, 1])"),
          request(R"("kind": "illuminance", "position": [1, "1", 1], "normal": [0, 0, 1])"),
          request(R"("kind": "illuminance", "position": [1, NaN, 1], "normal": [0, 0, 1])"),
          request(R"("kind": "illuminance", "position": [1, 1e400, 1], "normal": [0, 0, 1])"),
          request(R"("kind": "illuminance", "position": [1, 1e300, 1], "normal": [0, 0, 1])"),
          request(R"("kind": "illuminance", "position": [1, 1, 1], "normal": [0, 0, 0])"),
          request(R"("kind": "luminance", "position": [1, 1, 1], "direction": [1e-200, 0, 0])"),
          request(kDesk, R"("panel": -1)"),
          request(kDesk, R"("panel": [1, 1])"),
          request(kDesk, R"("panel": "on")"),
          request(kDesk, R"("panel": 1e300)"),
          request(std::string(kDesk) + R"(, "factors": [1])"),
          request(kDesk, R"("lamp": 0.5)")})
        EXPECT_THROW(measure(json), InputError) << json.substr(0, 100);
}

TEST_F(SpotTest, AUnknownGroupIsNamed) {
    try {
        measure(request(kDesk, R"("lamp": 0.5)"));
        FAIL();
    } catch (const InputError& error) {
        for (const char* part : {"lamp", "panel", "bulbs"})
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos);
    }
}

TEST(SpotJson, UnknownErrorsAreNull) {
    EXPECT_EQ(to_json({2.5, 0.5, "lx", 1.0}),
              R"({"value":2.5,"half_width":0.5,"unit":"lx","time_s":1.0,"method":"auto"})");
    EXPECT_NE(to_json({2.5, std::nan(""), "lx", 1.0}).find(R"("half_width":null)"), std::string::npos);
}

}  // namespace
}  // namespace stilb::walk
