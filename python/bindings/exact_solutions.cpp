// The problems with known answers of exact/, number by number; stilb/exact.py takes arrays.
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <vector>

#include "bindings/parts.h"
#include "exact/closed_rooms.h"
#include "exact/configuration_factors.h"
#include "exact/diffuse_cube.h"
#include "exact/sobolev.h"

namespace stilb::api::bindings {

namespace nb = nanobind;

namespace {

using Point = std::array<double, 3>;

Vec3 vector(const Point& p) { return {p[0], p[1], p[2]}; }
exact::Receiver receiver(const Point& position, const Point& normal) {
    return {vector(position), vector(normal)};
}
exact::Plane plane(int number) { return number == 1 ? exact::Plane::first : exact::Plane::second; }

void add_closed_rooms(nb::module_& module) {
    module.def("furnace_luminance", &exact::furnace_luminance_cd_m2);
    module.def("furnace_illuminance", &exact::furnace_illuminance_lx);
    module.def("sphere_indirect", [](double radius, double reflectance, double flux) {
        return exact::indirect_illuminance_lx({radius, reflectance}, flux);
    });
    module.def("sphere_illuminance",
               [](double radius, double reflectance, double flux, const Point& source, const Point& to_wall) {
                   return exact::illuminance_lx({radius, reflectance}, flux, vector(source), vector(to_wall));
               });
    module.def("coaxial_disk_form_factors", [](double radius_1, double radius_2, double distance) {
        return exact::coaxial_disk_form_factors(radius_1, radius_2, distance).from_to;
    });
    module.def("concentric_sphere_form_factors", [](double inner_radius, double outer_radius) {
        return exact::concentric_sphere_form_factors(inner_radius, outer_radius).from_to;
    });
    module.def("two_surface_illuminance",
               [](const std::array<double, 2>& emitted, const std::array<double, 2>& reflectances,
                  const std::array<std::array<double, 2>, 2>& form_factors) {
                   return exact::two_surface_illuminance_lx(
                       {{{emitted[0], reflectances[0]}, {emitted[1], reflectances[1]}}}, {form_factors});
               });
    module.def("pane_transmittance", [](double ior, double internal_transmittance, double angle_rad) {
        return exact::pane_transmittance({ior, internal_transmittance}, angle_rad);
    });
}

void add_configuration_factors(nb::module_& module) {
    module.def(
        "by_point", [](const Point& position, const Point& normal, const Point& source, double intensity) {
            return exact::illuminance_by_point_lx(receiver(position, normal), vector(source), intensity);
        });
    module.def("by_polygon", [](const Point& position, const Point& normal,
                                const std::vector<Point>& vertices, double luminance) {
        std::vector<Vec3> corners;
        for (const Point& vertex : vertices) corners.push_back(vector(vertex));
        return exact::illuminance_by_polygon_lx(receiver(position, normal), corners, luminance);
    });
    module.def("by_disk", [](const Point& position, const Point& normal, const Point& center,
                             const Point& disk_normal, double radius, double luminance) {
        return exact::illuminance_by_disk_lx(receiver(position, normal),
                                             {vector(center), vector(disk_normal), radius}, luminance);
    });
    module.def("by_sphere", [](const Point& position, const Point& normal, const Point& center, double radius,
                               double luminance) {
        return exact::illuminance_by_sphere_lx(receiver(position, normal), vector(center), radius, luminance);
    });
}

}  // namespace

void add_exact_solutions(nb::module_& module) {
    add_closed_rooms(module);
    add_configuration_factors(module);
    nb::class_<exact::SobolevProblem>(module, "SobolevProblem")
        .def("__init__",
             [](exact::SobolevProblem* problem, const std::array<double, 2>& reflectances,
                const std::array<double, 2>& distances, double intensity) {
                 new (problem) exact::SobolevProblem(
                     {reflectances[0], reflectances[1], distances[0], distances[1], intensity});
             })
        .def("direct", [](const exact::SobolevProblem& problem, int number,
                          double radius) { return problem.direct_illuminance_lx(plane(number), radius); })
        .def("indirect", [](const exact::SobolevProblem& problem, int number,
                            double radius) { return problem.indirect_illuminance_lx(plane(number), radius); })
        .def("total", [](const exact::SobolevProblem& problem, int number, double radius) {
            return problem.illuminance_lx(plane(number), radius);
        });
    nb::class_<exact::DiffuseCube>(module, "DiffuseCube")
        .def(nb::init<double, double>())
        .def("direct", &exact::DiffuseCube::direct_illuminance_lx)
        .def("indirect", &exact::DiffuseCube::indirect_illuminance_lx)
        .def("mean", &exact::DiffuseCube::mean_illuminance_lx);
}

}  // namespace stilb::api::bindings
