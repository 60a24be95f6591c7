#include <algorithm>

#include "io/scene_text.h"
#include "materials/mirror.h"
#include "materials/plastic.h"
#include "materials/rough_conductor.h"
#include "materials/translucent.h"
#include "materials/ward.h"

namespace stilb::io {
namespace {

std::string material(const std::string& keys) { return "[materials.m]\n" + keys; }

TEST(SceneMaterials, SuggestsTheNearestKey) {
    EXPECT_REFUSAL(
        material("type = \"phong\"\ndiffuse = 0.3\nexponnent = 60"),
        "s.toml:4: materials.m: unknown key \"exponnent\" for type \"phong\". Did you mean \"exponent\"? "
        "Allowed: type, diffuse, specular, exponent, back.");
    EXPECT_REFUSAL(
        material("type = \"black\"\nreflectance = 0"),
        "s.toml:3: materials.m: unknown key \"reflectance\" for type \"black\". Allowed: type, back.");
}

TEST(SceneMaterials, RefusesUnknownTypes) {
    EXPECT_REFUSAL(
        material("type = \"difuse\""),
        "s.toml:2: materials.m.type: unknown type \"difuse\". Did you mean \"diffuse\"? Allowed: diffuse, "
        "phong, rough, ward, plastic, mirror, glass, pane, glazing, translucent, fabric, frosted, black.");
}

TEST(SceneMaterials, RefusesMissingKeys) {
    EXPECT_REFUSAL("\n[materials.m]\nreflectance = 1",
                   "s.toml:2: materials.m: key \"type\" is missing. Allowed: diffuse, phong, rough, ward, "
                   "plastic, mirror, glass, pane, glazing, translucent, fabric, frosted, black.");
    EXPECT_REFUSAL(material("type = \"diffuse\""),
                   "s.toml:1: materials.m: key \"reflectance\" is missing for type \"diffuse\".");
}

TEST(SceneMaterials, RefusesWrongTypesOfValues) {
    EXPECT_REFUSAL(
        material("type = 3"),
        "s.toml:2: materials.m.type: found the number 3 where a text in quotation marks is needed.");
    EXPECT_REFUSAL(
        material("type = \"diffuse\"\nreflectance = \"0.5\""),
        "s.toml:3: materials.m.reflectance: found the text \"0.5\" where a number or a colour [r, g, b] is "
        "needed.");
    EXPECT_REFUSAL(
        material("type = \"diffuse\"\nreflectance = [0.5, 0.5]"),
        "s.toml:3: materials.m.reflectance: found an array of 2 where a number or a colour [r, g, b] is "
        "needed.");
    EXPECT_REFUSAL(material("type = \"diffuse\"\nreflectance = [0.5,\n true, 0.5]"),
                   "s.toml:4: materials.m.reflectance[1]: found true where a number is needed.");
}

TEST(SceneMaterials, RefusesReflectancesOutOfRange) {
    const std::string allowed =
        " is not allowed. Allowed: from 0 to 1 (no surface reflects more light than it receives).";
    const std::string diffuse = "type = \"diffuse\"\nreflectance = ";
    EXPECT_REFUSAL(material(diffuse + "1.2"), "s.toml:3: materials.m.reflectance: 1.2" + allowed);
    EXPECT_REFUSAL(material(diffuse + "-0.1"), "s.toml:3: materials.m.reflectance: -0.1" + allowed);
    EXPECT_REFUSAL(material(diffuse + "[0, 0, 1.5]"), "s.toml:3: materials.m.reflectance[2]: 1.5" + allowed);
    EXPECT_REFUSAL(material(diffuse + "nan"), "s.toml:3: materials.m.reflectance: nan" + allowed);
    EXPECT_REFUSAL(material(diffuse + "inf"), "s.toml:3: materials.m.reflectance: inf" + allowed);
    EXPECT_REFUSAL(material("type = \"mirror\"\nreflectance = 2"),
                   "s.toml:3: materials.m.reflectance: 2" + allowed);
}

TEST(SceneMaterials, RefusesPhongThatGainsEnergy) {
    EXPECT_REFUSAL(
        material("type = \"phong\"\ndiffuse = [0.1, 0.6, 0.1]\nspecular = 0.5\nexponent = 10"),
        "s.toml:1: materials.m: diffuse + specular is 1.1: no surface reflects more light than it receives. "
        "Allowed: at most 1 in each channel.");
    EXPECT_NO_THROW(
        read_scene_text(material("type = \"phong\"\ndiffuse = 0.7\nspecular = 0.3\nexponent = 10")));
    const std::string phong = "type = \"phong\"\ndiffuse = 0.7\nspecular = 0.3\nexponent = ";
    const std::string allowed = " is not allowed. Allowed: from 0 to 1e6.";
    EXPECT_REFUSAL(material(phong + "-1"), "s.toml:5: materials.m.exponent: -1" + allowed);
    EXPECT_REFUSAL(material(phong + "2e6"), "s.toml:5: materials.m.exponent: 2000000" + allowed);
}

TEST(SceneMaterials, ReadsRough) {
    const std::string rough = "type = \"rough\"\nreflectance = [0.9, 0.6, 0.3]\n";
    const Material read = read_scene_text(material(rough + "roughness = 0.25")).scene.materials[0].material;
    EXPECT_EQ(read.get_if<RoughConductor>()->parameters().reflectance, (Rgb{{0.9, 0.6, 0.3}}));
    EXPECT_EQ(read.get_if<RoughConductor>()->parameters().roughness, 0.25);
    const std::string allowed = " is not allowed. Allowed: from 0.001 to 1 (a mirror has type \"mirror\").";
    EXPECT_REFUSAL(material(rough + "roughness = 0"), "s.toml:4: materials.m.roughness: 0" + allowed);
    EXPECT_REFUSAL(material(rough + "roughness = 1.5"), "s.toml:4: materials.m.roughness: 1.5" + allowed);
    EXPECT_REFUSAL(material(rough + "roughnes = 0.3"),
                   "s.toml:4: materials.m: unknown key \"roughnes\" for type \"rough\". Did you mean "
                   "\"roughness\"? Allowed: type, reflectance, roughness, back.");
    EXPECT_REFUSAL(material(rough),
                   "s.toml:1: materials.m: key \"roughness\" is missing for type \"rough\".");
    EXPECT_REFUSAL(material("type = \"rough\"\nreflectance = 1.2\nroughness = 0.3"),
                   "s.toml:3: materials.m.reflectance: 1.2 is not allowed. Allowed: from 0 to 1 (no surface "
                   "reflects more light than it receives).");
}

TEST(SceneMaterials, ReadsWard) {
    const std::string ward =
        "type = \"ward\"\ndiffuse = 0.3\nspecular = [0.1, 0.2, 0.3]\nroughness = [0.05, 0.2]\n";
    const Material read = read_scene_text(material(ward + "rotation = -30")).scene.materials[0].material;
    EXPECT_EQ(read.get_if<Ward>()->parameters().diffuse, Rgb::grey(0.3));
    EXPECT_EQ(read.get_if<Ward>()->parameters().specular, (Rgb{{0.1, 0.2, 0.3}}));
    EXPECT_EQ(read.get_if<Ward>()->parameters().roughness[0], 0.05);
    EXPECT_EQ(read.get_if<Ward>()->parameters().roughness[1], 0.2);
    EXPECT_EQ(read.get_if<Ward>()->parameters().rotation_deg, -30);
    const Material straight = read_scene_text(material(ward)).scene.materials[0].material;
    EXPECT_EQ(straight.get_if<Ward>()->parameters().rotation_deg, 0);
    const std::string start = "type = \"ward\"\ndiffuse = 0.3\nspecular = ";
    EXPECT_REFUSAL(
        material(start + "0.2\nroughness = [0.05, 2]"),
        "s.toml:5: materials.m.roughness[1]: 2 is not allowed. Allowed: from 0.001 to 1 (a mirror has "
        "type \"mirror\").");
    EXPECT_REFUSAL(
        material(start + "0.2\nroughness = 0.1"),
        "s.toml:5: materials.m.roughness: found the number 0.1 where an array of 2 numbers is needed.");
    EXPECT_REFUSAL(material(start + "0.8\nroughness = [0.1, 0.1]"),
                   "s.toml:1: materials.m: diffuse + specular is 1.1: no surface reflects more light than it "
                   "receives. Allowed: at most 1 in each channel.");
    EXPECT_REFUSAL(
        material(ward + "rotatoin = 3"),
        "s.toml:6: materials.m: unknown key \"rotatoin\" for type \"ward\". Did you mean \"rotation\"? "
        "Allowed: type, diffuse, specular, roughness, rotation, back.");
}

TEST(SceneMaterials, ReadsPlastic) {
    const std::string plastic = "type = \"plastic\"\ndiffuse = [0.5, 0.4, 0.3]\n";
    const Material read =
        read_scene_text(material(plastic + "ior = 1.5\nroughness = 0.1")).scene.materials[0].material;
    EXPECT_EQ(read.get_if<Plastic>()->parameters().diffuse, (Rgb{{0.5, 0.4, 0.3}}));
    EXPECT_EQ(read.get_if<Plastic>()->parameters().ior, 1.5);
    EXPECT_EQ(read.get_if<Plastic>()->parameters().roughness, 0.1);
    EXPECT_REFUSAL(material(plastic + "ior = 0.9\nroughness = 0.1"),
                   "s.toml:4: materials.m.ior: 0.9 is not allowed. Allowed: from 1 to 4 (1.5 is common).");
    EXPECT_REFUSAL(
        material(plastic + "ior = 1.5\nroughness = 0"),
        "s.toml:5: materials.m.roughness: 0 is not allowed. Allowed: from 0.001 to 1 (a mirror has type "
        "\"mirror\").");
    EXPECT_REFUSAL(material(plastic + "roughness = 0.1"),
                   "s.toml:1: materials.m: key \"ior\" is missing for type \"plastic\".");
}

constexpr const char* kSheet = "type = \"translucent\"\nreflectance = 0.3\ntransmittance = 0.4\n";

TEST(SceneMaterials, FabricsTransmitWhatTheirHolesDoAtLeast) {
    const std::string fabric = "type = \"fabric\"\nreflectance = 0.4\n";
    EXPECT_REFUSAL(
        material(fabric + "openness = 0.05\ntransmittance = [0.1, 0.04, 0.1]"),
        "s.toml:1: materials.m: its openness exceeds its transmittance, which includes the light that passes "
        "through the holes.");
    EXPECT_REFUSAL(
        material(fabric + "openness = 0.05\ntransmittance = 0.7"),
        "s.toml:1: materials.m: reflectance + transmittance is 1.1: no surface reflects more light than it "
        "receives. Allowed: at most 1 in each channel.");
    const SceneFile file = read_scene_text("[materials.m]\n" + fabric +
                                           "openness = 0.05\ntransmittance = 0.05\n"
                                           "back = { reflectance = 0.1 }\n");
    EXPECT_EQ(file.scene.materials.size(), 2u);
}

TEST(SceneMaterials, BacksAreOtherMaterialsOrTheSameWithOtherValues) {
    const SceneFile file = read_scene_text(
        "[materials.wall]\ntype = \"diffuse\"\nreflectance = 0.2\nback = { type = \"mirror\", reflectance = "
        "0.9 }\n"
        "[materials.sheet]\n" +
        std::string(kSheet) +
        "back = { reflectance = [0.1, 0.2, 0.3] }\n"
        "[objects.wall]\nshape = \"rectangle\"\ncorner = [0, 0, 0]\nedge_u = [1, 0, 0]\nedge_v = [0, 1, 0]\n"
        "material = \"wall\"\n");
    const auto& materials = file.scene.materials;
    ASSERT_EQ(materials.size(), 4u);
    EXPECT_EQ(index_of(*materials[0].back), 2u);
    EXPECT_EQ(materials[2].name, "wall (back)");
    EXPECT_TRUE(materials[2].material.is<materials::Mirror>());
    EXPECT_EQ(index_of(*materials[1].back), 3u);
    const auto& back = materials[3].material.get_if<materials::Translucent>()->parameters();
    EXPECT_EQ(back.reflectance, (Rgb{{0.1, 0.2, 0.3}}));
    EXPECT_EQ(back.transmittance, Rgb::grey(0.4));
    ASSERT_EQ(std::ranges::count_if(file.warnings,
                                    [](const Warning& warning) {
                                        return warning.text.find("no object has this material") !=
                                               std::string::npos;
                                    }),
              1)
        << "the sheet, and its back not once more";
}

TEST(SceneMaterials, RefusesBacksThatCannotBe) {
    EXPECT_REFUSAL(material(std::string(kSheet) + "back = { transmittance = 0.3 }"),
                   "s.toml:5: materials.m.back: both sides transmit the same share of the light: only the "
                   "reflectance may differ.");
    EXPECT_REFUSAL(
        material(std::string(kSheet) + "back = { type = \"black\" }"),
        "s.toml:5: materials.m.back: \"translucent\" and \"black\" cannot be the sides of one surface: of "
        "the materials that let light through, translucent ones and fabrics have a back, of the same type.");
    EXPECT_REFUSAL(
        material("type = \"glass\"\nior = 1.5\nback = { ior = 1.4 }"),
        "s.toml:4: materials.m.back: \"glass\" and \"glass\" cannot be the sides of one surface: of the "
        "materials that let light through, translucent ones and fabrics have a back, of the same type.");
    EXPECT_REFUSAL(
        material("type = \"diffuse\"\nreflectance = 0.5\nback = { reflektance = 0.4 }"),
        "s.toml:4: materials.m.back: unknown key \"reflektance\" for type \"diffuse\". Did you mean "
        "\"reflectance\"? Allowed: type, reflectance.");
    EXPECT_REFUSAL(material("type = \"diffuse\"\nreflectance = 0.5\nback = 0.4"),
                   "s.toml:4: materials.m.back: found the number 0.4 where a table is needed.");
    EXPECT_REFUSAL(
        material("type = \"diffuse\"\nreflectance = 0.5\nback = { back = { reflectance = 0.4 } }"),
        "s.toml:4: materials.m.back: unknown key \"back\" for type \"diffuse\". Allowed: type, reflectance.");
    EXPECT_REFUSAL(
        material("type = \"diffuse\"\nreflectance = 0.5\nback = { reflectance = 1.4 }"),
        "s.toml:4: materials.m.back.reflectance: 1.4 is not allowed. Allowed: from 0 to 1 (no surface "
        "reflects more light than it receives).");
}

}  // namespace
}  // namespace stilb::io
