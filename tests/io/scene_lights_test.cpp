#include <cmath>
#include <fstream>
#include <optional>

#include "io/image/picture_file.h"
#include "io/scene_text.h"
#include "materials/black.h"
#include "scene/installed_power.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

/// Eight lines before the light's table.
constexpr const char* kPanel = R"([materials.m]
type = "black"
[objects.panel]
shape = "rectangle"
corner = [0, 0, 3]
edge_u = [0, 2, 0]
edge_v = [1, 0, 0]
material = "m"
)";

std::string light(const std::string& keys) { return kPanel + ("[lights.a]\n" + keys); }

double flux_lm(const SceneFile& file) { return flux_lm(file.scene, file.scene.lights.at(0)).luminance(); }

TEST(SceneLights, PointByFluxOrIntensity) {
    const SceneFile by_flux = read_scene_text(light("type = \"point\"\nposition = [1, 2, 3]\nflux = 100"));
    EXPECT_NEAR(flux_lm(by_flux), 100, 1e-9);
    const SceneFile by_intensity =
        read_scene_text(light("type = \"point\"\nposition = [1, 2, 3]\nintensity = 100"));
    const auto& point = std::get<PointLight>(by_intensity.scene.lights[0].source);
    EXPECT_NEAR(point.intensity_cd.luminance(), 100, 1e-9);
    EXPECT_EQ(point.position, (Vec3{1, 2, 3}));
}

TEST(SceneLights, AreaByFluxOrLuminance) {
    EXPECT_NEAR(flux_lm(read_scene_text(light("type = \"area\"\nobject = \"panel\"\nflux = 500"))), 500,
                1e-9);
    const SceneFile by_luminance =
        read_scene_text(light("type = \"area\"\nobject = \"panel\"\nluminance = 500"));
    EXPECT_NEAR(flux_lm(by_luminance), 500 * kPi * 2, 1e-9) << "on one side of 2 m2";
}

TEST(SceneLights, SphereAddsABlackObjectOfItsName) {
    const SceneFile file =
        read_scene_text(light("type = \"sphere\"\ncenter = [1, 1, 1]\nradius = 0.1\nluminance = 1000"));
    const Scene& scene = file.scene;
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[1].name, "a");
    EXPECT_EQ(std::get<Sphere>(scene.objects[1].shape).radius, 0.1);
    EXPECT_TRUE(scene.material(scene.objects[1].materials.at(0)).is<Black>());
    EXPECT_EQ(std::get<AreaLight>(scene.lights[0].source).object, ObjectId{1});
    EXPECT_NEAR(flux_lm(file), 1000 * kPi * 4 * kPi * 0.01, 1e-9);
}

TEST(SceneLights, SpheresShareTheirMaterial) {
    const std::string sphere = "type = \"sphere\"\ncenter = [1, 1, 1]\nradius = 0.1\nflux = 10\n";
    const Scene scene = read_scene_text(light(sphere) + "[lights.b]\n" + sphere).scene;
    EXPECT_EQ(scene.materials.size(), 2u);
    EXPECT_EQ(scene.objects[1].materials, scene.objects[2].materials);
}

/// A folder with a panorama of 8 x 4 pixels, whose left half is as bright as said and its right half black.
class PanoramaFolder {
  public:
    explicit PanoramaFolder(const std::optional<Camera>& camera = std::nullopt) {
        Picture picture{8, 4, {}, {}, {}, {}, camera, {}};
        for (int i = 0; i < 32; ++i) {
            const float value = i % 8 < 4 ? 64.0F : 0.0F;
            picture.rgb_cd_m2.push_back({value, value, value});
        }
        write_picture(picture, folder_ / "sky.exr");
    }
    const std::filesystem::path& path() const { return folder_; }

  private:
    const TestFolder folder_;
};

TEST(SceneLights, EnvironmentOfOneLuminance) {
    const SceneFile file =
        read_scene_text(light("type = \"environment\"\nluminance = 500\ncolor = [2, 1, 1]"));
    const auto& environment = std::get<EnvironmentLight>(file.scene.lights[0].source);
    EXPECT_NEAR(environment.luminance_cd_m2.luminance(), 500, 1e-9);
    EXPECT_NEAR(environment.luminance_cd_m2[0] / environment.luminance_cd_m2[1], 2, 1e-12);
    EXPECT_FALSE(environment.panorama);
}

