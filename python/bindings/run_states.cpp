// Runs that go on, are made in parts and merged: their states.
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "api/run_state.h"
#include "api/scene_data.h"
#include "bindings/called_run.h"
#include "bindings/parts.h"
#include "stilb/measure.h"

namespace stilb::api::bindings {

namespace nb = nanobind;

namespace {

using Names = std::vector<std::string>;

Result measure_state(const Scene& scene, const Options& options, const Names& sensors, RunState& state,
                     bool to_next_check, nb::object progress) {
    return CalledRun(std::move(progress))([&](const Control& control) {
        return to_next_check ? measure_to_next_check(scene, options, control, sensors, state)
                             : measure(scene, options, control, sensors, &state);
    });
}

/// The state with the traits of a scene that is the same in another form.
void adopt(RunState& state, const Scene& scene, const Options& options, const Names& sensors) {
    state.data().adopt(scene, sensors::choose_meters(scene.data().file.sensors, sensors),
                       run_options(scene, options));
}

void add_state_class(nb::module_& module) {
    nb::class_<RunState>(module, "RunState")
        .def(nb::init<>())
        .def_static(
            "read",
            [](const nb::bytes& bytes, const std::string& name) {
                return RunState(std::string_view(bytes.c_str(), bytes.size()), name);
            },
            nb::arg("bytes"), nb::arg("name"))
        .def("copy", [](const RunState& state) { return state; })
        .def("bytes",
             [](const RunState& state) {
                 const std::string bytes = state.bytes();
                 return nb::bytes(bytes.data(), bytes.size());
             })
        .def("save", &RunState::save, nb::arg("path"), nb::call_guard<nb::gil_scoped_release>())
        .def("arguments", &RunState::arguments)
        .def("folder", &RunState::folder)
        .def("set_command", &RunState::set_command, nb::arg("arguments"), nb::arg("folder"))
        .def("has_begun", &RunState::has_begun)
        .def("samples", &RunState::samples)
        .def("seeds", &RunState::seeds)
        .def("elapsed_s", &RunState::elapsed_s)
        .def(
            "samples_at_next_check",
            [](const RunState& state, std::uint64_t after) { return state.samples_at_next_check(after); },
            nb::arg("after"))
        .def(
            "require_same_run",
            [](const RunState& state, const RunState& other, const std::string& name) {
                io::require_same_run(state.data().origin, other.data().origin.traits, name);
            },
            nb::arg("other"), nb::arg("name"), "Throws where another run could not go on from this state.")
        .def("adopt", &adopt, nb::arg("scene"), nb::arg("options"), nb::arg("sensors"))
        .def("merge", &RunState::merge, nb::arg("other"), nb::call_guard<nb::gil_scoped_release>());
}

}  // namespace

void add_run_states(nb::module_& module) {
    add_state_class(module);
    module.def("measure_state", &measure_state, nb::arg("scene"), nb::arg("options"), nb::arg("sensors"),
               nb::arg("state"), nb::arg("to_next_check"), nb::arg("progress").none());
    module.def(
        "plan_parts",
        [](const Scene& scene, const Options& options, const Names& sensors, RunState& state) {
            plan_parts(scene, options, state, {}, sensors);
        },
        nb::arg("scene"), nb::arg("options"), nb::arg("sensors"), nb::arg("state"),
        nb::call_guard<nb::gil_scoped_release>());
    module.def(
        "measure_part",
        [](const Scene& scene, const Options& options, const Names& sensors, std::size_t part,
           std::size_t parts,
           RunState& state) { measure_part(scene, options, part, parts, state, {}, sensors); },
        nb::arg("scene"), nb::arg("options"), nb::arg("sensors"), nb::arg("part"), nb::arg("parts"),
        nb::arg("state"), nb::call_guard<nb::gil_scoped_release>());
    module.def(
        "result_of",
        [](const Scene& scene, const RunState& state, const Options& options, const Names& sensors,
           const std::map<std::string, Triple>& factors) {
            return result_of(scene, state, options, sensors, factors);
        },
        nb::arg("scene"), nb::arg("state"), nb::arg("options"), nb::arg("sensors"), nb::arg("factors"),
        nb::call_guard<nb::gil_scoped_release>());
}

}  // namespace stilb::api::bindings
