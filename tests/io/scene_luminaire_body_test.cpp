// Bodies of luminaires: geometry = "file.obj" of a photometry light.
#include <fmt/format.h>

#include <fstream>

#include "io/scene_text.h"
#include "materials/black.h"
#include "run/run.h"
#include "statistics/hypothesis.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

constexpr const char* kMaterials =
    "[materials.white]\ntype = \"diffuse\"\nreflectance = 0.8\n[materials.trim]\ntype = \"black\"\n";

/// A housing with its opening downwards: a box 0.6 m x 0.4 m around the origin, from 2 cm below the plane of
/// the opening to 10 cm above it. The lower face is of the material "trim".
std::string housing() {
    std::string text;
    for (const double z : {-0.02, 0.1}) {
        for (const auto& [x, y] : {std::pair{-0.3, -0.2}, {0.3, -0.2}, {0.3, 0.2}, {-0.3, 0.2}})
            text += fmt::format("v {} {} {}\n", x, y, z);
    }
    return text +
           "usemtl trim\nf 4 3 2 1\nusemtl white\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
}

class LuminaireBody : public testing::Test {
  protected:
    void SetUp() override {
        std::ofstream(directory_ / "housing.obj") << housing();
        const auto ies = [](const char* angles, const char* intensities, int count) {
            return fmt::format("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {} 1 1 2 0.3 0.5 0\n1 1 0\n{}\n0\n{}\n",
                               count, angles, intensities);
        };
        std::ofstream(directory_ / "down.ies") << ies("0 45 90", "200 160 0", 3);
        std::ofstream(directory_ / "both.ies") << ies("0 60 90 120 180", "200 100 0 100 150", 5);
    }

    static std::string light(const std::string& keys) {
        return std::string(kMaterials) + "[lights.a]\ntype = \"photometry\"\n" + keys;
    }
    SceneFile read(const std::string& keys) const { return read_scene_text(light(keys), directory_); }
    std::string refusal_of(const std::string& keys) const { return refusal(light(keys), directory_); }

    const TestFolder directory_;
};

const Object& object_named(const Scene& scene, std::string_view name) {
    const auto found = std::ranges::find(scene.objects, name, &Object::name);
    EXPECT_NE(found, scene.objects.end()) << name;
    return *found;
}

TEST_F(LuminaireBody, MovesAndTurnsWithItsLight) {
    const SceneFile file = read("file = \"down.ies\"\nposition = [1, 2, 3]\ngeometry = \"housing.obj\"");
    const Object& body = object_named(file.scene, "a (body)");
    const Bounds bounds = bounds_of(body.shape);
    EXPECT_LT(length(bounds.min - Vec3{0.7, 1.8, 2.98}), 1e-12);
    EXPECT_LT(length(bounds.max - Vec3{1.3, 2.2, 3.1}), 1e-12);
    EXPECT_EQ(file.scene.materials[index_of(body.materials.front())].name, "trim");
    EXPECT_EQ(file.scene.materials[index_of(body.materials.back())].name, "white");
    EXPECT_TRUE(file.warnings.empty()) << file.warnings[0].text;
    // Aimed along x and spun by a quarter turn: the body's x, C0, follows.
    const SceneFile aimed = read(
        "file = \"down.ies\"\nposition = [0, 0, 0]\naim = [1, 0, 0]\nspin = 90\ngeometry = \"housing.obj\"");
    const Bounds turned = bounds_of(object_named(aimed.scene, "a (body)").shape);
    EXPECT_NEAR(turned.max.x, 0.02, 1e-12);
    EXPECT_NEAR(turned.min.x, -0.1, 1e-12);
    const auto& luminaire = std::get<LuminousOpening>(aimed.scene.lights[0].source).luminaire;
    const Vec3 along_c0 = 0.3 * luminaire.c0;
    EXPECT_NEAR(turned.max.y, std::abs(along_c0.y) + 0.2 * std::abs(luminaire.c90.y), 1e-12);
}

TEST_F(LuminaireBody, IsRepeatedScaledAndOfOneMaterial) {
    const SceneFile file = read(
        "file = \"down.ies\"\npositions = [[0, 0, 3], [2, 0, 3]]\n"
        "geometry = { file = \"housing.obj\", material = \"white\", scale = 0.5 }");
    const Bounds second = bounds_of(object_named(file.scene, "a_2 (body)").shape);
    EXPECT_LT(length(second.max - Vec3{2.15, 0.1, 3.05}), 1e-12);
    EXPECT_EQ(object_named(file.scene, "a_1 (body)").materials.size(), 1u);
}