TEST(SceneLights, EnvironmentByAPanorama) {
    const PanoramaFolder folder;
    const auto read = [&](const std::string& keys) {
        return read_scene_text(light("type = \"environment\"\nfile = \"sky.exr\"\n" + keys), folder.path());
    };
    const SceneFile file = read("dimming = 0.5");
    EXPECT_EQ(file.sources, std::vector{folder.path() / "sky.exr"});
    const auto luminance = [](const SceneFile& of, const Vec3& direction) {
        const auto& environment = std::get<EnvironmentLight>(of.scene.lights[0].source);
        return environment.panorama->luminance_cd_m2(environment.axes.to_local(direction)).luminance();
    };
    // The middle looks along +x, the left half of the picture towards +y.
    EXPECT_NEAR(luminance(file, {0.1, 0.9, 0.1}), 32, 1e-6);
    EXPECT_EQ(luminance(file, {0.1, -0.9, 0.1}), 0);
    const SceneFile turned = read("rotation = 180");
    EXPECT_EQ(luminance(turned, {0.1, 0.9, 0.1}), 0);
    EXPECT_NEAR(luminance(turned, {0.1, -0.9, 0.1}), 64, 1e-6);
    EXPECT_NEAR(luminance(read("up = [0, 0, -2]"), {0.1, -0.9, 0.1}), 64, 1e-6) << "a half turn about x";
}

TEST(SceneLights, RefusesWrongEnvironments) {
    const std::string constant = "type = \"environment\"\nluminance = 5\n";
    EXPECT_REFUSAL(
        light(constant + "[lights.b]\n" + constant),
        "s.toml:12: lights.b: surrounds the scene, as light \"a\" does. Allowed: one environment.");
    EXPECT_REFUSAL(light("type = \"environment\""),
                   "s.toml:9: lights.a: key \"luminance\" or \"file\" is missing for type \"environment\".");
    EXPECT_REFUSAL(
        light(constant + "dimming = 2"),
        "s.toml:12: lights.a.dimming: contradicts \"luminance\", which is given too. Allowed: one of "
        "the two.");
    EXPECT_REFUSAL(
        light("type = \"environment\"\nfile = \"x.hdr\"\ncct = 5000"),
        "s.toml:12: lights.a.cct: contradicts \"file\", which is given too. Allowed: one of the two.");
    Camera perspective;
    perspective.resolution = {8, 4};
    const PanoramaFolder view(perspective);
    EXPECT_EQ(refusal(light("type = \"environment\"\nfile = \"sky.exr\""), view.path()),
              "s.toml:11: lights.a.file: the picture does not cover all directions. Needed: projection "
              "= \"panorama\", fov = 360.");
    std::ofstream(view.path() / "no.hdr") << "no picture";
    EXPECT_THROW(read_scene_text(light("type = \"environment\"\nfile = \"no.hdr\""), view.path()),
                 InputError);
}

TEST(SceneLights, ColourKeepsTheFlux) {
    const std::string point = "type = \"point\"\nposition = [0, 0, 0]\nflux = 100\n";
    for (const std::string colour :
         {"color = [1, 0.5, 0.1]", "color = [100, 50, 10]", "cct = 3000", "color = 7"}) {
        EXPECT_NEAR(flux_lm(read_scene_text(light(point + colour))), 100, 1e-9) << colour;
    }
    const SceneFile file = read_scene_text(light(point + "color = [2, 1, 0]"));
    const Rgb intensity = std::get<PointLight>(file.scene.lights[0].source).intensity_cd;
    EXPECT_NEAR(intensity[0] / intensity[1], 2, 1e-12);
    EXPECT_EQ(intensity[2], 0);
}

