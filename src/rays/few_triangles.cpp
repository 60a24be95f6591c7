#include "rays/few_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vec.h"

namespace stilb::rays {
namespace {

using Vector = TestedTriangle::Vector;
using Floats = RayPacket::Floats;
using Words = RayPacket::Words;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Rays in Pluecker coordinates.
struct alignas(64) Lines {
    LaneVectors direction, moment;
    Floats reach;  ///< |direction| times the sum of |origin| and the radius, or more
};

/// A triangle through which some lines pass.
struct alignas(64) Crossed {
    Floats u, v, w;  ///< barycentric coordinates of the second, third and first corner, up to a factor
    LaneMask is_inside;
    std::uint32_t number;
};
using AllCrossed = std::array<Crossed, FewTriangles::kMost>;

struct alignas(64) Nearest {
    Floats end;
    Words crossed;  ///< the index of the triangle among those that are crossed
};

STILB_INLINED float dot(const Vector& v, float x, float y, float z) { return v[0] * x + v[1] * y + v[2] * z; }

STILB_VECTORIZED void find_lines(const RayPacket& __restrict rays, float radius_m, Lines& __restrict lines) {
    for (int i = 0; i < kPacketWidth; ++i) {
        const float x = rays.origin_x[i], y = rays.origin_y[i], z = rays.origin_z[i];
        const float dx = rays.direction_x[i], dy = rays.direction_y[i], dz = rays.direction_z[i];
        lines.direction.x[i] = dx, lines.direction.y[i] = dy, lines.direction.z[i] = dz;
        lines.moment.x[i] = y * dz - z * dy;
        lines.moment.y[i] = z * dx - x * dz;
        lines.moment.z[i] = x * dy - y * dx;
        lines.reach[i] = (std::abs(dx) + std::abs(dy) + std::abs(dz)) *
                         (std::abs(x) + std::abs(y) + std::abs(z) + radius_m);
    }
}

STILB_INLINED float product(const TestedTriangle::Edge& edge, const Lines& lines, int i) {
    return edge.moment[0] * lines.direction.x[i] + edge.moment[1] * lines.direction.y[i] +
           edge.moment[2] * lines.direction.z[i] + edge.direction[0] * lines.moment.x[i] +
           edge.direction[1] * lines.moment.y[i] + edge.direction[2] * lines.moment.z[i];
}

Vec3 wide(const Vector& v) { return {v[0], v[1], v[2]}; }
Vector narrow(const Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Finds in double precision which of the lanes that may be inside are, and returns whether any is. Not
/// inlined, because few triangles need it.
[[gnu::noinline]] std::int32_t settle(const TestedTriangle& triangle, const RayPacket& rays,
                                      Crossed& crossed) {
    const std::array<Vec3, 3> corners{wide(triangle.corners[0]), wide(triangle.corners[1]),
                                      wide(triangle.corners[2])};
    std::int32_t any = 0;
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        if (crossed.is_inside[i] == 0) continue;
        const EdgeProducts products =
            edge_products(corners, {rays.origin_x[i], rays.origin_y[i], rays.origin_z[i]},
                          {rays.direction_x[i], rays.direction_y[i], rays.direction_z[i]});
        crossed.u[i] = static_cast<float>(products.u), crossed.v[i] = static_cast<float>(products.v);
        crossed.w[i] = static_cast<float>(products.w);
        crossed.is_inside[i] = products.are_inside() ? 1 : 0;
        any |= crossed.is_inside[i];
    }
    return any;
}

/// Returns their number. Without branches that could not be predicted.
STILB_VECTORIZED std::size_t find_crossed(const TestedTriangle* __restrict triangles, std::size_t count,
                                          const RayPacket& rays, const LaneMask& __restrict lanes,
                                          const Lines& __restrict lines, AllCrossed& __restrict all) {
    constexpr std::int32_t may_be_inside = 1, is_unsure = 2;
    std::size_t found = 0;
    for (std::size_t n = 0; n < count; ++n) {
        const TestedTriangle& triangle = triangles[n];
        Crossed& crossed = all[found];
        std::int32_t any = 0;
        for (int i = 0; i < kPacketWidth; ++i) {
            const float u = product(triangle.edges[0], lines, i);
            const float v = product(triangle.edges[1], lines, i);
            const float w = product(triangle.edges[2], lines, i);
            const float rounding = triangle.rounding_m * lines.reach[i];
            // How far inside the line passes, on either side of the triangle.
            const float inside = std::max(std::min(std::min(u, v), w), -std::max(std::max(u, v), w));
            const std::int32_t in_it = inside >= -rounding ? lanes[i] & may_be_inside : 0;
            crossed.u[i] = u, crossed.v[i] = v, crossed.w[i] = w;
            crossed.is_inside[i] = in_it;
            any |= inside > rounding ? in_it : in_it * is_unsure;
        }
        if ((any & is_unsure) != 0) any = settle(triangle, rays, crossed);
        crossed.number = static_cast<std::uint32_t>(n);
        found += static_cast<std::size_t>(any);
    }
    return found;
}

/// In units of the ray's direction; infinite or not a number along the triangle.
STILB_INLINED float distance(const TestedTriangle& triangle, const RayPacket& rays, int i) {
    const Vector& corner = triangle.corners[0];
    const float height = dot(triangle.normal, corner[0] - rays.origin_x[i], corner[1] - rays.origin_y[i],
                             corner[2] - rays.origin_z[i]);
    return height / dot(triangle.normal, rays.direction_x[i], rays.direction_y[i], rays.direction_z[i]);
}

/// `index`: of `crossed` among all.
STILB_VECTORIZED void keep_nearest(const TestedTriangle& __restrict triangle,
                                   const Crossed& __restrict crossed, std::uint32_t index,
                                   const RayPacket& __restrict rays, Nearest& __restrict nearest) {
    for (int i = 0; i < kPacketWidth; ++i) {
        // Read in any case, so that the loop vectorises without masked memory accesses.
        const float t = distance(triangle, rays, i), end = nearest.end[i];
        const std::uint32_t old = nearest.crossed[i];
        const bool is_nearer = (static_cast<int>(crossed.is_inside[i] != 0) &
                                static_cast<int>(t >= rays.start[i]) & static_cast<int>(t < end)) != 0;
        nearest.end[i] = is_nearer ? t : end;
        nearest.crossed[i] = is_nearer ? index : old;
    }
}

/// Unsets `open` where rays meet the triangle.
STILB_VECTORIZED void keep_open(const TestedTriangle& __restrict triangle, const Crossed& __restrict crossed,
                                const RayPacket& __restrict rays, LaneMask& __restrict open) {
    for (int i = 0; i < kPacketWidth; ++i) {
        const float t = distance(triangle, rays, i);
        const int meets = static_cast<int>(crossed.is_inside[i] != 0) & static_cast<int>(t >= rays.start[i]) &
                          static_cast<int>(t <= rays.end[i]);
        open[i] &= meets - 1;
    }
}

}  // namespace

// Not inlined: the versions of a calling function may fuse multiplications and additions, which would round
// differently by the order of an edge's ends.
[[gnu::noinline]] EdgeProducts edge_products(const std::array<Vec3, 3>& corners, const Vec3& origin,
                                             const Vec3& direction) {
    const Vec3 a = corners[0] - origin, b = corners[1] - origin, c = corners[2] - origin;
    return {stilb::dot(cross(c, a), direction), stilb::dot(cross(a, b), direction),
            stilb::dot(cross(b, c), direction)};
}

void FewTriangles::add(std::uint32_t object, std::uint32_t primitive, const std::array<Vector, 3>& corners) {
    // Each product is a sum of six terms, of which the ray's moment has the largest error: some ten roundings
    // of 2^-24, and single precision for the bound itself.
    constexpr double rounding_error = 0x1p-20;
    const std::array<Vec3, 3> p{wide(corners[0]), wide(corners[1]), wide(corners[2])};
    TestedTriangle& triangle = triangles_.emplace_back();
    double longest_m = 0, farthest_m = radius_m_;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &from = p[i], &to = p[(i + 2) % 3];
        triangle.edges[i] = {narrow(from - to), narrow(cross(to, from))};
        longest_m = std::max(longest_m, length(to - from));
        farthest_m = std::max(farthest_m, length(from));
    }
    triangle.corners = corners;
    triangle.normal = narrow(normalized(cross(p[1] - p[0], p[2] - p[0])));
    triangle.rounding_m = static_cast<float>(rounding_error * longest_m * farthest_m / radius_m_);
    triangle.object = object, triangle.primitive = primitive;
}

