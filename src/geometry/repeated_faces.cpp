#include "geometry/repeated_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/vec.h"
#include "geometry/mesh_topology.h"

namespace stilb::geometry {
namespace {

using Corners = std::array<Vec3, 3>;

Vec3 normal_of(const Corners& t) { return cross(t[1] - t[0], t[2] - t[0]); }

bool have_one_front(const Corners& a, const Corners& b) {
    constexpr double same_cosine = 1 - 1e-9;
    const Vec3 first = normal_of(a), second = normal_of(b);
    return dot(first, second) > same_cosine * length(first) * length(second);
}

/// Whether the triangle has the point of its plane, its edges included.
bool covers(const Corners& t, const Vec3& point) {
    constexpr double rounding = 1e-6;
    const Vec3 normal = normal_of(t);
    const double doubled_area = squared_length(normal);
    const Vec3 towards = point - t[0];
    if (std::abs(dot(towards, normal)) > rounding * doubled_area / std::sqrt(std::sqrt(doubled_area)))
        return false;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 side = cross(t[(i + 1) % 3] - t[i], point - t[i]);
        if (dot(side, normal) < -rounding * doubled_area) return false;
    }
    return true;
}

/// The middles of a triangle's sixteen equal parts.
std::vector<Vec3> points_within(const Corners& t) {
    constexpr int parts = 4;
    std::vector<Vec3> points;
    const auto add = [&](double i, double j) {
        points.push_back(t[0] + (i / parts) * (t[1] - t[0]) + (j / parts) * (t[2] - t[0]));
    };
    for (int i = 0; i < parts; ++i) {
        for (int j = 0; i + j < parts; ++j) {
            add(i + 1. / 3, j + 1. / 3);
            if (i + j + 1 < parts) add(i + 2. / 3, j + 2. / 3);
        }
    }
    return points;
}

}  // namespace

std::vector<RepeatedFace> repeated_faces(const Mesh& mesh, std::span<const std::uint32_t> triangles) {
    const std::vector<std::uint32_t> vertex_at = welded(mesh.vertices);
    std::vector<std::vector<std::uint32_t>> kept_at(mesh.vertices.size());  // by welded vertex
    std::vector<RepeatedFace> repeated;
    for (const std::uint32_t t : triangles) {
        const Corners corners = mesh.corners_of(t);
        std::vector<std::uint32_t> near;
        for (const std::uint32_t v : mesh.triangles[t]) {
            for (const std::uint32_t other : kept_at[vertex_at[v]]) {
                if (have_one_front(corners, mesh.corners_of(other))) near.push_back(other);
            }
        }
        std::optional<std::uint32_t> original;
        const auto is_covered = [&](const Vec3& point) {
            const auto there = std::ranges::find_if(
                near, [&](std::uint32_t other) { return covers(mesh.corners_of(other), point); });
            if (there == near.end()) return false;
            if (!original) original = *there;
            return true;
        };
        if (!near.empty() && std::ranges::all_of(points_within(corners), is_covered)) {
            repeated.push_back({t, *original});
            continue;
        }
        for (const std::uint32_t v : mesh.triangles[t]) kept_at[vertex_at[v]].push_back(t);
    }
    return repeated;
}

std::vector<RepeatedFace> repeated_faces(const Mesh& mesh) {
    std::vector<std::uint32_t> all(mesh.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    return repeated_faces(mesh, all);
}

}  // namespace stilb::geometry