/// The whole flux arrives in the half space, with the intensity of the file: the same readings as without a
/// body, far away and near, below and (of a light to both sides) above.
TEST_F(LuminaireBody, HidesNothingOfItsOpening) {
    for (const char* file_name : {"down.ies", "both.ies"}) {
        const auto measure = [&](const std::string& geometry) {
            SceneFile file =
                read(fmt::format("file = \"{}\"\nposition = [0, 0, 0]\n{}", file_name, geometry));
            // So that only shadows could make a difference.
            for (NamedMaterial& material : file.scene.materials) material.material = Black{};
            // So that the lamp is not in the middle of the scene.
            file.scene.objects.push_back({"far", Sphere{{30, 30, 30}, 0.1}, {MaterialId{0}}});
            std::vector<MeasuringPoint> points;
            for (const double gamma_deg : {0.0, 30.0, 60.0, 80.0, 85.0, 120.0, 180.0}) {
                const double gamma = gamma_deg * kPi / 180;
                const Vec3 direction{std::sin(gamma) * 0.8, std::sin(gamma) * 0.6, -std::cos(gamma)};
                points.push_back({20 * direction, -direction});
            }
            RunOptions options;
            options.paths = 1 << 13;
            const Sensor sensor{"points", IlluminancePoints{points}};
            return run::measure(file.scene, {&sensor, 1}, options).sensors[0].readings;
        };
        const auto without = measure(""), with = measure("geometry = \"housing.obj\"");
        for (std::size_t j = 0; j < without.size(); ++j) {
            const double exact_lx = without[j].estimate.value;
            // The opening moves by 2 to 10 cm at 20 m.
            EXPECT_NEAR(with[j].estimate.value, exact_lx, 0.013 * exact_lx + 1e-9) << file_name << " " << j;
        }
    }
}

/// A scene of another size has the same light: the gap between a small body and its opening is small, too.
TEST_F(LuminaireBody, AndOpeningAreAsNearAsTheyAreLarge) {
    const double diagonal = length(Vec3{0.6, 0.4, 0.12});
    for (const double scale : {1., 0.1 / diagonal * 1.01, 0.1 / diagonal * 0.99, 0.01}) {
        const SceneFile file =
            read(fmt::format("file = \"down.ies\"\nopening = [{}, {}]\nposition = [0, 0, 0]\n"
                             "geometry = {{ file = \"housing.obj\", scale = {} }}",
                             0.3 * scale, 0.2 * scale, scale));
        const auto& light = std::get<LuminousOpening>(file.scene.lights[0].source);
        const Bounds opening = bounds_of(file.scene.object(light.object).shape);
        EXPECT_NEAR(-0.02 * scale - opening.min.z, std::min(1e-4, 1e-3 * diagonal * scale), 1e-9) << scale;
    }
}

TEST_F(LuminaireBody, ShadowsOthersAndIsSeen) {
    const std::string lamps =
        "file = \"down.ies\"\nposition = [0, 0, 2]\ngeometry = \"housing.obj\"\ndimming = 1e-9\n"
        "[lights.b]\ntype = \"point\"\nposition = [0, 0, 3]\nintensity = 100\n";
    const SceneFile file = read(lamps);
    RunOptions options;
    options.paths = 1 << 12;
    const std::vector<Sensor> sensors{
        {"below", IlluminancePoints{{{{0, 0, 0}, {0, 0, 1}}, {{2, 0, 0}, {0, 0, 1}}}}},
        {"seen", Luminance{{LineOfSight{{0, 0, 5}, {0, 0, -1}}}}}};
    const run::RunResult result = run::measure(file.scene, sensors, options);
    EXPECT_LT(result.sensors[0].readings[0].estimate.value, 1e-3);
    const double beside_lx = 100 * 3 / std::pow(13, 1.5);
    EXPECT_NEAR(result.sensors[0].readings[1].estimate.value, beside_lx, 1e-3 * beside_lx);
    const double top_cd_m2 = 0.8 / kPi * 100 / (0.9 * 0.9);
    EXPECT_NEAR(result.sensors[1].readings[0].estimate.value, top_cd_m2, 1e-3 * top_cd_m2);
}

TEST_F(LuminaireBody, RefusesWhatItCannotPlace) {
    const std::string at = "file = \"down.ies\"\nposition = [0, 0, 0]\n";
    const std::string flat =
        "a body needs a flat opening, which is moved out of it so that it hides none of its light. Allowed: "
        "opening = [length, width] or a diameter.";
    for (const char* opening : {"\"point\"", "[0.5, 0.3, 0.1]"}) {
        EXPECT_EQ(refusal_of(at + "opening = " + opening + "\ngeometry = \"housing.obj\""),
                  "s.toml:11: lights.a.geometry: " + flat);
    }
    std::ofstream(directory_ / "plastic.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wite\nf 1 2 3\n";
    EXPECT_EQ(
        refusal_of(at + "geometry = \"plastic.obj\""),
        "s.toml:10: lights.a.geometry: the scene has no material \"wite\", which the mesh file names. Did "
        "you "
        "mean \"white\"? Allowed: white, trim. Or give the body materials: geometry = { file = ..., material "
        "= ... }.");
    EXPECT_NE(
        refusal_of(at + "geometry = \"nothing.obj\"").find("s.toml:10: lights.a.geometry: there is no file"),
        std::string::npos);
    EXPECT_EQ(
        refusal_of(at + "geometry = { file = \"housing.obj\", materials = { trm = \"white\" } }"),
        "s.toml:10: lights.a.geometry.materials.trm: the mesh file has no material or group \"trm\". Did you "
        "mean \"trim\"? Allowed: trim, white, \"\".");
}

}  // namespace
}  // namespace stilb::io
