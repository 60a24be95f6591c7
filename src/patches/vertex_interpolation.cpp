
#include "patches/vertex_interpolation.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <unordered_map>

#include "geometry/mesh_topology.h"
#include "math/disjoint_sets.h"

namespace stilb::patches {

namespace {

/// Sums over the patches around a vertex; d is the vector from the vertex to a patch's middle.
struct Surroundings {
    double count = 0;
    Vec3 normal;                 ///< sum of the unit normals
    Vec3 d;                      ///< sum of d
    std::array<Vec3, 3> d_by_d;  ///< sums of d.x d, d.y d, d.z d

    void add(const Vec3& patch_normal, const Vec3& offset) {
        count += 1;
        normal += patch_normal;
        d += offset;
        for (std::size_t axis = 0; axis < 3; ++axis) d_by_d[axis] += offset[axis] * offset;
    }
    double sum_of_products(const Vec3& u, const Vec3& v) const {
        return u.x * dot(d_by_d[0], v) + u.y * dot(d_by_d[1], v) + u.z * dot(d_by_d[2], v);
    }
};

/// A patch's weight: constant + slope . d.
struct Weighting {
    double constant = 0;
    Vec3 slope;
};

Weighting plain_mean(double count) { return {1 / count, {}}; }

/// The weights of the fitted plane's value at the vertex: those with sum w = 1 and sum w d = 0 (along the
/// surface) whose squares have the smallest sum.
Weighting fitted_plane(const Surroundings& around) {
    const Frame frame = Frame::around(normalized(around.normal));
    const double n = around.count, u = dot(frame.u, around.d), v = dot(frame.v, around.d);
    const double uu = around.sum_of_products(frame.u, frame.u), vv = around.sum_of_products(frame.v, frame.v);
    const double uv = around.sum_of_products(frame.u, frame.v);
    const double minor = uu * vv - uv * uv, by_u = v * uv - u * vv, by_v = u * uv - v * uu;
    const double determinant = n * minor + u * by_u + v * by_v;
    constexpr double kSingular = 1e-6;  // patches in a row: no plane
    if (!(determinant > kSingular * n * uu * vv)) return plain_mean(n);
    return {minor / determinant, (by_u / determinant) * frame.u + (by_v / determinant) * frame.v};
}

/// Calls `visit(patch, corner, vertex, offset)` for all corners of all patches; the offset is the vector from
/// the corner to the patch's middle.
template <typename Visitor>
void for_each_corner(const Patches& patches, const Visitor& visit) {
    for (std::uint32_t p = 0; p < patches.count(); ++p) {
        const Vec3 middle = patches.middle(p) - patches.center;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t vertex = patches.corners[p][i];
            visit(p, i, vertex, middle - Vec3(patches.vertices[vertex]));
        }
    }
}

}  // namespace

std::vector<std::vector<VertexInterpolation::Share>> VertexInterpolation::shares_of(
    std::span<const PatchPoint> points) const {
    struct User {
        std::size_t index;
        double weight;  ///< of the vertex
    };
    std::unordered_multimap<std::uint32_t, User> users;  // by vertex
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& [a, b, c] = patches_.corners[points[i].patch];
        const auto& [b0, b1, b2] = points[i].barycentric;
        users.insert({{a, {i, b0}}, {b, {i, b1}}, {c, {i, b2}}});
    }
    std::vector<std::vector<Share>> shares(points.size());
    for (std::uint32_t p = 0; p < patches_.count(); ++p) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto [first, last] = users.equal_range(patches_.corners[p][corner]);
            for (auto user = first; user != last; ++user) {
                shares[user->second.index].push_back({p, user->second.weight * double{weights_[p][corner]}});
            }
        }
    }
    return shares;
}

VertexInterpolation::VertexInterpolation(const Patches& patches)
    : patches_(patches), weights_(patches.count()) {
    std::vector<Surroundings> around(patches.vertices.size());
    for_each_corner(patches, [&](std::uint32_t patch, std::size_t, std::uint32_t vertex, const Vec3& offset) {
        around[vertex].add(Vec3(patches.normals[patch]), offset);
    });
    std::vector<Weighting> weightings(around.size());
    std::ranges::transform(around, weightings.begin(), fitted_plane);
    const auto weight_of = [&](std::uint32_t vertex, const Vec3& offset) {
        return weightings[vertex].constant + dot(weightings[vertex].slope, offset);
    };
    std::vector<bool> extrapolates(around.size());
    for_each_corner(patches, [&](std::uint32_t, std::size_t, std::uint32_t vertex, const Vec3& offset) {
        if (weight_of(vertex, offset) < 0) extrapolates[vertex] = true;
    });
    for (std::size_t v = 0; v < around.size(); ++v) {
        if (extrapolates[v]) weightings[v] = plain_mean(around[v].count);
    }
    for_each_corner(patches,
                    [&](std::uint32_t patch, std::size_t i, std::uint32_t vertex, const Vec3& offset) {
                        weights_[patch][i] = static_cast<float>(weight_of(vertex, offset));
                    });
}

namespace {

/// Corners of triangles are numbered 3 triangle + index.
std::uint32_t corner_at(std::span<const Triangle> triangles, std::uint32_t triangle, std::uint32_t vertex) {
    const Triangle& corners = triangles[triangle];
    return 3 * triangle + static_cast<std::uint32_t>(std::ranges::find(corners, vertex) - corners.begin());
}

geometry::Edges edges_of(std::span<const Triangle> triangles) {
    std::uint32_t vertices = 0;
    for (const Triangle& t : triangles) vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
    std::vector<std::uint32_t> itself(vertices);
    std::iota(itself.begin(), itself.end(), 0u);
    return {triangles, std::move(itself)};
}

}  // namespace

SmoothVertices divide_at_creases(std::span<const Triangle> triangles, std::span<const Vec3> normals,
                                 std::span<const MaterialId> materials) {
    const double least_cosine = std::cos(kCreaseAngle_deg * std::numbers::pi / 180);
    const auto is_smooth = [&](const geometry::EdgeUse& a, const geometry::EdgeUse& b) {
        return a.upwards != b.upwards && materials[a.triangle] == materials[b.triangle] &&
               dot(normals[a.triangle], normals[b.triangle]) >= least_cosine;
    };
    math::DisjointSets corners(3 * triangles.size());
    edges_of(triangles).for_each([&](auto first, auto last) {
        if (last - first != 2 || !is_smooth(first[0], first[1])) return;
        for (const std::uint32_t vertex : {first->low, first->high}) {
            corners.join(corner_at(triangles, first[0].triangle, vertex),
                         corner_at(triangles, first[1].triangle, vertex));
        }
    });
    const auto [vertex_of_corner, count] = std::move(corners).numbered();
    SmoothVertices smooth{std::vector<Triangle>(triangles.size()), std::vector<std::uint32_t>(count)};
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t vertex = vertex_of_corner[3 * t + i];
            smooth.triangles[t][i] = vertex;
            smooth.original[vertex] = triangles[t][i];
        }
    }
    return smooth;
}

}  // namespace stilb::patches
