#include "stilb/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <utility>

#include "api/scene_data.h"
#include "base/monitor.h"
#include "checks/checks.h"
#include "estimators/estimator_list.h"
#include "io/export/export.h"
#include "io/import/scene_formats.h"
#include "io/scene/sections.h"
#include "io/scene/toml.h"
#include "stilb/error.h"

namespace stilb::api {
namespace {

io::TomlValue toml_of(const Value& value);

io::TomlMembers members_of(const Parameters& parameters) {
    io::TomlMembers members;
    for (const auto& [key, value] : parameters) members.push_back({key, 0, toml_of(value)});
    return members;
}

io::TomlValue toml_of(const Value& value) {
    return std::visit(
        [](const auto& content) -> io::TomlValue {
            using Content = std::decay_t<decltype(content)>;
            if constexpr (std::is_same_v<Content, Value::List>) {
                io::TomlArray array;
                for (const Value& element : content) array.push_back(toml_of(element));
                return {std::move(array)};
            } else if constexpr (std::is_same_v<Content, Value::Table>) {
                return {members_of(content)};
            } else {
                return {content};
            }
        },
        value.content());
}

Scene make_scene(io::SceneFile file, const std::filesystem::path& path = {}) {
    return Scene(std::make_shared<const Scene::Data>(std::move(file), path));
}

}  // namespace

Scene Scene::load(const std::filesystem::path& path, std::span<const std::string> settings,
                  const Control& control) {
    const auto start = Monitor::Clock::now();
    const Monitor monitor(control.interrupt, {}, [&](std::string_view stage, double share) {
        if (!control.report) return;
        const double elapsed_s = std::chrono::duration<double>(Monitor::Clock::now() - start).count();
        constexpr double unknown = std::numeric_limits<double>::infinity();
        control.report(
            {std::string(stage), elapsed_s, share > 0 ? elapsed_s * (1 / share - 1) : unknown, unknown});
    });
    return make_scene(io::load_scene(path, settings, monitor), path);
}

Scene Scene::parse(std::string_view toml, const std::filesystem::path& directory) {
    return make_scene(io::read_scene(toml, "", directory));
}

std::string Scene::name() const { return data_->file.scene.name; }

std::vector<std::string> Scene::sensors() const {
    std::vector<std::string> names;
    for (const Sensor& sensor : data_->file.sensors) names.push_back(sensor.name);
    return names;
}

Options Scene::options() const { return data_->file.run; }

namespace {

/// Throws InputError where an option differs from the scene's, and the method does not go by it.
void require_effect(const Options& options, const Options& of_scene) {
    for_each_field<Options>([&](const auto& option) {
        if (options.*option.member == of_scene.*option.member) return;
        if (const auto lack = run::lack_of_effect(options, run::flag_of(option.key), "first_shot"))
            throw InputError(fmt::format("{} {}", option.key, *lack));
    });
}

}  // namespace

RunOptions run_options(const Scene& scene, const std::optional<Options>& options) {
    RunOptions run = scene.data().file.run;
    if (!options) return run;
    const Options of_scene = run;
    static_cast<Options&>(run) = *options;
    run::require_valid(run);
    require_effect(run, of_scene);
    run.patches = run::patch_options(run);
    return run;
}

/// The scene as the reader takes it: a tree without lines.
struct SceneBuilder::Data {
    std::string name;
    io::TomlMembers materials, objects, lights, sensors, scenes, run, defaults;
    std::filesystem::path directory = ".";
    std::optional<Scene> base;

