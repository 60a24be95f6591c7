#include "geometry/shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/vec.h"
#include "geometry/harmonics/cells.h"
#include "geometry/harmonics/surface.h"

namespace stilb::geometry {
namespace {

/// Of a mesh or an instance.
template <typename Triangles>
double area_of_triangles(const Triangles& shape, std::size_t count) {
    double sum = 0;
    for (std::size_t t = 0; t < count; ++t) {
        const auto [a, b, c] = shape.corners_of(t);
        sum += triangle_area_m2(a, b, c);
    }
    return sum;
}

double area(const Mesh& mesh) { return area_of_triangles(mesh, mesh.triangles.size()); }
double area(const Instance& instance) { return area_of_triangles(instance, instance.mesh->triangles.size()); }

double area(const Rectangle& r) { return length(cross(r.edge_u, r.edge_v)); }

double area(const Box& box) {
    const Vec3 e = box.max - box.min;
    return 2 * (e.x * e.y + e.y * e.z + e.z * e.x);
}

double area(const Sphere& s) { return 4 * std::numbers::pi * s.radius * s.radius; }

double area(const Disk& d) { return std::numbers::pi * d.radius * d.radius; }

double area(const Harmonics& h) { return h.scale * h.scale * h.area->total(); }

Bounds bounds(const Mesh& mesh) {
    Bounds all;
    for (const Vec3& vertex : mesh.vertices) all.include(vertex);
    return all;
}
Bounds bounds(const Instance& instance) {
    Bounds all;
    for (const Vec3& vertex : instance.mesh->vertices) all.include(instance.to_world.point(vertex));
    return all;
}
Bounds bounds(const Rectangle& r) { return bounds(triangulated(r)); }
Bounds bounds(const Box& box) { return {box.min, box.max}; }
Bounds bounds(const Sphere& s) {
    const Vec3 r{s.radius, s.radius, s.radius};
    return {s.center - r, s.center + r};
}

Bounds bounds(const Disk& d) {
    // The extent of a circle along an axis is its radius times the sine of the angle between axis and normal.
    const auto extent = [&](double n) { return d.radius * std::sqrt(std::max(0.0, 1 - n * n)); };
    const Vec3 e{extent(d.normal.x), extent(d.normal.y), extent(d.normal.z)};
    return {d.center - e, d.center + e};
}

/// The extent of sample points, so dense that it is little smaller than the true one.
Bounds bounds(const Harmonics& h) {
    constexpr int count = 4096;
    Bounds all;
    for (int i = 0; i < count; ++i) {  // a spiral over the sphere
        const double z = 1 - (2 * i + 1.0) / count, radius = std::sqrt(1 - z * z);
        const double angle = 2 * std::numbers::pi * i / std::numbers::phi;
        all.include(h.point_towards({radius * std::cos(angle), radius * std::sin(angle), z}));
    }
    return all;
}

}  // namespace

std::array<Vec3, 3> Instance::corners_of(std::size_t triangle) const {
    const auto [a, b, c] = mesh->triangles[triangle];
    const auto corner = [&](std::uint32_t vertex) { return to_world.point(mesh->vertices[vertex]); };
    if (to_world.is_mirrored()) return {corner(a), corner(c), corner(b)};
    return {corner(a), corner(b), corner(c)};
}

const Mesh* stored_mesh(const Shape& shape) {
    if (const auto* instance = std::get_if<Instance>(&shape)) return instance->mesh.get();
    return std::get_if<Mesh>(&shape);
}

std::size_t triangle_count(const Shape& shape) {
    if (std::holds_alternative<Rectangle>(shape)) return 2;
    if (std::holds_alternative<Box>(shape)) return 12;
    const Mesh* mesh = stored_mesh(shape);
    return mesh == nullptr ? 0 : mesh->triangles.size();
}

std::array<Vec3, 3> corners_of(const Shape& shape, std::size_t triangle) {
    if (const auto* instance = std::get_if<Instance>(&shape)) return instance->corners_of(triangle);
    if (const auto* rectangle = std::get_if<Rectangle>(&shape))
        return triangulated(*rectangle).corners_of(triangle);
    if (const auto* box = std::get_if<Box>(&shape)) return triangulated(*box).corners_of(triangle);
    return std::get<Mesh>(shape).corners_of(triangle);
}

MeshInWorld::MeshInWorld(const Shape& shape) : own_(std::get_if<Mesh>(&shape)) {
    if (const auto* instance = std::get_if<Instance>(&shape)) copy_ = triangulated(*instance);
}

Bounds bounds_of(const Shape& shape) {
    return std::visit([](const auto& s) { return bounds(s); }, shape);
}

double area_m2(const Shape& shape) {
    return std::visit([](const auto& s) { return area(s); }, shape);
}

namespace {

/// `moved` brings a vertex normal into the world.
template <typename Moved>
Vec3 interpolated_normal(const Mesh& mesh, std::uint32_t triangle, const Vec3& barycentric,
                         const Vec3& geometric, const Moved& moved) {
    constexpr double kLeastCosine = 0.1;
    const Triangle& corners =
        mesh.corner_normals.empty() ? mesh.triangles[triangle] : mesh.corner_normals[triangle];
    Vec3 sum;
    for (std::size_t i = 0; i < 3; ++i) {
        if (corners[i] == kNoNormal) return geometric;
        sum += barycentric[i] * moved(mesh.normals[corners[i]]);
    }
    const double along = dot(sum, geometric), size = length(sum);
    if (!(std::abs(along) > kLeastCosine * size)) return geometric;
    return sum / std::copysign(size, along);
}

}  // namespace

Vec3 shading_normal(const Mesh& mesh, std::uint32_t triangle, const Vec3& barycentric,
                    const Vec3& geometric) {
    return interpolated_normal(mesh, triangle, barycentric, geometric, [](const Vec3& n) { return n; });
}

Vec3 shading_normal(const Instance& instance, std::uint32_t triangle, const Vec3& barycentric,
                    const Vec3& geometric) {
    return interpolated_normal(*instance.mesh, triangle, barycentric, geometric,
                               [&](const Vec3& n) { return instance.to_world.normal(n); });
}

Vec3 barycentric_of(const Mesh& mesh, std::uint32_t triangle, const Vec3& point) {
    const auto [i, j, k] = mesh.triangles[triangle];
    const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    const Vec3 doubled = cross(b - a, c - a);
    const double squared = dot(doubled, doubled);
    const double of_b = dot(cross(point - a, c - a), doubled) / squared;
    const double of_c = dot(cross(b - a, point - a), doubled) / squared;
    return {1 - of_b - of_c, of_b, of_c};
}

void turn_over(Mesh& mesh, std::uint32_t triangle) {
    std::swap(mesh.triangles[triangle][1], mesh.triangles[triangle][2]);
    if (!mesh.corner_normals.empty())
        std::swap(mesh.corner_normals[triangle][1], mesh.corner_normals[triangle][2]);
}

double triangle_area_m2(const Vec3& a, const Vec3& b, const Vec3& c) {
    return length(cross(b - a, c - a)) / 2;
}

Mesh triangulated(const Rectangle& r) {
    return {{r.corner, r.corner + r.edge_u, r.corner + r.edge_u + r.edge_v, r.corner + r.edge_v},
            {{0, 1, 2}, {0, 2, 3}}};
}

Mesh triangulated(const Box& box) {
    Mesh mesh;
    for (unsigned corner = 0; corner < 8; ++corner) {
        mesh.vertices.push_back({corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                 corner & 4 ? box.max.z : box.min.z});
    }
    // Corner index: bit 0 for x, bit 1 for y, bit 2 for z; each face counterclockwise from outside.
    constexpr std::array<std::array<std::uint32_t, 4>, 6> faces{
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& f : faces) {
        mesh.triangles.push_back({f[0], f[1], f[2]});
        mesh.triangles.push_back({f[0], f[2], f[3]});
    }
    return mesh;
}

Mesh inscribed_icosahedron(const Sphere& sphere) {
    constexpr double g = std::numbers::phi;
    constexpr std::array<Vec3, 12> corners{{{-1, g, 0},
                                            {1, g, 0},
                                            {-1, -g, 0},
                                            {1, -g, 0},
                                            {0, -1, g},
                                            {0, 1, g},
                                            {0, -1, -g},
                                            {0, 1, -g},
                                            {g, 0, -1},
                                            {g, 0, 1},
                                            {-g, 0, -1},
                                            {-g, 0, 1}}};
    Mesh mesh;
    for (const Vec3& corner : corners) {
        mesh.vertices.push_back(sphere.center + sphere.radius * normalized(corner));
    }
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    return mesh;
}

Mesh inscribed_icosahedron(const Harmonics& harmonics) {
    Mesh mesh = inscribed_icosahedron(Sphere{});
    for (Vec3& vertex : mesh.vertices) vertex = harmonics.point_towards(harmonics.axes.to_world(vertex));
    return mesh;
}

Harmonics::Harmonics(HarmonicSurface own)
    : surface(std::make_shared<const HarmonicSurface>(std::move(own))),
      cells(std::make_shared<const HarmonicCells>(*surface)),
      area(std::make_shared<const HarmonicArea>(cells)) {}

Vec3 Harmonics::point_towards(const Vec3& direction) const {
    const Vec3 own = normalized(axes.to_local(direction));
    return to_world(surface->radius().at(own) * own);
}

Vec3 Harmonics::normal_towards(const Vec3& direction) const {
    return axes.to_world(surface->normal_at(normalized(axes.to_local(direction))));
}

namespace {

/// Whether the corners of two shapes lie at the same places.
struct Coincide {
    double tolerance_m;

