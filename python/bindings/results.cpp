// Results: the numbers as NumPy arrays that share the memory of the C++ results.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/statistic.h"
#include "bindings/parts.h"
#include "bindings/states.h"
#include "statistics/grid_summary.h"
#include "statistics/interval.h"
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

Pixels triple_plane(nb::pointer_and_handle<Picture> picture,
                    const std::vector<std::array<float, 3>>& values) {
    const auto height = static_cast<std::size_t>(picture.p->height);
    const auto width = static_cast<std::size_t>(picture.p->width);
    return Pixels(values.data()->data(), {height, width, 3}, picture.h);
}

/// Replicates x readings.
Numbers replicates(nb::pointer_and_handle<SensorResult> result) {
    const std::vector<double>& values = result.p->replicates;
    const std::size_t readings = result.p->readings.size();
    return Numbers(values.data(), {readings == 0 ? 0 : values.size() / readings, readings}, result.h);
}

/// The readings of the sensor by one part of the light; their colours are not known.
SensorResult readings_of(const LightShare& share, const SensorResult& sensor) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    SensorResult own{.name = sensor.name,
                     .type = sensor.type,
                     .quantity = sensor.quantity,
                     .unit = sensor.unit,
                     .count = sensor.count,
                     .readings = {},
                     .mean = share.mean,
                     .minimum = share.minimum,
                     .maximum = share.maximum,
                     .uniformity = share.uniformity,
                     .attained_error = 0,
                     .diversity = share.diversity,
                     .requirements = {},
                     .replicates = share.replicates,
                     .shares = {}};
    std::vector<statistics::Estimate> estimates;
    for (std::size_t j = 0; j < share.readings.size(); ++j) {
        const Estimate& e = share.readings[j];
        const Reading& whole = sensor.readings[j];
        own.readings.push_back({e, {unknown, unknown, unknown}, whole.position, whole.direction});
        estimates.push_back({e.value, e.standard_error, e.lower, e.upper});
    }
    own.attained_error = statistics::attained_error(estimates);
    return own;
}

/// By name and in order.
std::vector<std::pair<std::string, SensorResult>> shares(const SensorResult& sensor) {
    std::vector<std::pair<std::string, SensorResult>> all;
    for (const LightShare& share : sensor.shares) all.emplace_back(share.name, readings_of(share, sensor));
    return all;
}

/// By how much each replicate differs from a statistic, to first order.
std::vector<double> residuals(const SensorResult& result, const std::string& statistic) {
    const auto found = std::ranges::find(kStatisticNames, statistic);
    return statistics::residuals_of({result.replicates, result.readings.size()},
                                    static_cast<Statistic>(found - kStatisticNames.begin()));
}

void add_estimates(nb::module_& module) {
    nb::class_<Estimate> estimate(module, "Estimate");
    add_state(estimate);
    estimate.def_ro("value", &Estimate::value)
        .def_ro("standard_error", &Estimate::standard_error)
        .def_ro("lower", &Estimate::lower)
        .def_ro("upper", &Estimate::upper);
    nb::class_<Requirement> requirement(module, "Requirement");
    add_state(requirement);
    requirement.def_ro("key", &Requirement::key)
        .def_ro("limit", &Requirement::limit)
        .def_prop_ro("verdict",
                     [](const Requirement& rated) {
                         constexpr std::array names{"pass", "fail", "undecided", "unsure"};
                         return names[static_cast<std::size_t>(rated.verdict)];
                     })
        .def_ro("reason", &Requirement::reason);
}

void add_summary(nb::module_& module) {
    nb::class_<Summary> summary(module, "Summary");
    add_state(summary);
    summary.def_ro("method", &Summary::method)
        .def_ro("technique", &Summary::technique)
        .def_ro("seed", &Summary::seed)
        .def_ro("samples", &Summary::samples)
        .def_ro("replicates", &Summary::replicates)
        .def_ro("elapsed_s", &Summary::elapsed_s)
        .def_ro("stopped", &Summary::stopped)
        .def_ro("requested_error", &Summary::requested_error)
        .def_ro("converged", &Summary::converged)
        .def_ro("attained_error", &Summary::attained_error)
        .def_ro("warnings", &Summary::warnings)
        .def_ro("warning_kinds", &Summary::warning_kinds);
}

void add_readings(nb::module_& module) {
    nb::class_<SensorResult> sensor(module, "SensorResult");
    add_state(sensor);
    sensor.def_ro("name", &SensorResult::name)
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
        .def_prop_ro("direction", &triples<&Reading::direction>)
        .def_prop_ro("replicates", &replicates)
        .def("residuals", &residuals, nb::arg("statistic"))
        .def("shares", &shares);
    nb::class_<LightSceneResult> light_scene(module, "LightSceneResult");
    add_state(light_scene);
    light_scene.def_ro("name", &LightSceneResult::name)
        .def_ro("sensors", &LightSceneResult::sensors, nb::rv_policy::reference_internal)
        .def_ro("power_w", &LightSceneResult::power_w);
    nb::class_<Result, Summary> result(module, "Result");
    add_state(result);
    result.def_ro("sensors", &Result::sensors, nb::rv_policy::reference_internal)
        .def_ro("light_scenes", &Result::light_scenes, nb::rv_policy::reference_internal)
        .def_ro("confidence", &Result::confidence)
        .def(
            "summary", [](const Result& all) { return Summary(all); }, "Without the readings.")
        .def("json", &Result::json, nb::call_guard<nb::gil_scoped_release>());
}

void add_pictures(nb::module_& module) {
    nb::class_<Picture, Summary> type(module, "Picture");
    add_state(type);
    type.def_ro("width", &Picture::width)
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
                         return triple_plane(picture, picture.p->rgb_cd_m2);
                     })
        .def_prop_ro(
            "depth",
            [](nb::pointer_and_handle<Picture> picture) { return plane(picture, picture.p->depth_m); })
        .def_prop_ro(
            "normals",
            [](nb::pointer_and_handle<Picture> picture) { return triple_plane(picture, picture.p->normals); })
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