bool FewTriangles::are_faster(const LaneMask& lanes) const {
    std::int32_t rays = 0;
    for (const std::int32_t lane : lanes) rays -= lane;
    return triangles_.size() * kPacketWidth <= kMost * static_cast<std::size_t>(rays);
}

void FewTriangles::closest(RayHitPacket& packet, const LaneMask& lanes) const {
    Lines lines;
    find_lines(packet.ray, static_cast<float>(radius_m_), lines);
    AllCrossed crossed;
    const std::size_t count =
        find_crossed(triangles_.data(), triangles_.size(), packet.ray, lanes, lines, crossed);
    Nearest nearest;
    for (std::size_t i = 0; i < kPacketWidth; ++i)
        nearest.end[i] = lanes[i] != 0 ? packet.ray.end[i] : -kInfinity;
    for (std::uint32_t n = 0; n < count; ++n)
        keep_nearest(triangles_[crossed[n].number], crossed[n], n, packet.ray, nearest);
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        packet.object[i] = kNothing;
        if (lanes[i] == 0 || !(nearest.end[i] < packet.ray.end[i])) continue;
        const Crossed& met = crossed[nearest.crossed[i]];
        const float inverse = 1 / (met.u[i] + met.v[i] + met.w[i]);
        packet.u[i] = inverse * met.u[i], packet.v[i] = inverse * met.v[i];
        packet.ray.end[i] = nearest.end[i];
        const TestedTriangle& triangle = triangles_[met.number];
        packet.object[i] = triangle.object, packet.primitive[i] = triangle.primitive;
        const auto& [x, y, z] = triangle.normal;
        packet.normal_x[i] = x, packet.normal_y[i] = y, packet.normal_z[i] = z;
    }
}

void FewTriangles::occlude(RayPacket& packet, const LaneMask& lanes) const {
    Lines lines;
    find_lines(packet, static_cast<float>(radius_m_), lines);
    AllCrossed crossed;
    const std::size_t count =
        find_crossed(triangles_.data(), triangles_.size(), packet, lanes, lines, crossed);
    LaneMask open = lanes;
    for (std::size_t n = 0; n < count; ++n)
        keep_open(triangles_[crossed[n].number], crossed[n], packet, open);
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        if (open[i] != lanes[i]) packet.end[i] = -kInfinity;
    }
}

}  // namespace stilb::rays
