
#include "io/scene/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "io/scene/fields.h"
#include "io/scene/overrides.h"
#include "io/scene/sections.h"
#include "io/text/file_kind.h"
#include "io/text/text.h"
#include "io/text/utf8.h"
#include "materials/model_list.h"
#include "run/options.h"
#include "scene/glass.h"
#include "scene/overlaps.h"
#include "stilb/error.h"

namespace stilb::io {

namespace {

/// More reflections are not kept apart: each costs memory.
constexpr int kMostBouncesApart = 20;
constexpr Range kMaintenance{1e-3, 1, "a factor above 0 (from 0.001 to 1)"};
// The value of an option of [run], by its limits.

double read_option(const TomlItem& item, std::string_view, const Range& limits) {
    return item.number(limits);
}
double read_option(const TomlItem& item, std::string_view, const api::Share& limits) {
    const auto share = item.is_text() ? run::parse_relative_error(item.text()) : item.number(limits.range);
    if (!share) {
        item.fail(
            fmt::format("{} is not allowed. Allowed: {}.", in_quotes(item.text()), limits.range.allowed));
    }
    return *share;
}
std::int64_t read_option(const TomlItem& item, std::string_view, const api::WholeRange& limits) {
    return item.integer(limits.min, limits.max);
}
std::string read_option(const TomlItem& item, std::string_view key, const api::Names& limits) {
    return std::string(limits.all()[item.index_in(limits.all(), key)]);
}

/// The section as a table; an absent one is an empty table.
TomlTable section_of(const TomlTable& root, std::string_view name, const TomlTable& none) {
    const auto item = root.find(name);
    return item ? item->table() : none;
}

void warn_of_unused_materials(const TomlTable& section, SceneFile& file) {
    const Scene& scene = file.scene;
    std::vector<bool> is_used(scene.materials.size());
    for (const Object& object : scene.objects) {
        for (const MaterialId material : object.materials) is_used[index_of(material)] = true;
    }
    for (std::size_t m = 0; m < is_used.size(); ++m) {
        const auto item = is_used[m] ? std::nullopt : section.find(scene.materials[m].name);
        if (item) file.warnings.push_back(fmt::format("{}: no object has this material.", item->where()));
    }
}

/// Throws where the section has a name that the scene has already.
template <typename Parts>
void require_new_names(const TomlTable& section, const Parts& parts) {
    for (const auto& part : parts) {
        if (const auto item = section.find(part.name))
            item->fail("the scene has a part of this name already. Choose another name.");
    }
}

}  // namespace

std::vector<NamedTable> named_tables(const TomlTable& section) {
    std::vector<NamedTable> tables;
    for (const auto& [name, item] : section.items()) {
        const bool is_plain = !name.empty() && std::none_of(name.begin(), name.end(), [](unsigned char c) {
            return c < 0x20 || c == 0x7f || c == '/' || c == '\\';
        });
        if (!is_plain) {
            item.fail(fmt::format(
                "{} cannot be a name (names become parts of file names). Allowed: any text without "
                "slashes and control characters.",
                in_quotes(name)));
        }
        tables.push_back({name, item.table()});
    }
    return tables;
}

std::vector<NamedTable> named_tables(const TomlTable& section, const Defaults& defaults) {
    std::vector<NamedTable> tables = named_tables(section);
    for (NamedTable& named : tables) named.table = defaults.complete(named.table);
    return tables;
}

std::vector<TomlItem> read_list(const TomlItem& list, std::string_view what) {
    std::vector<TomlItem> items = list.elements();
    if (items.empty()) {
        list.fail(fmt::format("found no {}. Allowed: [[x, y, z], ...] with one {} or more.", what, what));
    }
    return items;
}

Vec3 read_direction(const TomlItem& item, std::vector<Warning>& warnings) {
    const Vec3 given = item.vector();
    const Vec3 normal = item.made_unit(given);
    constexpr double rounding = 1e-3;  // three digits are enough to say that a unit vector is meant
    if (std::abs(length(given) - 1) > rounding) {
        warnings.push_back(fmt::format("{}: the vector has length {:.4g}; it is normalised to length 1.",
                                       item.where(), length(given)));
    }
    return normal;
}

Rectangle read_rectangle(const TomlTable& table) {
    const TomlItem edge_u = table.at("edge_u"), edge_v = table.at("edge_v");
    const Rectangle rectangle{table.at("corner").vector(), edge_u.vector(), edge_v.vector()};
    const Vec3 front = cross(edge_u.made_unit(rectangle.edge_u), edge_v.made_unit(rectangle.edge_v));
    constexpr double flattest = 1e-6;  // sine of the angle between the edges
    if (length(front) < flattest) {
        edge_v.fail("is parallel to edge_u, so the edges span no area. Allowed: any other direction.");
    }
    return rectangle;
}

RunOptions read_run(TomlTable section) {
    std::vector<std::string_view> keys = keys_of<api::Options>();
    keys.emplace_back("maintenance");
    section.expect_keys(keys);
    RunOptions run;
    for_each_field<api::Options>([&](const auto& option) {
        using Value = typename std::decay_t<decltype(option)>::Plain;
        if (const auto item = section.find(option.key))
            run.*option.member = static_cast<Value>(read_option(*item, option.key, option.limits));
    });
    run.patches = run::patch_options(run);
    return run;
}

namespace {

/// Whether a light or group that the scene does without is in its section: all of its lights are off.
bool is_off(std::string_view name, const TomlTable& lights) {
    if (lights.has(name)) return true;
    return std::ranges::any_of(named_tables(lights),
                               [&](const NamedTable& light) { return light.table.text_of("group") == name; });
}

/// [scenes.NAME]: factors of lights and groups beside the keys of the state itself. `section`: [lights].
LightScene read_light_scene(const std::string& name, const TomlTable& table, const TomlTable& section,
                            const SceneFile& file) {
    const std::vector<std::string> names = scene::names_for_dimming(file.scene);
    const std::vector<std::string_view> lights(names.begin(), names.end());
    LightScene state;
    state.name = name;
    for (const auto& [key, item] : table.items()) {
        if (key == "others") {
            state.others = item.rgb(kDimming);
        } else if (key == "bounces") {
            state.bounces = static_cast<int>(item.integer(0, kMostBouncesApart));
        } else if (key == "maintenance") {
            state.maintenance = item.number(kMaintenance);
        } else if (key == "sensors") {
            for (const TomlItem& sensor : item.elements()) {
                if (!sensors::find_sensor(file.sensors, sensor.text()))
                    sensor.fail(fmt::format("there is no sensor {}.", in_quotes(sensor.text())));
                state.sensors.push_back(sensor.text());
            }
        } else if (std::ranges::find(names, key) != names.end()) {
            state.factors.push_back({key, item.rgb(kDimming)});
        } else if (is_off(key, section)) {
            item.rgb(kDimming);
        } else {
            item.fail(
                fmt::format("there is no light or group of lights {}.{} Or: others, bounces, maintenance, "
                            "sensors.",
                            in_quotes(key), suggestion(key, lights)));
        }
    }
    return state;
}

}  // namespace

double read_maintenance(const TomlTable& table, double otherwise) {
    const auto item = table.find("maintenance");
    return item ? item->number(kMaintenance) : otherwise;
}

SceneFile read_scene(std::string_view toml, const std::string& name, const std::filesystem::path& directory,
                     std::span<const std::string> overrides, const Monitor& monitor) {
    TomlValue document = parse_toml(toml, name);
    auto& members = std::get<TomlMembers>(document.content);
    if (members.empty()) {
        throw InputError(
            "the scene file is empty. Needed: the sections materials, objects, lights and sensors.", {name});
    }
    override_values(members, overrides);
    SceneFile file = read_scene(members, name, directory, {}, monitor);
    file.overrides.assign(overrides.begin(), overrides.end());
    return file;
}

SceneFile read_scene(const TomlMembers& members, const std::string& name,
                     const std::filesystem::path& directory, SceneFile file, const Monitor& monitor) {
    TomlTable root(members, "", name, 0);
    root.expect_keys({"scene", "defaults", "materials", "objects", "lights", "sensors", "scenes", "run"});
    const TomlMembers nothing;
    const TomlTable none(nothing, "", name, 0);
    TomlTable all_defaults = section_of(root, "defaults", none);
    all_defaults.expect_keys({"materials", "lights", "sensors"});
    const auto defaults = [&](std::string_view section, std::vector<TypeKeys> types) {
        return Defaults(section_of(all_defaults, section, none), std::move(types));
    };

    TomlTable scene = section_of(root, "scene", none);
    scene.expect_keys({"name"});
    if (const auto title = scene.find("name")) file.scene.name = title->text();
    const TomlTable materials = section_of(root, "materials", none);
    const TomlTable objects = section_of(root, "objects", none);
    const TomlTable lights = section_of(root, "lights", none);
    const TomlTable sensors = section_of(root, "sensors", none);
    require_new_names(materials, file.scene.materials);
    require_new_names(objects, file.scene.objects);
    require_new_names(lights, file.scene.lights);
    require_new_names(sensors, file.sensors);
    read_materials(materials, defaults("materials", material_types()), file.scene);
    PartsOfObjects parts = read_objects(objects, directory, file, monitor);
    const TomlTable run = section_of(root, "run", none);
    if (!run.members().empty()) file.run = read_run(run);
    read_lights(lights,
                {defaults("lights", lamp_types()), read_maintenance(run, 1), std::move(parts), directory},
                file);
    warn_of_unused_materials(materials, file);
    std::ranges::move(scene::settle_glass(file.scene), std::back_inserter(file.warnings));
    scene::put_lamps_in_front(file.scene);
    std::erase_if(file.warnings, is_of(WarningKind::no_light));
    if (file.scene.lights.empty())
        file.warnings.emplace_back(WarningKind::no_light, InputError(std::string(kNoLight), {name}).what());
    read_sensors(sensors, defaults("sensors", sensor_types()), file);
    for (const auto& [state, table] : named_tables(section_of(root, "scenes", none)))
        file.run.light_scenes.push_back(read_light_scene(state, table, lights, file));
    return file;
}

SceneFile read_scene_file(const std::filesystem::path& path, std::span<const std::string> overrides,
                          const Monitor& monitor) {
    const FileKind kind = kind_of_file(path);
    if (!may_be_scene_file(kind)) throw InputError(not_a_scene(kind), {path.string()});
    SceneFile file = read_scene(read_text_file(path), path.string(), path.parent_path(), overrides, monitor);
    file.sources.insert(file.sources.begin(), path);
    return file;
}

// [materials.NAME]

namespace {

materials::SharesByAngle::Row read_row(const TomlItem& item, const Range& range) {
    const std::vector<TomlItem> elements = item.elements();
    if (elements.size() != 2)
        item.fail("a row is an angle in degrees and a share: [60, 0.7] or [60, [r, g, b]].");
    return {elements[0].number(materials::kDegreesToNormal), elements[1].rgb(range)};
}

}  // namespace

void read_value(const TomlItem& item, const Range& range, materials::SharesByAngle& value) {
    const bool has_rows = item.is_array() && !item.elements().empty() && item.elements()[0].is_array();
    if (!has_rows) {
        value = materials::SharesByAngle::along_normal(item.rgb(range));
        return;
    }
    value.rows.clear();
    for (const TomlItem& row : item.elements()) value.rows.push_back(read_row(row, range));
    if (value.is_along_normal()) item.fail("a table has two rows at least.");
    const std::size_t wrong = value.first_out_of_order();
    if (wrong < value.rows.size()) item.elements()[wrong].fail(materials::SharesByAngle::kOutOfOrder);
}

namespace {

template <typename Model>
Keys material_keys() {
    Keys keys = io::keys_of<materials::ParametersOf<Model>>();
    keys.insert(keys.begin(), "type");
    return keys;
}

/// Each model reads its own parameters. `more`: keys that are not those of the model.
Material read_material(TomlTable& table, const Keys& more) {
    const std::string_view type = table.choose("type", materials::type_names());
    std::optional<Material> read;
    materials::for_each_model([&]<typename Model>() {
        if (type != Model::kType) return;
        Keys keys = material_keys<Model>();
        keys.insert(keys.end(), more.begin(), more.end());
        table.expect_keys(keys, fmt::format("type \"{}\"", type));
        read = Model(read_fields<materials::ParametersOf<Model>>(table));
    });
    return *read;
}

/// Reads `back = { ... }`: another material, or, without a type, the same one with some other values.
Material read_back(const TomlTable& table, const Material& front) {
    TomlTable back = table.at("back").table();
    TomlMembers members = back.members();
    for (const TomlMember& member : table.members()) {
        if (!back.has("type") && member.key != "back" && !back.has(member.key)) members.push_back(member);
    }
    TomlTable whole = back.with(std::move(members));
    Material read = read_material(whole, {});
    if (const auto message = contradiction_of_sides(front, read)) back.fail(*message);
    return read;
}

}  // namespace

std::vector<TypeKeys> material_types() {
    std::vector<TypeKeys> types;
    materials::for_each_model([&]<typename Model>() {
        types.push_back({Model::kType, material_keys<Model>()});
        types.back().keys.emplace_back("back");
    });
    return types;
}

void read_materials(const TomlTable& section, const Defaults& defaults, Scene& scene) {
    std::vector<NamedTable> tables = named_tables(section, defaults);
    const std::size_t first = scene.materials.size();
    for (auto& [name, table] : tables) scene.materials.push_back({name, read_material(table, {"back"})});
    for (std::size_t i = 0; i < tables.size(); ++i) {
        const auto& [name, table] = tables[i];
        if (!table.has("back")) continue;
        const auto back = static_cast<std::uint32_t>(scene.materials.size());
        scene.materials.push_back({name + " (back)", read_back(table, scene.materials[first + i].material)});
        scene.materials[first + i].back = MaterialId{back};
    }
}

}  // namespace stilb::io
