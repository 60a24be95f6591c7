#include "io/import/import_settings.h"

#include <array>
#include <string_view>
#include <utility>

#include "io/scene/overrides.h"
#include "io/scene/sections.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

constexpr Range kImportScale{1e-9, 1e9, "\"auto\" or a factor above 0 (from 1e-9 to 1e9)"};
constexpr Range kLightScale{1e-9, 1e9, "a factor above 0 (from 1e-9 to 1e9)"};
constexpr std::array<std::string_view, 3> kUpNames{"y", "z", "auto"};

ImportOptions read_options(TomlTable table) {
    table.expect_keys({"scale", "up", "light_scale", "textures"});
    ImportOptions options;
    const auto scale = table.find("scale"), light_scale = table.find("light_scale");
    if (scale && !(scale->is_text() && scale->text() == "auto")) options.scale = scale->number(kImportScale);
    if (light_scale) options.light_scale = light_scale->number(kLightScale);
    if (const auto up = table.find("up")) {
        const std::size_t index = up->index_in(kUpNames, "axis");
        if (index < 2) options.up = static_cast<UpAxis>(index);
    }
    if (const auto textures = table.find("textures")) options.textures = textures->boolean();
    return options;
}

}  // namespace

ImportSettings::ImportSettings(std::span<const std::string> overrides, std::string name)
    : name_(std::move(name)), overrides_(overrides.begin(), overrides.end()) {
    override_values(document_, overrides);
    for (const TomlMember& member : document_) {
        if (member.key == "import" || member.key == "run" || member.key == "sensors") continue;
        throw InputError(
            "only keys of import, run and sensors can be given beside a file that is no TOML. Make "
            "a TOML file of it, which can be edited: stilb import FILE -o DIR",
            {member.key});
    }
    options_ = read_options(section("import"));
}

TomlTable ImportSettings::section(std::string_view key) const {
    const TomlTable root(document_, "", name_, 0);
    const auto item = root.find(key);
    return item ? item->table() : TomlTable(nothing_, std::string(key), name_, 0);
}

void ImportSettings::scale_lights(SceneFile& file) const {
    if (options_.light_scale == 1) return;
    for (Light& light : file.scene.lights)
        light.source = lights::scaled(light.source, Rgb::grey(options_.light_scale));
}

void ImportSettings::apply_to(SceneFile& file) const {
    const TomlTable run = section("run");
    file.run = read_run(run);
    const double maintenance = read_maintenance(run, 1);
    for (Light& light : file.scene.lights) {
        if (maintenance >= 1 || location_of(light) == LightLocation::infinity) continue;
        light.maintenance = maintenance;
        light.source = lights::scaled(light.source, Rgb::grey(maintenance));
    }
    const TomlTable none(nothing_, "", name_, 0);
    read_sensors(section("sensors"), Defaults(none, sensor_types()), file);
    file.overrides = overrides_;
}

geometry::Transform ImportOptions::to_world(UpAxis usual) const {
    return to_metres_and_z_up(scale.value_or(1), up.value_or(usual));
}

geometry::Transform to_metres_and_z_up(double scale, UpAxis up) {
    const geometry::Transform metres = geometry::Transform::scaling(scale);
    if (up == UpAxis::z) return metres;
    return compose({{1, 0, 0}, {0, 0, 1}, {0, -1, 0}, {}}, metres);
}

}  // namespace stilb::io
