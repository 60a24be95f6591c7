// measure(), render(), solve() and their kin.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <span>

#include "bindings/called_run.h"
#include "bindings/parts.h"
#include "bindings/states.h"
#include "stilb/measure.h"
#include "stilb/render.h"

namespace stilb::api::bindings {

namespace nb = nanobind;

namespace {

/// Positions and directions side by side.
using Rays = nb::ndarray<const double, nb::shape<-1, 6>, nb::c_contig, nb::device::cpu>;

std::span<const Ray> rays_of(const Rays& rays) {
    static_assert(sizeof(Ray) == 6 * sizeof(double));
    return {reinterpret_cast<const Ray*>(rays.data()), rays.shape(0)};
}

template <auto measure_rays>
Result measure_along(const Scene& scene, const Rays& rays, const Options& options, nb::object progress) {
    return CalledRun(std::move(progress))(
        [&](const Control& control) { return measure_rays(scene, rays_of(rays), options, control); });
}

}  // namespace

void add_runs(nb::module_& module) {
    nb::class_<Progress>(module, "Progress", "The progress of a run, as functions of progress get it.")
        .def_ro("stage", &Progress::stage, "The stage of the preparation; empty while samples are drawn.")
        .def_ro("elapsed_s", &Progress::elapsed_s)
        .def_ro("remaining_s", &Progress::remaining_s, "Estimated; infinite where it is not known.")
        .def_ro("error", &Progress::attained_error, "Relative; infinite before the first estimate.");

    module.def(
        "measure",
        [](const Scene& scene, const Options& options, const std::vector<std::string>& sensors,
           nb::object progress) {
            return CalledRun(std::move(progress))(
                [&](const Control& control) { return measure(scene, options, control, sensors); });
        },
        nb::arg("scene"), nb::arg("options"), nb::arg("sensors"), nb::arg("progress").none());
    module.def("illuminance", &measure_along<&illuminance>, nb::arg("scene"), nb::arg("rays"),
               nb::arg("options"), nb::arg("progress").none());
    module.def("luminance", &measure_along<&luminance>, nb::arg("scene"), nb::arg("rays"), nb::arg("options"),
               nb::arg("progress").none());
    module.def(
        "render",
        [](const Scene& scene, const std::string& camera, const Options& options, nb::object progress) {
            return CalledRun(std::move(progress))(
                [&](const Control& control) { return render(scene, camera, options, control); });
        },
        nb::arg("scene"), nb::arg("camera"), nb::arg("options"), nb::arg("progress").none());
    module.def(
        "solve",
        [](const Scene& scene, const Options& options, nb::object progress, std::optional<int> degree) {
            return CalledRun(std::move(progress))(
                [&](const Control& control) { return solve(scene, options, control, degree); });
        },
        nb::arg("scene"), nb::arg("options"), nb::arg("progress").none(), nb::arg("degree").none());

    nb::class_<Solution>(module, "Solution")
        .def_static("load", &Solution::load, nb::arg("path"), nb::call_guard<nb::gil_scoped_release>())
        .def("state",
             [](const Solution& solution) {
                 const std::string bytes = stored(solution);
                 return std::pair{state_of(solution.summary()), nb::bytes(bytes.data(), bytes.size())};
             })
        .def_static(
            "restored",
            [](const Scene& scene, const std::pair<SummaryState, nb::bytes>& state) {
                const auto& [summary, bytes] = state;
                return restored_solution(scene, restored(summary), {bytes.c_str(), bytes.size()});
            },
            nb::arg("scene"), nb::arg("state"))
        .def("scene", [](const Solution& solution) { return solution.data().scene; })
        .def("summary", &Solution::summary)
        .def("lights", &Solution::lights)
        .def("save", &Solution::save, nb::arg("path"), nb::call_guard<nb::gil_scoped_release>())
        .def(
            "render",
            [](const Solution& solution, const std::string& camera,
               const std::map<std::string, Triple>& factors, nb::object progress) {
                return CalledRun(std::move(progress))(
                    [&](const Control& control) { return solution.render(camera, control, factors); });
            },
            nb::arg("camera"), nb::arg("factors"), nb::arg("progress").none());
}

}  // namespace stilb::api::bindings
