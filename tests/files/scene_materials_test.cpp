#include "files/scene_text.h"

namespace stilb {
namespace {

std::string material(const std::string& keys) { return "[materials.m]\n" + keys; }

TEST(SceneMaterials, SuggestsTheNearestKey) {
    EXPECT_REFUSAL(
        material("type = \"phong\"\ndiffuse = 0.3\nexponnent = 60"),
        "s.toml:4: materials.m: unknown key \"exponnent\" for type \"phong\". Did you mean \"exponent\"? "
        "Allowed: type, diffuse, specular, exponent.");
    EXPECT_REFUSAL(material("type = \"black\"\nreflectance = 0"),
                   "s.toml:3: materials.m: unknown key \"reflectance\" for type \"black\". Allowed: type.");
}

TEST(SceneMaterials, RefusesUnknownAndLaterTypes) {
    EXPECT_REFUSAL(
        material("type = \"difuse\""),
        "s.toml:2: materials.m.type: unknown type \"difuse\". Did you mean \"diffuse\"? Allowed: diffuse, "
        "phong, mirror, black.");
    for (const std::string later : {"rough", "ward", "plastic", "glass", "pane"}) {
        EXPECT_REFUSAL(material("type = \"" + later + "\"\nior = 1.5"),
                       "s.toml:2: materials.m.type: type \"" + later +
                           "\" is not supported yet. Allowed: diffuse, phong, mirror, black.");
    }
}

TEST(SceneMaterials, RefusesMissingKeys) {
    EXPECT_REFUSAL("\n[materials.m]\nreflectance = 1",
                   "s.toml:2: materials.m: key \"type\" is missing. Allowed: diffuse, phong, mirror, black.");
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
    EXPECT_NO_THROW(read_text(material("type = \"phong\"\ndiffuse = 0.7\nspecular = 0.3\nexponent = 10")));
    const std::string phong = "type = \"phong\"\ndiffuse = 0.7\nspecular = 0.3\nexponent = ";
    const std::string allowed = " is not allowed. Allowed: from 0 to 1e6.";
    EXPECT_REFUSAL(material(phong + "-1"), "s.toml:5: materials.m.exponent: -1" + allowed);
    EXPECT_REFUSAL(material(phong + "2e6"), "s.toml:5: materials.m.exponent: 2000000" + allowed);
}

}  // namespace
}  // namespace stilb
