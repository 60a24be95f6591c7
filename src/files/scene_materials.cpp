// [materials.NAME]
#include <fmt/format.h>

#include <array>

#include "files/scene_sections.h"

namespace stilb {
namespace {

constexpr Range kReflectance{0, 1, "from 0 to 1 (no surface reflects more light than it receives)"};
constexpr Range kPhongExponent{0, 1e6, "from 0 to 1e6"};

Material read_diffuse(TomlTable& table) {
    table.expect_keys({"type", "reflectance"}, "type \"diffuse\"");
    return Diffuse{table.at("reflectance").spectrum(kReflectance)};
}

Material read_phong(TomlTable& table) {
    table.expect_keys({"type", "diffuse", "specular", "exponent"}, "type \"phong\"");
    const Phong phong{table.at("diffuse").spectrum(kReflectance), table.at("specular").spectrum(kReflectance),
                      table.at("exponent").number(kPhongExponent)};
    constexpr double rounding = 1e-12;  // 0.7 + 0.3 need not be 1 to the last bit
    const double largest = (phong.diffuse + phong.specular).max();
    if (largest > 1 + rounding) {
        table.fail(
            fmt::format("diffuse + specular is {}: no surface reflects more light than it receives. "
                        "Allowed: at most 1 in each channel.",
                        largest));
    }
    return phong;
}

Material read_mirror(TomlTable& table) {
    table.expect_keys({"type", "reflectance"}, "type \"mirror\"");
    return Mirror{table.at("reflectance").spectrum(kReflectance)};
}

Material read_black(TomlTable& table) {
    table.expect_keys({"type"}, "type \"black\"");
    return Black{};
}

constexpr std::array<std::string_view, 4> kTypes{"diffuse", "phong", "mirror", "black"};
constexpr std::array<std::string_view, 5> kLaterTypes{"rough", "ward", "plastic", "glass", "pane"};

Material read_material(TomlTable& table) {
    const std::string_view type = table.choose("type", kTypes, kLaterTypes);
    if (type == "diffuse") return read_diffuse(table);
    if (type == "phong") return read_phong(table);
    if (type == "mirror") return read_mirror(table);
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

}  // namespace stilb
