// Files of other programs: exports, points, and series fitted to meshes.
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "bindings/parts.h"
#include "fit/mesh_fit.h"
#include "io/import/rtrace.h"
#include "io/mesh/harmonics_file.h"
#include "io/mesh/mesh_file.h"
#include "math/spherical_harmonics.h"
#include "stilb/scene.h"

namespace stilb::api::bindings {

namespace nb = nanobind;

namespace {

std::array<double, 3> triple(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Positions and normals.
using Points = std::vector<std::array<std::array<double, 3>, 2>>;

Points read_points(const std::filesystem::path& path) {
    Points points;
    const Sensor sensor = io::read_points(path);
    for (const auto& [position, normal] : std::get<IlluminancePoints>(sensor.kind).points)
        points.push_back({triple(position), triple(normal)});
    return points;
}

fit::MeshFit fit_mesh(const std::filesystem::path& mesh, const std::filesystem::path& output, int degree,
                      const std::optional<std::array<double, 3>>& center, double tolerance, bool force) {
    const fit::MeshFitOptions options{
        .degree = degree,
        .center = center ? std::optional(Vec3{(*center)[0], (*center)[1], (*center)[2]}) : std::nullopt,
        .tolerated_share = tolerance,
        .otherwise = force ? fit::NotStarShaped::take_outermost : fit::NotStarShaped::refuse};
    fit::MeshFit fit = fit::fit_mesh(io::read_mesh_file(mesh).mesh, options, mesh.string());
    io::write_harmonics(
        {fit.coefficients, fit.center, mesh.filename().string(), fit.errors.back().rms / fit.size}, output);
    return fit;
}

void add_fits(nb::module_& module) {
    nb::class_<fit::MeshFit>(module, "MeshFit")
        .def_ro("size", &fit::MeshFit::size)
        .def_prop_ro("center", [](const fit::MeshFit& fit) { return triple(fit.center); })
        .def_ro("open_edges", &fit::MeshFit::open_edges)
        .def_prop_ro("folded_share", [](const fit::MeshFit& fit) { return fit.survey.folded_share; })
        .def_prop_ro("missed_share", [](const fit::MeshFit& fit) { return fit.survey.missed_share; })
        .def_prop_ro("errors", [](const fit::MeshFit& fit) {
            std::vector<std::array<double, 2>> errors;
            for (const geometry::DegreeError& error : fit.errors)
                errors.push_back({error.rms, error.maximum});
            return errors;
        });
    module.attr("most_degree") = math::kMostHarmonicDegree;
    module.def("fit_mesh", &fit_mesh, nb::arg("mesh"), nb::arg("output"), nb::arg("degree"),
               nb::arg("center").none(), nb::arg("tolerance"), nb::arg("force"),
               nb::call_guard<nb::gil_scoped_release>());
}

}  // namespace

void add_files(nb::module_& module) {
    nb::class_<Export>(module, "Export")
        .def_ro("files", &Export::files)
        .def_ro("warnings", &Export::warnings);
    module.def("export_scene", &export_scene, nb::arg("scene"), nb::arg("format"), nb::arg("folder"),
               nb::call_guard<nb::gil_scoped_release>());
    module.def("read_points", &read_points, nb::arg("path"));
    add_fits(module);
}

}  // namespace stilb::api::bindings
