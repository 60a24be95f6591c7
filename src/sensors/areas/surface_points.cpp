#include "sensors/areas/surface_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/mesh_topology.h"
#include "math/disjoint_sets.h"
#include "sensors/areas/raster.h"

namespace stilb::sensors {
namespace {

Vec3 area_vector(const std::array<Vec3, 3>& t) { return cross(t[1] - t[0], t[2] - t[0]) / 2; }

std::array<Vec3, 3> corners_of(const Mesh& mesh, std::size_t triangle) {
    const auto [a, b, c] = mesh.triangles[triangle];
    return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}

/// Six times the volume that the fronts enclose, for each component; above 0 where they face outwards.
std::vector<double> volumes(const Mesh& mesh, const geometry::ConnectedComponents& components) {
    std::vector<double> sums(components.count());
    const Vec3& origin = mesh.vertices.front();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = corners_of(mesh, t);
        sums[components.of_triangle[t]] += dot(a - origin, cross(b - origin, c - origin));
    }
    return sums;
}

/// A coordinate system in the plane of a face, along its longest edge, and the face's extent in it.
struct PlaneExtent {
    Vec3 u, v;
    double least_u = std::numeric_limits<double>::infinity(), least_v = least_u, most_u = -least_u,
           most_v = -least_u;

    double width_m() const { return most_u - least_u; }
    double height_m() const { return most_v - least_v; }
};

/// The longest edge that belongs to one triangle only.
Vec3 longest_edge(const PlaneFace& face) {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    for (const auto& corners : face.triangles) {
        const auto first = static_cast<std::uint32_t>(vertices.size());
        vertices.insert(vertices.end(), corners.begin(), corners.end());
        triangles.push_back({first, first + 1, first + 2});
    }
    Vec3 longest;
    geometry::Edges(triangles, geometry::welded(vertices)).for_each([&](auto first, auto last) {
        const Vec3 edge = vertices[first->high] - vertices[first->low];
        constexpr double rounding = 1e-9;
        if (last - first == 1 && length(edge) > length(longest) * (1 + rounding)) longest = edge;
    });
    return longest;
}

PlaneExtent plane_extent_of(const PlaneFace& face) {
    PlaneExtent extent;
    const Vec3 edge = longest_edge(face);
    extent.u = normalized(edge - dot(edge, face.normal) * face.normal);
    extent.v = cross(face.normal, extent.u);
    for (const auto& corners : face.triangles) {
        for (const Vec3& corner : corners) {
            const double u = dot(corner, extent.u), v = dot(corner, extent.v);
            extent.least_u = std::min(extent.least_u, u);
            extent.most_u = std::max(extent.most_u, u);
            extent.least_v = std::min(extent.least_v, v);
            extent.most_v = std::max(extent.most_v, v);
        }
    }
    return extent;
}

bool covers(const PlaneFace& face, const Vec3& point) {
    return std::ranges::any_of(face.triangles, [&](const std::array<Vec3, 3>& t) {
        const Vec3 front = area_vector(t);
        const auto is_left = [&](const Vec3& from, const Vec3& to) {
            return dot(cross(to - from, point - from), front) >= 0;
        };
        return is_left(t[0], t[1]) && is_left(t[1], t[2]) && is_left(t[2], t[0]);
    });
}

std::vector<MeasuringPoint> points_on(const PlaneFace& face, const PlaneExtent& extent, double spacing_m) {
    const double nu = cells_along(extent.width_m(), spacing_m),
                 nv = cells_along(extent.height_m(), spacing_m);
    // The origin of u and v, in the face's plane.
    const Vec3 origin = dot(face.triangles[0][0], face.normal) * face.normal;
    std::vector<MeasuringPoint> points;
    for (double row = 0; row < nv; ++row) {
        for (double column = 0; column < nu; ++column) {
            const double u = extent.least_u + (column + 0.5) / nu * extent.width_m(),
                         v = extent.least_v + (row + 0.5) / nv * extent.height_m();
            const Vec3 point = origin + u * extent.u + v * extent.v;
            if (covers(face, point)) points.push_back({point, face.normal});
        }
    }
    return points;
}

}  // namespace

std::vector<PlaneFace> plane_faces(const Mesh& mesh) {
    if (mesh.triangles.empty()) return {};
    constexpr double same_plane = 1 - 1e-9;  // cosine of the angle between normals
    math::DisjointSets sets(mesh.triangles.size());
    const auto normal_of = [&](std::size_t t) { return normalized(area_vector(corners_of(mesh, t))); };
    geometry::Edges(mesh).for_each([&](auto first, auto last) {
        for (auto other = first; ++other != last;) {
            if (dot(normal_of(first->triangle), normal_of(other->triangle)) > same_plane)
                sets.join(first->triangle, other->triangle);
        }
    });
    const geometry::ConnectedComponents components = geometry::find_components(mesh);
    const std::vector<double> volume = volumes(mesh, components);
    const auto [face_of, count] = std::move(sets).numbered();
    std::vector<PlaneFace> faces(count);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        PlaneFace& face = faces[face_of[t]];
        const std::array<Vec3, 3> corners = corners_of(mesh, t);
        const std::uint32_t component = components.of_triangle[t];
        const bool is_turned = components.is_closed(component) && volume[component] > 0;
        face.triangles.push_back(corners);
        face.normal = is_turned ? -normal_of(t) : normal_of(t);
        face.area_m2 += length(area_vector(corners));
    }
    return faces;
}

bool is_of_part(const PlaneFace& face, SurfacePart part) {
    const double steep = std::sqrt(0.5);
    switch (part) {
        case SurfacePart::all:
            return true;
        case SurfacePart::walls:
            return std::abs(face.normal.z) < steep;
        case SurfacePart::ceiling:
            return face.normal.z <= -steep;
        case SurfacePart::floor:
            return face.normal.z >= steep;
    }
    return false;
}

std::optional<Fault> place_on(std::span<const PlaneFace> faces, Area& area) {
    const PlaneFace& largest = *std::ranges::max_element(faces, {}, &PlaneFace::area_m2);
    const PlaneExtent extent_of_largest = plane_extent_of(largest);
    const auto [short_m, long_m] = std::minmax({extent_of_largest.width_m(), extent_of_largest.height_m()});
    const double spacing_m = area.spacing_m.value_or(raster_spacing_m(short_m, long_m));
    area.cell_m = {extent_of_largest.width_m() / cells_along(extent_of_largest.width_m(), spacing_m),
                   extent_of_largest.height_m() / cells_along(extent_of_largest.height_m(), spacing_m)};
    double all_m2 = 0;
    for (const PlaneFace& face : faces) {
        all_m2 += face.area_m2;
        if (all_m2 / (spacing_m * spacing_m) > static_cast<double>(kMostReadings)) {
            return Fault{
                area.spacing_m ? "spacing" : "object",
                fmt::format("asks for more than {} points. Allowed: a larger spacing.", kMostReadings)};
        }
        const PlaneExtent extent = plane_extent_of(face);
        std::vector<MeasuringPoint> points = points_on(face, extent, spacing_m);
        const bool is_narrow = std::min(extent.width_m(), extent.height_m()) < spacing_m / 2;
        const double points_with_half =
            static_cast<double>(area.points.size()) + static_cast<double>(points.size()) / 2;
        if (is_narrow && points_with_half * spacing_m * spacing_m > all_m2) continue;
        area.points.insert(area.points.end(), points.begin(), points.end());
    }
    return std::nullopt;
}

}  // namespace stilb::sensors
