// [materials.NAME]
#include <fmt/format.h>

#include <array>

#include "io/scene/sections.h"

namespace stilb::io {
namespace {

constexpr Range kReflectance{0, 1, "from 0 to 1 (no surface reflects more light than it receives)"};
constexpr Range kPhongExponent{0, 1e6, "from 0 to 1e6"};
constexpr Range kIor{1, 4, "from 1 to 4 (1.5 is common)"};
constexpr Range kRoughness{0.001, 1, "from 0.001 to 1 (a mirror has type \"mirror\")"};

Material read_diffuse(TomlTable& table) {
    table.expect_keys({"type", "reflectance"}, "type \"diffuse\"");
    return Diffuse{table.at("reflectance").rgb(kReflectance)};
}

void expect_no_gain(const TomlTable& table, const Rgb& diffuse, const Rgb& specular) {
    constexpr double rounding = 1e-12;  // 0.7 + 0.3 need not be 1 to the last bit
    const double largest = (diffuse + specular).max();
    if (largest > 1 + rounding) {
        table.fail(
            fmt::format("diffuse + specular is {}: no surface reflects more light than it receives. "
                        "Allowed: at most 1 in each channel.",
                        largest));
    }
}

Material read_phong(TomlTable& table) {
    table.expect_keys({"type", "diffuse", "specular", "exponent"}, "type \"phong\"");
    const Phong phong{table.at("diffuse").rgb(kReflectance), table.at("specular").rgb(kReflectance),
                      table.at("exponent").number(kPhongExponent)};
    expect_no_gain(table, phong.diffuse, phong.specular);
    return phong;
}

Material read_rough(TomlTable& table) {
    table.expect_keys({"type", "reflectance", "roughness"}, "type \"rough\"");
    return RoughConductor(table.at("reflectance").rgb(kReflectance),
                          table.at("roughness").number(kRoughness));
}

Material read_ward(TomlTable& table) {
    table.expect_keys({"type", "diffuse", "specular", "roughness", "rotation"}, "type \"ward\"");
    const Rgb diffuse = table.at("diffuse").rgb(kReflectance);
    const Rgb specular = table.at("specular").rgb(kReflectance);
    expect_no_gain(table, diffuse, specular);
    const std::vector<double> roughness = table.at("roughness").numbers(2, kRoughness);
    const auto rotation = table.find("rotation");
    return Ward(diffuse, specular, {roughness[0], roughness[1]}, rotation ? rotation->number(kAngle) : 0);
}

Material read_plastic(TomlTable& table) {
    table.expect_keys({"type", "diffuse", "ior", "roughness"}, "type \"plastic\"");
    return Plastic(table.at("diffuse").rgb(kReflectance), table.at("ior").number(kIor),
                   table.at("roughness").number(kRoughness));
}

Material read_mirror(TomlTable& table) {
    table.expect_keys({"type", "reflectance"}, "type \"mirror\"");
    return Mirror{table.at("reflectance").rgb(kReflectance)};
}

Material read_glass(TomlTable& table) {
    table.expect_keys({"type", "ior"}, "type \"glass\"");
    return Dielectric{table.at("ior").number(kIor)};
}

Material read_pane(TomlTable& table) {
    table.expect_keys({"type", "ior", "internal_transmittance"}, "type \"pane\"");
    return ThinDielectric{table.at("ior").number(kIor), table.at("internal_transmittance").rgb(kReflectance)};
}

Material read_black(TomlTable& table) {
    table.expect_keys({"type"}, "type \"black\"");
    return Black{};
}

constexpr std::array<std::string_view, 9> kTypes{"diffuse", "phong", "rough", "ward", "plastic",
                                                 "mirror",  "glass", "pane",  "black"};

Material read_material(TomlTable& table) {
    const std::string_view type = table.choose("type", kTypes);
    if (type == "diffuse") return read_diffuse(table);
    if (type == "phong") return read_phong(table);
    if (type == "rough") return read_rough(table);
    if (type == "ward") return read_ward(table);
    if (type == "plastic") return read_plastic(table);
    if (type == "mirror") return read_mirror(table);
    if (type == "glass") return read_glass(table);
    if (type == "pane") return read_pane(table);
    return read_black(table);
}

}  // namespace

std::vector<NamedMaterial> read_materials(const TomlTable& section) {
    std::vector<NamedMaterial> materials;
    for (auto& [name, table] : named_tables(section)) {
        materials.push_back({name, read_material(table)});
    }
    return materials;
}

}  // namespace stilb::io