    bool near(const Vec3& a, const Vec3& b) const { return length(a - b) < tolerance_m; }
    bool near(double a, double b) const { return std::abs(a - b) < tolerance_m; }

    /// The corners may begin with another one.
    bool operator()(const Rectangle& a, const Rectangle& b) const {
        const std::array<Vec3, 4> first = corners(a), second = corners(b);
        for (std::size_t shift = 0; shift < 4; ++shift) {
            bool same = true;
            for (std::size_t i = 0; i < 4; ++i) same = same && near(first[i], second[(i + shift) % 4]);
            if (same) return true;
        }
        return false;
    }
    bool operator()(const Disk& a, const Disk& b) const {
        return near(a.center, b.center) && near(a.radius, b.radius) &&
               near(a.radius * a.normal, b.radius * b.normal);
    }
    bool operator()(const Sphere& a, const Sphere& b) const {
        return near(a.center, b.center) && near(a.radius, b.radius);
    }
    bool operator()(const Box& a, const Box& b) const { return near(a.min, b.min) && near(a.max, b.max); }
    bool operator()(const Mesh& a, const Mesh& b) const {
        return a.triangles == b.triangles &&
               std::ranges::equal(a.vertices, b.vertices,
                                  [&](const Vec3& v, const Vec3& w) { return near(v, w); });
    }
    template <typename A, typename B>
    bool operator()(const A&, const B&) const {
        return false;
    }

  private:
    static std::array<Vec3, 4> corners(const Rectangle& r) {
        return {r.corner, r.corner + r.edge_u, r.corner + r.edge_u + r.edge_v, r.corner + r.edge_v};
    }
};

}  // namespace

bool coincide(const Shape& a, const Shape& b, double tolerance_m) {
    return std::visit(Coincide{tolerance_m}, a, b);
}

}  // namespace stilb::geometry
