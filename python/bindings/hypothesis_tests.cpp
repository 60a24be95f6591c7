// The statistical tests of statistics/hypothesis.h.
#include <nanobind/nanobind.h>
#include <nanobind/stl/vector.h>

#include "bindings/parts.h"
#include "statistics/hypothesis.h"

namespace stilb::api::bindings {

namespace nb = nanobind;

void add_hypothesis_tests(nb::module_& module) {
    nb::class_<statistics::Chi2Result>(module, "Chi2Result")
        .def_ro("statistic", &statistics::Chi2Result::statistic)
        .def_ro("degrees_of_freedom", &statistics::Chi2Result::degrees_of_freedom)
        .def_ro("p_value", &statistics::Chi2Result::p_value);
    module.def("student_t_quantile", &statistics::student_t_quantile, nb::arg("probability"),
               nb::arg("degrees_of_freedom"));
    module.def("two_sided_p_of_z", &statistics::two_sided_p_of_z, nb::arg("z"));
    module.def("two_sided_p_of_t", &statistics::two_sided_p_of_t, nb::arg("t"),
               nb::arg("degrees_of_freedom"));
    module.def("equivalent_z", &statistics::equivalent_z, nb::arg("t"), nb::arg("degrees_of_freedom"));
    module.def("sidak_threshold_z", &statistics::sidak_threshold_z, nb::arg("family_error"),
               nb::arg("comparisons"));
    module.def(
        "chi2_test",
        [](const std::vector<double>& observed, const std::vector<double>& expected, double least_expected) {
            return statistics::chi2_test(observed, expected, least_expected);
        },
        nb::arg("observed"), nb::arg("expected"), nb::arg("least_expected"));
    module.def(
        "uniformity_p", [](const std::vector<double>& numbers) { return statistics::uniformity_p(numbers); },
        nb::arg("numbers"));
}

}  // namespace stilb::api::bindings
