// The parts of the extension module stilb._stilb, one for each file.
#pragma once

#include <nanobind/nanobind.h>

namespace stilb::api::bindings {

void add_scenes(nanobind::module_& module);
void add_results(nanobind::module_& module);
void add_runs(nanobind::module_& module);
void add_run_states(nanobind::module_& module);
void add_files(nanobind::module_& module);
void add_exact_solutions(nanobind::module_& module);
void add_hypothesis_tests(nanobind::module_& module);

}  // namespace stilb::api::bindings