TEST(SceneLights, RefusesWrongColours) {
    const std::string point = "type = \"point\"\nposition = [0, 0, 0]\nflux = 100\n";
    EXPECT_REFUSAL(light(point + "cct = 500"),
                   "s.toml:13: lights.a.cct: 500 is not allowed. Allowed: from 1000 to 25000 K.");
    EXPECT_REFUSAL(
        light(point + "color = [0, 0, 0]"),
        "s.toml:13: lights.a.color: black has no colour. Allowed: [r, g, b] with a channel above 0.");
    EXPECT_REFUSAL(light(point + "color = [1, -1, 0]"),
                   "s.toml:13: lights.a.color[1]: -1 is not allowed. Allowed: from 0 to 1e6.");
    EXPECT_REFUSAL(
        light(point + "cct = 3000\ncolor = 1"),
        "s.toml:14: lights.a.color: contradicts \"cct\", which is given too. Allowed: one of the two.");
}

TEST(SceneLights, RefusesUnknownTypesAndKeys) {
    EXPECT_REFUSAL(
        light("type = \"pont\""),
        "s.toml:10: lights.a.type: unknown type \"pont\". Did you mean \"point\"? Allowed: point, area, "
        "sphere, photometry, environment.");
    EXPECT_REFUSAL(
        light("type = \"point\"\nflus = 1"),
        "s.toml:11: lights.a: unknown key \"flus\" for type \"point\". Did you mean \"flux\"? Allowed: "
        "type, position, positions, array, flux, intensity, cct, color, group, on, maintenance, power.");
}

TEST(SceneLights, RefusesWrongQuantities) {
    const std::string point = "type = \"point\"\nposition = [0, 0, 0]\n";
    const std::string allowed = " is not allowed. Allowed: a number above 0 (from 1e-15 to 1e15).";
    EXPECT_REFUSAL(light(point + "flux = -1"), "s.toml:12: lights.a.flux: -1" + allowed);
    EXPECT_REFUSAL(light(point + "flux = 0"), "s.toml:12: lights.a.flux: 0" + allowed);
    EXPECT_REFUSAL(light(point + "intensity = inf"), "s.toml:12: lights.a.intensity: inf" + allowed);
    EXPECT_REFUSAL(light("type = \"area\"\nobject = \"panel\"\nluminance = -5"),
                   "s.toml:12: lights.a.luminance: -5" + allowed);
    EXPECT_REFUSAL(light(point),
                   "s.toml:9: lights.a: key \"flux\" or \"intensity\" is missing for type \"point\".");
    EXPECT_REFUSAL(
        light("type = \"area\"\nobject = \"panel\"\nflux = 1\nluminance = 1"),
        "s.toml:13: lights.a.luminance: contradicts \"flux\", which is given too. Allowed: one of the two.");
    EXPECT_REFUSAL(light("type = \"area\"\nobject = \"panel\""),
                   "s.toml:9: lights.a: key \"flux\" or \"luminance\" is missing for type \"area\".");
    EXPECT_REFUSAL(
        light("type = \"point\"\nposition = [0, nan, 0]\nflux = 1"),
        "s.toml:11: lights.a.position[1]: nan is not allowed. Allowed: a number from -1e9 to 1e9.");
}

TEST(SceneLights, RefusesAreaLightsWithoutTheirObject) {
    EXPECT_REFUSAL(
        light("type = \"area\"\nobject = \"pannel\"\nflux = 1"),
        "s.toml:11: lights.a.object: unknown object \"pannel\". Did you mean \"panel\"? Allowed: panel.");
    EXPECT_REFUSAL("[lights.a]\ntype = \"area\"\nobject = \"panel\"\nflux = 1",
                   "s.toml:3: lights.a.object: unknown object \"panel\". No name is allowed here.");
}

TEST(SceneLights, RefusesTwoAreaLightsOnOneObject) {
    const std::string area = "type = \"area\"\nobject = \"panel\"\nflux = 1\n";
    EXPECT_REFUSAL(light(area + "[lights.b]\n" + area),
                   "s.toml:15: lights.b.object: \"panel\" is already the emitter of the light \"a\". "
                   "Allowed: one area light per object.");
}

TEST(SceneLights, RefusesFluxFromNoArea) {
    std::string scene = light("type = \"area\"\nobject = \"panel\"\nflux = 1");
    scene.replace(scene.find("[0, 2, 0]"), 9, "[0, 1e-99, 0]");
    scene.replace(scene.find("[1, 0, 0]"), 9, "[1e-99, 0, 0]");
    scene.insert(scene.find("material = "), "transform = [1e-90,0,0,0, 0,1e-90,0,0, 0,0,1e-90,0, 0,0,0,1]\n");
    EXPECT_REFUSAL(scene, "s.toml:13: lights.a.flux: the object has no area that could emit a flux.");
}

