// The extension module stilb._stilb: the C++ library for the Python package, which has the documented names.
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <string_view>
#include <vector>

#include "base/version.h"
#include "bindings/parts.h"
#include "stilb/error.h"

namespace nb = nanobind;

NB_MODULE(_stilb, module) {
    module.attr("version") = stilb::program_version();
    nb::exception<stilb::InputError>(module, "InputError", PyExc_ValueError).attr("__doc__") =
        "An error in the input. The message says what is wrong, where, and what would be right.";
    nb::exception<stilb::Cancelled>(module, "Cancelled", PyExc_RuntimeError).attr("__doc__") =
        "A run was ended by its time limit or by its caller before there was any result.";
    module.def(
        "did_you_mean",
        [](const std::string& found, const std::vector<std::string>& allowed) {
            return stilb::did_you_mean(found, std::vector<std::string_view>(allowed.begin(), allowed.end()));
        },
        nb::arg("found"), nb::arg("allowed"));
    stilb::api::bindings::add_scenes(module);
    stilb::api::bindings::add_results(module);
    stilb::api::bindings::add_runs(module);
    stilb::api::bindings::add_run_states(module);
    stilb::api::bindings::add_files(module);
    nb::module_ exact = module.def_submodule("exact");
    stilb::api::bindings::add_exact_solutions(exact);
    nb::module_ statistics = module.def_submodule("statistics");
    stilb::api::bindings::add_hypothesis_tests(statistics);
}
