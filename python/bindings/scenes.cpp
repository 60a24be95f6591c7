// Scenes: read from files, or built from dictionaries with the keys of scene files.
#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <span>
#include <utility>

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

double read_error(const std::string& text) {
    const auto error = run::parse_relative_error(text);
    if (!error)
        throw InputError(
            fmt::format("error {}: expected a share between 0 and 1, such as 0.01 or \"1%\"", text));
    return *error;
}

void add_options(nb::module_& module) {
    nb::class_<Options>(module, "Options")
        .def(nb::init<>())
        .def_rw("method", &Options::method)
        .def_rw("error", &Options::error, nb::arg().none())
        .def_rw("target", &Options::target)
        .def_rw("time_s", &Options::time_s, nb::arg().none())
        .def_rw("samples", &Options::samples, nb::arg().none())
        .def_rw("bounces", &Options::bounces, nb::arg().none())
        .def_rw("patch_m", &Options::patch_m, nb::arg().none())
        .def_rw("seed", &Options::seed)
        .def_rw("threads", &Options::threads);
    module.def("read_error", read_error, nb::arg("text"));
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
        .def("sensors", &Scene::sensors)
        .def("options", &Scene::options);
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