TEST(SceneLights, RefusesASphereWithTheNameOfAnObject) {
    EXPECT_REFUSAL(
        kPanel + std::string("[lights.panel]\ntype = \"sphere\"\ncenter = [1, 1, 1]\nradius = 0.1\nflux = 9"),
        "s.toml:9: lights.panel: the light adds an object \"panel\", but the scene already has an object of "
        "this "
        "name. Allowed: another name of the light or of the object.");
    EXPECT_REFUSAL(
        light("type = \"sphere\"\ncenter = [1, 1, 1]\nradius = 0\nflux = 9"),
        "s.toml:12: lights.a.radius: 0 is not allowed. Allowed: a length above 0 (from 1e-9 to 1e9 m).");
}

TEST(SceneLights, RefusesPhotometryWithoutItsFile) {
    EXPECT_REFUSAL(
        light("type = \"photometry\"\nposition = [0, 0, 0]\nfile = \"spot.ies\""),
        "s.toml:12: lights.a.file: there is no file \"spot.ies\". Paths are relative to the scene file; "
        "looked for no-such-directory/spot.ies.");
    EXPECT_REFUSAL(light("type = \"photometry\"\nposition = [0, 0, 0]\naim = [0, 0, 0]\nfile = \"spot.ies\""),
                   "s.toml:12: lights.a.aim: [0, 0, 0] has no direction. Allowed: any other vector.");
}

/// A file of 100 cd over the lower half space.
class ScenePhotometry : public testing::Test {
  protected:
    void SetUp() override {
        std::ofstream(directory_ / "half.ies") << ies(1000);
        std::ofstream(directory_ / "too_much.ies") << ies(100);
        std::ofstream(directory_ / "broken.ies") << "IESNA:LM-63-2002\nTILT=NONE\n1 1000";
    }

    static std::string ies(int lamp_lm) {
        return "IESNA:LM-63-2002\n[LUMINAIRE] half\nTILT=NONE\n1 " + std::to_string(lamp_lm) +
               " 1 3 1 1 2 0 0 0\n1 1 0\n0 45 90\n0\n100 100 100\n";
    }
    SceneFile read(const std::string& keys) const {
        return read_scene_text("[lights.a]\ntype = \"photometry\"\nposition = [1, 2, 3]\n" + keys,
                               directory_);
    }
    static Luminaire light_of(const SceneFile& file) {
        return std::get<Luminaire>(file.scene.lights.at(0).source);
    }

    static constexpr double kFlux = 2 * kPi * 100;
    const TestFolder directory_;
};

TEST_F(ScenePhotometry, HangsStraightDownWithTheFilesFlux) {
    const SceneFile file = read("file = \"half.ies\"");
    EXPECT_NEAR(flux_lm(file), kFlux, 1e-6 * kFlux);
    EXPECT_EQ(file.scene.solids.at(0).luminaire, "half");
    EXPECT_EQ(file.scene.solids[0].file, (directory_ / "half.ies").string());
    EXPECT_EQ(light_of(file).position, (Vec3{1, 2, 3}));
    EXPECT_EQ(light_of(file).nadir, (Vec3{0, 0, -1}));
    EXPECT_LT(length(light_of(file).c0 - Vec3{1, 0, 0}), 1e-12);
    EXPECT_LT(length(light_of(file).c90 - Vec3{0, 1, 0}), 1e-12);
    EXPECT_TRUE(file.warnings.empty()) << file.warnings[0].text;
}

