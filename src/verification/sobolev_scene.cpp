#include "verification/sobolev_scene.h"

#include <algorithm>
#include <cmath>

namespace stilb::verification {
namespace {

using exact::Plane;

/// The smallest power of two for which the bound of the loss at `radius_m` is small enough. The loss grows
/// with the radius.
double half_size_m(const exact::ParallelPlanes& planes, double radius_m) {
    const exact::SobolevProblem problem(planes);
    const auto is_enough = [&](Plane plane, double half_size) {
        return problem.truncation_bound_lx(plane, radius_m, half_size) <=
               kLargestTruncation * problem.illuminance_lx(plane, radius_m);
    };
    double half_size = planes.distance_1_m + planes.distance_2_m;
    while (half_size <= radius_m || !is_enough(Plane::first, half_size) ||
           !is_enough(Plane::second, half_size)) {
        half_size *= 2;
    }
    return half_size;
}

/// A square around the z axis whose cells double in size outwards: where cells are small, so are the
/// distances by which the ray caster lifts points off them.
Mesh graded_square(double z, double smallest_cell_m, double half_size) {
    std::vector<double> grid{0, half_size, -half_size};
    for (double x = smallest_cell_m; x < half_size; x *= 2) grid.insert(grid.end(), {x, -x});
    std::sort(grid.begin(), grid.end());
    const auto n = static_cast<std::uint32_t>(grid.size());
    Mesh mesh;
    for (double y : grid) {
        for (double x : grid) mesh.vertices.push_back({x, y, z});
    }
    for (std::uint32_t j = 0; j + 1 < n; ++j) {
        for (std::uint32_t i = 0; i + 1 < n; ++i) {
            const std::uint32_t corner = j * n + i;
            mesh.triangles.push_back({corner, corner + 1, corner + n + 1});
            mesh.triangles.push_back({corner, corner + n + 1, corner + n});
        }
    }
    return mesh;
}

}  // namespace

Scene make_sobolev_scene(const exact::ParallelPlanes& planes, double largest_radius_m) {
    const double separation_m = planes.distance_1_m + planes.distance_2_m;
    const double half_size = half_size_m(planes, largest_radius_m);
    Scene scene;
    scene.materials = {{"plane 1", Diffuse{Rgb::grey(planes.reflectance_1)}},
                       {"plane 2", Diffuse{Rgb::grey(planes.reflectance_2)}}};
    scene.objects = {{"plane 1", graded_square(0, separation_m, half_size), {MaterialId{0}}},
                     {"plane 2", graded_square(separation_m, separation_m, half_size), {MaterialId{1}}}};
    scene.lights = {{"source", PointLight{{0, 0, planes.distance_1_m}, Rgb::grey(planes.intensity_cd)}}};
    return scene;
}

MeasuringPoint sobolev_point(const exact::ParallelPlanes& planes, Plane plane, double radius_m,
                             double azimuth_rad) {
    const double x = radius_m * std::cos(azimuth_rad), y = radius_m * std::sin(azimuth_rad);
    if (plane == Plane::first) return {{x, y, 0}, {0, 0, 1}};
    return {{x, y, planes.distance_1_m + planes.distance_2_m}, {0, 0, -1}};
}

}  // namespace stilb::verification
