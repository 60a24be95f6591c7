// Results: the numbers as NumPy arrays that share the memory of the C++ results.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cstddef>
#include <optional>

#include "bindings/parts.h"
#include "stilb/measure.h"
#include "stilb/render.h"

namespace stilb::api::bindings {

namespace nb = nanobind;

namespace {

using Numbers = nb::ndarray<nb::numpy, const double>;
using Pixels = nb::ndarray<nb::numpy, const float>;

/// One number of each reading, or three: a view of the readings' memory, which `result` owns.
template <std::size_t components>
Numbers column(nb::pointer_and_handle<SensorResult> result, const double* first) {
    constexpr auto stride = static_cast<std::int64_t>(sizeof(Reading) / sizeof(double));
    const std::size_t count = result.p->readings.size();
    if constexpr (components == 1) {
        return Numbers(first, {count}, result.h, {stride});
    } else {
        return Numbers(first, {count, components}, result.h, {stride, 1});
    }
}

template <auto member>
Numbers values(nb::pointer_and_handle<SensorResult> result) {
    const auto& readings = result.p->readings;
    return column<1>(result, readings.empty() ? nullptr : &(readings.front().*member));
}

template <auto member>
Numbers triples(nb::pointer_and_handle<SensorResult> result) {
    const auto& readings = result.p->readings;
    return column<3>(result, readings.empty() ? nullptr : (readings.front().*member).data());
}

Pixels plane(nb::pointer_and_handle<Picture> picture, const std::vector<float>& values) {
    const auto height = static_cast<std::size_t>(picture.p->height);
    const auto width = static_cast<std::size_t>(picture.p->width);
    return Pixels(values.data(), {height, width}, picture.h);
}

void add_estimates(nb::module_& module) {
    nb::class_<Estimate>(module, "Estimate")
        .def_ro("value", &Estimate::value)
        .def_ro("standard_error", &Estimate::standard_error)
        .def_ro("lower", &Estimate::lower)
        .def_ro("upper", &Estimate::upper);
    nb::class_<Requirement>(module, "Requirement")
        .def_ro("key", &Requirement::key)
        .def_ro("limit", &Requirement::limit)
        .def_prop_ro("verdict",
                     [](const Requirement& requirement) {
                         constexpr std::array names{"pass", "fail", "undecided", "unsure"};
                         return names[static_cast<std::size_t>(requirement.verdict)];
                     })
        .def_ro("reason", &Requirement::reason);
}

void add_summary(nb::module_& module) {
    nb::class_<Summary>(module, "Summary")
        .def_ro("method", &Summary::method)
        .def_ro("technique", &Summary::technique)
        .def_ro("seed", &Summary::seed)
        .def_ro("samples", &Summary::samples)
        .def_ro("replicates", &Summary::replicates)
        .def_ro("elapsed_s", &Summary::elapsed_s)
        .def_ro("converged", &Summary::converged)
        .def_ro("attained_error", &Summary::attained_error)
        .def_ro("warnings", &Summary::warnings)
        .def_ro("warning_kinds", &Summary::warning_kinds);
}

void add_readings(nb::module_& module) {
    nb::class_<SensorResult>(module, "SensorResult")
        .def_ro("name", &SensorResult::name)
        .def_ro("type", &SensorResult::type)
        .def_ro("quantity", &SensorResult::quantity)
        .def_ro("unit", &SensorResult::unit)
        .def_ro("count", &SensorResult::count)
        .def_ro("attained_error", &SensorResult::attained_error)
        .def_ro("mean", &SensorResult::mean)
        .def_ro("minimum", &SensorResult::minimum)
        .def_ro("maximum", &SensorResult::maximum)
        .def_ro("uniformity", &SensorResult::uniformity)
        .def_ro("diversity", &SensorResult::diversity)
        .def_ro("requirements", &SensorResult::requirements)
        .def_prop_ro("value", &values<&Reading::value>)
        .def_prop_ro("standard_error", &values<&Reading::standard_error>)
        .def_prop_ro("lower", &values<&Reading::lower>)
        .def_prop_ro("upper", &values<&Reading::upper>)
        .def_prop_ro("rgb", &triples<&Reading::rgb>)
        .def_prop_ro("position", &triples<&Reading::position>)
        .def_prop_ro("direction", &triples<&Reading::direction>);
    nb::class_<Result, Summary>(module, "Result")
        .def_ro("sensors", &Result::sensors, nb::rv_policy::reference_internal)
        .def_ro("json", &Result::json);
}

void add_pictures(nb::module_& module) {
    nb::class_<Picture, Summary>(module, "Picture")
        .def_ro("width", &Picture::width)
        .def_ro("height", &Picture::height)
        .def_prop_ro("luminance",
                     [](nb::pointer_and_handle<Picture> picture) {
                         return plane(picture, picture.p->luminance_cd_m2);
                     })
        .def_prop_ro("standard_error",
                     [](nb::pointer_and_handle<Picture> picture) -> std::optional<Pixels> {
                         const std::vector<float>& errors = picture.p->standard_error_cd_m2;
                         if (errors.empty()) return std::nullopt;
                         return plane(picture, errors);
                     })
        .def_prop_ro("rgb",
                     [](nb::pointer_and_handle<Picture> picture) {
                         const auto height = static_cast<std::size_t>(picture.p->height);
                         const auto width = static_cast<std::size_t>(picture.p->width);
                         return Pixels(picture.p->rgb_cd_m2.data()->data(), {height, width, 3}, picture.h);
                     })
        .def("save", &Picture::save, nb::arg("path"), nb::call_guard<nb::gil_scoped_release>());
}

}  // namespace

void add_results(nb::module_& module) {
    add_estimates(module);
    add_summary(module);
    add_readings(module);
    add_pictures(module);
}

}  // namespace stilb::api::bindings
