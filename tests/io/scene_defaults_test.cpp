// The section [defaults], and maintenance factors.
#include "io/scene_text.h"
#include "materials/black.h"
#include "materials/diffuse.h"

namespace stilb::io {
namespace {

const std::string kLights = R"(
[lights.a]
type = "point"
position = [0, 0, 1]
flux = 100
[lights.b]
type = "point"
position = [0, 0, 2]
intensity = 100
color = [1, 0, 0]
)";

const Rgb& intensity_of(const SceneFile& file, std::size_t light) {
    return std::get<PointLight>(file.scene.lights.at(light).source).intensity_cd;
}

double flux_of(const SceneFile& file, std::size_t light) {
    return flux_lm(file.scene, file.scene.lights.at(light)).luminance();
}

TEST(SceneDefaults, FillKeysThatAreLeftOut) {
    const SceneFile plain = read_scene_text(kLights),
                    file = read_scene_text("[defaults.lights]\ncct = 2700\n" + kLights);
    EXPECT_GT(intensity_of(file, 0)[0], 1.5 * intensity_of(file, 0)[2]) << "warm";
    EXPECT_EQ(intensity_of(file, 1), intensity_of(plain, 1)) << "its own colour";
    EXPECT_NEAR(flux_of(file, 0), 100, 1e-9);
}

TEST(SceneDefaults, YieldToAlternatives) {
    const SceneFile file =
        read_scene_text("[defaults.lights]\nflux = 7\nposition = [1, 1, 1]\n" + kLights +
                        "[lights.c]\ntype = \"point\"\npositions = [[0, 0, 3]]\n[lights.d]\ntype = "
                        "\"point\"");
    EXPECT_NEAR(flux_of(file, 0), 100, 1e-9);
    EXPECT_NEAR(intensity_of(file, 1).luminance(), 100, 1e-9);
    EXPECT_NEAR(flux_of(file, 2), 7, 1e-9);
    EXPECT_EQ(std::get<PointLight>(file.scene.lights[2].source).position, (Vec3{0, 0, 3}));
    EXPECT_EQ(std::get<PointLight>(file.scene.lights[3].source).position, (Vec3{1, 1, 1}));
}

TEST(SceneDefaults, TypesTakeTheirOwnKeysOnly) {
    const SceneFile file = read_scene_text("[defaults.lights]\naim = [1, 0, 0]\nradius = 0.1\n" + kLights +
                                           "[lights.c]\ntype = \"sphere\"\ncenter = [5, 0, 0]\nflux = 1");
    EXPECT_EQ(std::get<Sphere>(file.scene.objects.at(0).shape).radius, 0.1);
}

TEST(SceneDefaults, TheTypeToo) {
    const SceneFile file = read_scene_text(R"(
[defaults.materials]
type = "diffuse"
[defaults.lights]
type = "point"
flux = 5
[materials.wall]
reflectance = 0.5
[materials.floor]
type = "black"
[lights.a]
position = [0, 0, 1]
)");
    EXPECT_EQ(file.scene.materials[0].material.get_if<Diffuse>()->reflectance, Rgb::grey(0.5));
    EXPECT_TRUE(file.scene.materials[1].material.is<Black>());
    EXPECT_NEAR(flux_of(file, 0), 5, 1e-9);
}

TEST(SceneDefaults, OfSensors) {
    const SceneFile file = read_scene_text(R"(
[defaults.sensors]
normal = [0, 0, 1]
resolution = [8, 4]
[sensors.a]
type = "illuminance"
position = [0, 0, 1]
[sensors.wall]
type = "illuminance"
position = [0, 0, 1]
normal = [1, 0, 0]
[sensors.view]
type = "camera"
position = [0, 0, 1]
target = [1, 0, 1]
)");
    EXPECT_EQ(std::get<MeasuringPoint>(file.sensors.at(0).measurand(0)).normal, (Vec3{0, 0, 1}));
    EXPECT_EQ(std::get<MeasuringPoint>(file.sensors.at(1).measurand(0)).normal, (Vec3{1, 0, 0}));
    EXPECT_EQ(file.sensors.at(2).camera()->resolution, (std::array{8, 4}));
}

TEST(SceneDefaults, NotOfDaylight) {
    const std::string sky = "[lights.sky]\ntype = \"environment\"\nluminance = 100\n";
    const SceneFile file = read_scene_text("[defaults.lights]\ncct = 2700\nmaintenance = 0.5\n" + sky);
    const auto& light = std::get<EnvironmentLight>(file.scene.lights.at(0).source);
    EXPECT_EQ(light.luminance_cd_m2, Rgb::grey(100));
}

TEST(SceneDefaults, MayComeFromBesideTheFile) {
    const std::vector<std::string> overrides{"defaults.lights.flux = 3"};
    const std::string light = "[lights.a]\ntype = \"point\"\nposition = [0, 0, 1]\n";
    EXPECT_NEAR(flux_of(read_scene(light, "s.toml", "", overrides), 0), 3, 1e-9);
}

TEST(SceneDefaults, RefusesUnknownKeys) {
    EXPECT_REFUSAL("[defaults.lamps]\ncct = 4000",
                   "s.toml:1: defaults: unknown key \"lamps\". Allowed: materials, lights, sensors.");
    const std::string message = refusal("[defaults.lights]\ncctt = 4000\n" + kLights);
    EXPECT_TRUE(
        message.starts_with("s.toml:2: defaults.lights: unknown key \"cctt\". Did you mean \"cct\"? Allowed: "
                            "type, position, "))
        << message;
    EXPECT_TRUE(
        refusal("[defaults.lights]\nluminanz = 1").starts_with("s.toml:2: defaults.lights: unknown key"));
}

TEST(SceneDefaults, WrongValuesAreFoundWhereTheyStand) {
    EXPECT_REFUSAL("[defaults.lights]\ncct = 4\n" + kLights,
                   "s.toml:2: lights.a.cct: 4 is not allowed. Allowed: from 1000 to 25000 K.");
    EXPECT_REFUSAL(
        "[defaults.lights]\ntype = \"pont\"\n[lights.a]\nposition = [0, 0, 1]",
        "s.toml:2: lights.a.type: unknown type \"pont\". Did you mean \"point\"? Allowed: point, area, "
        "sphere, photometry, environment.");
}

TEST(SceneMaintenance, MultipliesTheFluxOfAllLamps) {
    const SceneFile file = read_scene_text(kLights + "[run]\nmaintenance = 0.8");
    EXPECT_NEAR(flux_of(file, 0), 80, 1e-9);
    EXPECT_NEAR(intensity_of(file, 1).luminance(), 80, 1e-9);
    EXPECT_EQ(file.scene.lights[0].maintenance, 0.8);
    EXPECT_EQ(scene::maintenance_factors(file.scene), (std::array{0.8, 0.8}));
    EXPECT_EQ(scene::maintenance_factors(read_scene_text(kLights).scene), std::nullopt);
}

TEST(SceneMaintenance, ALampMayHaveItsOwn) {
    const SceneFile file = read_scene_text(kLights + "maintenance = 0.67\n[run]\nmaintenance = 0.8");
    EXPECT_NEAR(flux_of(file, 0), 80, 1e-9);
    EXPECT_NEAR(intensity_of(file, 1).luminance(), 67, 1e-9);
    EXPECT_EQ(scene::maintenance_factors(file.scene), (std::array{0.67, 0.8}));
    const SceneFile one = read_scene_text(kLights + "maintenance = 0.67");
    EXPECT_EQ(scene::maintenance_factors(one.scene), (std::array{0.67, 1.0}));
}

TEST(SceneMaintenance, DaylightHasNone) {
    const std::string sky = "[lights.sky]\ntype = \"environment\"\nluminance = 100\n";
    const SceneFile file = read_scene_text(sky + "[run]\nmaintenance = 0.8");
    EXPECT_EQ(std::get<EnvironmentLight>(file.scene.lights.at(0).source).luminance_cd_m2, Rgb::grey(100));
    EXPECT_EQ(scene::maintenance_factors(file.scene), std::nullopt);
    EXPECT_TRUE(
        refusal(sky + "maintenance = 0.8").starts_with("s.toml:4: lights.sky: unknown key \"maintenance\""));
}

TEST(SceneMaintenance, IsAtMostOne) {
    EXPECT_REFUSAL(
        "[run]\nmaintenance = 80",
        "s.toml:2: run.maintenance: 80 is not allowed. Allowed: a factor above 0 (from 0.001 to 1).");
}

}  // namespace
}  // namespace stilb::io