    void add(io::TomlMembers Data::*section, std::string_view section_name, const std::string& part,
             io::TomlMembers parameters) {
        const auto has_name = [&](const io::TomlMember& member) { return member.key == part; };
        if (std::ranges::any_of(this->*section, has_name)) {
            throw InputError(fmt::format("{}.{}: there is already a part of this name. Choose another name.",
                                         section_name, part));
        }
        (this->*section).push_back({part, 0, {std::move(parameters)}});
    }
};

SceneBuilder::SceneBuilder(const std::string& name) : data_(std::make_unique<Data>()) { data_->name = name; }
SceneBuilder::SceneBuilder(Scene scene) : data_(std::make_unique<Data>()) {
    data_->name = scene.name();
    data_->base = std::move(scene);
}
SceneBuilder::~SceneBuilder() = default;
SceneBuilder::SceneBuilder(SceneBuilder&&) noexcept = default;
SceneBuilder& SceneBuilder::operator=(SceneBuilder&&) noexcept = default;

SceneBuilder& SceneBuilder::material(const std::string& name, const Parameters& parameters) {
    data_->add(&Data::materials, "materials", name, members_of(parameters));
    return *this;
}

SceneBuilder& SceneBuilder::object(const std::string& name, const Parameters& parameters) {
    data_->add(&Data::objects, "objects", name, members_of(parameters));
    return *this;
}

SceneBuilder& SceneBuilder::mesh(const std::string& name, std::span<const Triple> vertices,
                                 std::span<const std::array<std::uint32_t, 3>> triangles,
                                 const Parameters& parameters) {
    std::vector<Vec3> positions;
    positions.reserve(vertices.size());
    for (const auto& [x, y, z] : vertices) positions.push_back({x, y, z});
    io::TomlMembers members = members_of(parameters);
    members.push_back({"shape", 0, {std::string("polygons")}});
    members.push_back({"vertices", 0, {std::make_shared<const std::vector<Vec3>>(std::move(positions))}});
    members.push_back({"faces",
                       0,
                       {std::make_shared<const std::vector<std::array<std::uint32_t, 3>>>(triangles.begin(),
                                                                                          triangles.end())}});
    data_->add(&Data::objects, "objects", name, std::move(members));
    return *this;
}

SceneBuilder& SceneBuilder::mesh(const std::string& name, const std::vector<Triple>& vertices,
                                 const std::vector<std::array<std::uint32_t, 3>>& triangles,
                                 const std::string& material) {
    return mesh(name, std::span(vertices), std::span(triangles), Parameters{{"material", material}});
}

SceneBuilder& SceneBuilder::light(const std::string& name, const Parameters& parameters) {
    data_->add(&Data::lights, "lights", name, members_of(parameters));
    return *this;
}

SceneBuilder& SceneBuilder::sensor(const std::string& name, const Parameters& parameters) {
    data_->add(&Data::sensors, "sensors", name, members_of(parameters));
    return *this;
}

SceneBuilder& SceneBuilder::run(const Parameters& parameters) {
    data_->run = members_of(parameters);
    return *this;
}

SceneBuilder& SceneBuilder::light_scene(const std::string& name, const Parameters& parameters) {
    data_->add(&Data::scenes, "scenes", name, members_of(parameters));
    return *this;
}

SceneBuilder& SceneBuilder::defaults(const Parameters& parameters) {
    data_->defaults = members_of(parameters);
    return *this;
}

SceneBuilder& SceneBuilder::directory(const std::filesystem::path& path) {
    data_->directory = path;
    return *this;
}

Scene SceneBuilder::build() const {
    const io::TomlMembers title{{"name", 0, {data_->name}}};
    const io::TomlMembers root{{"scene", 0, {title}},
                               {"materials", 0, {data_->materials}},
                               {"objects", 0, {data_->objects}},
                               {"lights", 0, {data_->lights}},
                               {"sensors", 0, {data_->sensors}},
                               {"scenes", 0, {data_->scenes}},
                               {"run", 0, {data_->run}},
                               {"defaults", 0, {data_->defaults}}};
    return make_scene(
        io::read_scene(root, "", data_->directory, data_->base ? data_->base->data().file : io::SceneFile{}));
}

Export export_scene(const Scene& scene, const std::string& format, const std::filesystem::path& folder) {
    io::ExportReport report = io::export_scene(scene.data().file, io::export_format(format), folder);
    return {std::move(report.files), std::move(report.warnings)};
}

std::vector<PartType> part_types() {
    std::vector<PartType> all;
    const auto add = [&](const char* section, const std::vector<io::TypeKeys>& types) {
        for (const auto& [type, keys] : types)
            all.push_back({section, std::string(type), {keys.begin(), keys.end()}});
    };
    add("materials", io::material_types());
    add("objects", io::object_shapes());
    add("lights", io::light_types());
    add("sensors", io::sensor_types());
    return all;
}

std::vector<std::string> validate(const Scene& scene) {
    const io::SceneFile& file = scene.data().file;
    const run::PreparedScene& prepared = scene.data().prepared;
    const auto caster = prepared.caster({}, Monitor::none());
    const checks::Enclosures enclosures(file.scene, *caster, prepared.findings());
    return texts_of(checks::scene_warnings(file.scene, *caster, enclosures, file.sensors, file.warnings));
}

std::vector<std::string> validate(const SceneBuilder& builder) {
    try {
        return validate(builder.build());
    } catch (const InputError& error) {
        return {error.what()};
    }
}

}  // namespace stilb::api