TEST_F(ScenePhotometry, AimSpinDimmingAndFlux) {
    const SceneFile dimmed =
        read("file = \"half.ies\"\naim = [0, 3, 0]\nspin = 90\ndimming = 0.5\ncct = 3000");
    EXPECT_NEAR(flux_lm(dimmed), kFlux / 2, 1e-6 * kFlux);
    EXPECT_LT(length(light_of(dimmed).nadir - Vec3{0, 1, 0}), 1e-12);
    EXPECT_LT(length(light_of(dimmed).c0 - Vec3{0, 0, 1}), 1e-12);
    EXPECT_NEAR(flux_lm(read("file = \"half.ies\"\nflux = 50")), 50, 1e-9);
    EXPECT_NEAR(flux_lm(read("file = \"half.ies\"\nflux = 50\ndimming = 0.2")), 10, 1e-9);
}

TEST_F(ScenePhotometry, ShinesFromAnOpening) {
    const auto shape_of = [&](const std::string& opening) {
        const SceneFile file = read("file = \"half.ies\"\nopening = " + opening);
        const auto& light = std::get<LuminousOpening>(file.scene.lights.at(0).source);
        EXPECT_EQ(file.scene.object(light.object).name, "a (opening)");
        EXPECT_NEAR(flux_lm(file), kFlux, 1e-3 * kFlux);
        return file.scene.object(light.object).shape;
    };
    const Shape disk = shape_of("0.2");
    EXPECT_DOUBLE_EQ(std::get<Disk>(disk).radius, 0.1);
    EXPECT_EQ(std::get<Disk>(disk).center, (Vec3{1, 2, 3}));
    EXPECT_EQ(std::get<Disk>(disk).normal, (Vec3{0, 0, -1}));
    // The length lies along C90, which is y.
    const Bounds panel = bounds_of(shape_of("[0.6, 0.3]"));
    EXPECT_LT(length(panel.max - panel.min - Vec3{0.3, 0.6, 0}), 1e-12);
    const Bounds box = bounds_of(shape_of("[0.6, 0.3, 0.1]"));
    EXPECT_LT(length(box.min - Vec3{0.85, 1.7, 2.95}), 1e-12);
    EXPECT_TRUE(std::holds_alternative<Luminaire>(
        read("file = \"half.ies\"\nopening = \"point\"").scene.lights.at(0).source));
}

TEST_F(ScenePhotometry, TakesTheOpeningOfItsFile) {
    std::ofstream(directory_ / "panel.ies")
        << "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0.6 0.3 0\n1 1 0\n0 45 90\n0\n100 100 100\n";
    const SceneFile file = read("file = \"panel.ies\"");
    const auto& light = std::get<LuminousOpening>(file.scene.lights.at(0).source);
    EXPECT_NEAR(area_m2(file.scene.object(light.object).shape), 0.18, 1e-12);
    EXPECT_TRUE(std::holds_alternative<Luminaire>(
        read("file = \"panel.ies\"\nopening = \"point\"").scene.lights.at(0).source));
}

TEST_F(ScenePhotometry, HasThePowerOfItsFileOrItsOwn) {
    std::ofstream(directory_ / "panel.ies")
        << "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0.6 0.3 0\n1 1 31.5\n0 45 90\n0\n100 100 100\n";
    const auto power_w = [&](const std::string& keys) { return read(keys).scene.lights.at(0).power_w; };
    EXPECT_EQ(power_w("file = \"panel.ies\""), 31.5);
    EXPECT_EQ(power_w("file = \"panel.ies\"\nopening = \"point\""), 31.5);
    EXPECT_EQ(power_w("file = \"panel.ies\"\ndimming = 0.5\nmaintenance = 0.8"), 31.5) << "installed";
    EXPECT_EQ(power_w("file = \"panel.ies\"\nflux = 500"), std::nullopt) << "that of another flux";
    EXPECT_EQ(power_w("file = \"panel.ies\"\nflux = 500\npower = 28"), 28);
    EXPECT_EQ(power_w("file = \"half.ies\""), std::nullopt) << "its watts are 0";
}

