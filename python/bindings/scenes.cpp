// Scenes: read from files, or built from dictionaries with the keys of scene files.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

#include "api/scene_data.h"
#include "base/field.h"
#include "bindings/called_run.h"
#include "bindings/parts.h"
#include "bindings/values.h"
#include "run/options.h"
#include "stilb/error.h"
#include "stilb/options.h"
#include "stilb/scene.h"

namespace stilb::api::bindings {

namespace nb = nanobind;

namespace {

using Vertices = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Triangles = nb::ndarray<const std::uint32_t, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

/// The rows of an array as arrays of three.
template <typename Row, typename Array>
std::span<const Row> rows_of(const Array& array) {
    static_assert(sizeof(Row) == 3 * sizeof(*array.data()));
    return {reinterpret_cast<const Row*>(array.data()), array.shape(0)};
}

/// In Python.
template <typename Option>
std::string type_name(const Option& option) {
    if (std::is_same_v<std::decay_t<decltype(option.limits)>, Share>) return "float | str";
    if (std::is_same_v<typename Option::Plain, double>) return "float";
    return std::is_same_v<typename Option::Plain, std::string> ? "str" : "int";
}

std::string allowed(const Range& limits) { return std::string(limits.allowed); }
std::string allowed(const Share& limits) { return std::string(limits.range.allowed); }
std::string allowed(const WholeRange& limits) {
    return fmt::format("a whole number from {} to {}", limits.min, limits.max);
}
std::string allowed(const Names& limits) { return fmt::format("{}", fmt::join(limits.all(), ", ")); }

/// One of Options, under its key.
template <typename Limits>
void add_option(nb::class_<Options>& options, const auto& option, const Limits&) {
    options.def_rw(option.key.data(), option.member, nb::arg().none());
}
void add_option(nb::class_<Options>& options, const auto& option, const Names&) {
    options.def_prop_rw(
        option.key.data(), [option](const Options& all) { return all.*option.member; },
        // Not std::optional: GCC 12 warns of nanobind's conversion.
        [option](Options& all, const char* text) {
            using Value = std::decay_t<decltype(all.*option.member)>;
            all.*option.member = text ? Value(text) : Options{}.*option.member;
        },
        nb::arg().none());
}
void add_option(nb::class_<Options>& options, const auto& option, const Share&) {
    using Typed = std::optional<std::variant<double, std::string>>;
    options.def_prop_rw(
        option.key.data(), [option](const Options& all) { return all.*option.member; },
        [option](Options& all, const Typed& typed) {
            all.*option.member = std::nullopt;
            if (!typed) return;
            const auto* const text = std::get_if<std::string>(&*typed);
            all.*option.member = text ? run::parse_relative_error(*text) : std::get<double>(*typed);
            if (!(all.*option.member))
                fail_at(option.key, fmt::format("\"{}\" is not allowed. Allowed: {}.", *text,
                                                option.limits.range.allowed));
        },
        nb::arg().none());
}

void add_options(nb::module_& module) {
    nb::class_<Options> options(module, "Options");
    options.def(nb::init<>());
    std::vector<std::array<std::string, 4>> described;
    for_each_field<Options>([&](const auto& option) {
        add_option(options, option, option.limits);
        described.push_back({std::string(option.key), type_name(option), std::string(option.meaning),
                             allowed(option.limits)});
    });
    module.def(
        "described_options", [described] { return described; },
        nb::sig("def described_options() -> list[list[str]]"),
        "The key, the type, the meaning and the allowed values of each option.");
}

void add_builder(nb::module_& module) {
    const auto adder = [](SceneBuilder& (SceneBuilder::*add)(const std::string&, const Parameters&),
                          const char* section) {
        return [add, section](SceneBuilder& builder, const std::string& name, const nb::dict& keys) {
            (builder.*add)(name, parameters_of(keys, fmt::format("{}.{}", section, name)));
        };
    };
    nb::class_<SceneBuilder>(module, "SceneBuilder")
        .def(nb::init<const std::string&>(), nb::arg("name"))
        .def(nb::init<Scene>(), nb::arg("scene"))
        .def("material", adder(&SceneBuilder::material, "materials"), nb::arg("name"), nb::arg("keys"))
        .def("object", adder(&SceneBuilder::object, "objects"), nb::arg("name"), nb::arg("keys"))
        .def("light", adder(&SceneBuilder::light, "lights"), nb::arg("name"), nb::arg("keys"))
        .def("sensor", adder(&SceneBuilder::sensor, "sensors"), nb::arg("name"), nb::arg("keys"))
        .def(
            "mesh",
            [](SceneBuilder& builder, const std::string& name, const Vertices& vertices,
               const Triangles& triangles, const nb::dict& keys) {
                builder.mesh(name, rows_of<Triple>(vertices),
                             rows_of<std::array<std::uint32_t, 3>>(triangles),
                             parameters_of(keys, "objects." + name));
            },
            nb::arg("name"), nb::arg("vertices"), nb::arg("triangles"), nb::arg("keys"))
        .def(
            "run",
            [](SceneBuilder& builder, const nb::dict& keys) { builder.run(parameters_of(keys, "run")); },
            nb::arg("keys"))
        .def("light_scene", adder(&SceneBuilder::light_scene, "scenes"), nb::arg("name"), nb::arg("keys"))
        .def(
            "defaults",
            [](SceneBuilder& builder, const nb::dict& keys) {
                builder.defaults(parameters_of(keys, "defaults"));
            },
            nb::arg("keys"))
        .def(
            "directory",
            [](SceneBuilder& builder, const std::filesystem::path& path) { builder.directory(path); },
            nb::arg("path"))
        .def("build", &SceneBuilder::build, nb::call_guard<nb::gil_scoped_release>());
}

}  // namespace

void add_scenes(nb::module_& module) {
    add_options(module);
    nb::class_<Scene>(module, "Scene")
        .def_static(
            "load",
            [](const std::filesystem::path& path, const std::vector<std::string>& settings,
               nb::object progress) {
                return CalledRun(std::move(progress))(
                    [&](const Control& control) { return Scene::load(path, settings, control); });
            },
            nb::arg("path"), nb::arg("settings"), nb::arg("progress").none())
        .def("name", &Scene::name)
        .def("path", [](const Scene& scene) { return scene.data().path; })
        .def("sensors", &Scene::sensors)
        .def("options", &Scene::options)
        .def_static("parse", &Scene::parse, nb::arg("toml"), nb::arg("directory"),
                    nb::call_guard<nb::gil_scoped_release>());
    add_builder(module);
    module.def("validate", nb::overload_cast<const Scene&>(&validate), nb::arg("scene"),
               nb::call_guard<nb::gil_scoped_release>());
    nb::class_<PartType>(module, "PartType")
        .def_ro("section", &PartType::section)
        .def_ro("type", &PartType::type)
        .def_ro("keys", &PartType::keys);
    module.def("part_types", &part_types);
}

}  // namespace stilb::api::bindings