TEST(SceneLights, PowerIsThatOfEachCopyAndMayBeUnknown) {
    const std::string bulb = "type = \"point\"\nflux = 100\n";
    const SceneFile file = read_scene_text(
        light(bulb + "positions = [[0, 0, 1], [1, 0, 1], [2, 0, 1]]\npower = 8\n") + "[lights.b]\n" + bulb +
        "position = [0, 1, 1]\n" + "[lights.sky]\ntype = \"environment\"\nluminance = 10\n");
    const scene::InstalledPower power = scene::installed_power(file.scene);
    EXPECT_EQ(power.power_w, 24);
    EXPECT_EQ(power.unknown, std::vector<std::string>{"b"}) << "daylight takes no power";
    EXPECT_EQ(scene::installed_power(read_scene_text(light(bulb + "position = [0, 1, 1]\n")).scene).power_w,
              std::nullopt);
    EXPECT_REFUSAL(light(bulb + "position = [0, 1, 1]\npower = 0"),
                   "s.toml:13: lights.a.power: 0 is not allowed. Allowed: a power from 1e-6 to 1e9 W.");
}

TEST_F(ScenePhotometry, RefusesWhatIsNoOpening) {
    const std::string message = refusal(
        "[lights.a]\ntype = \"photometry\"\nposition = [1, 2, 3]\nfile = \"half.ies\"\nopening = \"round\"",
        directory_);
    EXPECT_EQ(message,
              "s.toml:5: lights.a.opening: \"round\" is no opening. Allowed: \"point\", a diameter, [length, "
              "width] or [length, width, height] in metres.");
}

TEST_F(ScenePhotometry, LightsWithTheSameFileShareItsSolid) {
    const std::string second = "\n[lights.b]\ntype = \"photometry\"\nposition = [0, 0, 0]\nfile = ";
    EXPECT_EQ(read("file = \"half.ies\"" + second + "\"./half.ies\"").scene.solids.size(), 1u);
    EXPECT_EQ(read("file = \"half.ies\"" + second + "\"too_much.ies\"").scene.solids.size(), 2u);
}

TEST_F(ScenePhotometry, WarnsOfMoreFluxThanTheLampsHave) {
    const SceneFile file = read("file = \"too_much.ies\"");
    ASSERT_EQ(file.warnings.size(), 1u);
    EXPECT_TRUE(file.warnings[0].text.starts_with("s.toml:4: lights.a.file: ")) << file.warnings[0].text;
}

TEST_F(ScenePhotometry, RefusesABrokenFile) {
    const std::string message =
        refusal("[lights.a]\ntype = \"photometry\"\nposition = [1, 2, 3]\nfile = \"broken.ies\"", directory_);
    EXPECT_TRUE(message.starts_with((directory_ / "broken.ies").string() + ":3: ")) << message;
}

/// Groups are names; nothing else about a light depends on them.
TEST(SceneLights, GroupsAreNamed) {
    const std::string point = "type = \"point\"\nposition = [1, 1, 1]\nflux = 1\n";
    EXPECT_EQ(read_scene_text(light(point + "group = \"desk\"")).scene.lights.back().group, "desk");
    EXPECT_EQ(read_scene_text(light(point)).scene.lights.back().group, "");
    EXPECT_EQ(refusal(light(point + "group = \"\"")),
              "s.toml:13: lights.a.group: the name is empty. Allowed: a text with at least one character.");
}

TEST(SceneLights, ThatAreOffGiveNoLightButStay) {
    const std::string sphere = "type = \"sphere\"\ncenter = [1, 1, 1]\nradius = 0.1\nflux = 10\n";
    const SceneFile off = read_scene_text(light(sphere + "power = 5\non = false\n"));
    EXPECT_TRUE(off.scene.lights.empty());
    EXPECT_EQ(off.scene.objects.size(), 2u);
    EXPECT_FALSE(scene::installed_power(off.scene).power_w);
    EXPECT_EQ(read_scene_text(light(sphere + "on = true\n")).scene.lights.size(), 1u);
    const std::string sky = "[lights.sky]\ntype = \"environment\"\nluminance = 5\non = ";
    EXPECT_EQ(read_scene_text(light(sphere) + sky + "true").scene.lights.size(), 2u);
    EXPECT_EQ(read_scene_text(light(sphere) + sky + "false").scene.lights.size(), 1u);
    // The object of a lamp that is off may carry another one.
    const std::string area = "type = \"area\"\nobject = \"panel\"\nflux = 10\n";
    EXPECT_EQ(read_scene_text(light(area + "on = false\n[lights.b]\n" + area)).scene.lights.at(0).name, "b");
}

}  // namespace
}  // namespace stilb::io
