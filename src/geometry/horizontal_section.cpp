#include "geometry/horizontal_section.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <variant>

namespace stilb::geometry {
namespace {

/// A surface in directions from its middle, as triangles.
Mesh mesh_around(const std::function<Vec3(const Vec3&)>& surface) {
    constexpr std::uint32_t kAcross = 48, kDown = 24;
    Mesh mesh;
    for (std::uint32_t row = 0; row <= kDown; ++row) {
        for (std::uint32_t column = 0; column < kAcross; ++column) {
            const double theta = row * kPi / kDown, phi = column * 2 * kPi / kAcross;
            const double sine = row == 0 || row == kDown ? 0 : std::sin(theta);
            mesh.vertices.push_back(surface({sine * std::cos(phi), sine * std::sin(phi), std::cos(theta)}));
        }
    }
    for (std::uint32_t row = 0; row < kDown; ++row) {
        for (std::uint32_t column = 0; column < kAcross; ++column) {
            const std::uint32_t next = (column + 1) % kAcross;
            const std::uint32_t a = row * kAcross + column, b = row * kAcross + next;
            if (row > 0) mesh.triangles.push_back({a, a + kAcross, b});
            if (row + 1 < kDown) mesh.triangles.push_back({b, a + kAcross, b + kAcross});
        }
    }
    return mesh;
}

struct Triangulation {
    Mesh operator()(const Mesh& mesh) const { return mesh; }
    Mesh operator()(const Instance& instance) const { return triangulated(instance); }
    Mesh operator()(const Rectangle& rectangle) const { return triangulated(rectangle); }
    Mesh operator()(const Box& box) const { return triangulated(box); }
    Mesh operator()(const Sphere& sphere) const {
        return mesh_around([&](const Vec3& d) { return sphere.center + sphere.radius * d; });
    }
    Mesh operator()(const Harmonics& body) const {
        return mesh_around([&](const Vec3& d) { return body.point_towards(d); });
    }
    Mesh operator()(const Disk& disk) const {
        constexpr std::uint32_t kCorners = 48;
        const Frame frame = Frame::around(disk.normal);
        Mesh mesh{{disk.center}, {}};
        for (std::uint32_t i = 0; i < kCorners; ++i) {
            const double angle = i * 2 * kPi / kCorners;
            mesh.vertices.push_back(disk.center +
                                    disk.radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v));
            mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % kCorners});
        }
        return mesh;
    }
};

}  // namespace

Mesh drawn_as_mesh(const Shape& shape) { return std::visit(Triangulation{}, shape); }

std::optional<std::array<Vec3, 2>> cut_at(const Mesh& mesh, const Triangle& triangle, double height_m) {
    std::array<Vec3, 2> ends;
    std::size_t found = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &a = mesh.vertices[triangle[i]], &b = mesh.vertices[triangle[(i + 1) % 3]];
        if ((a.z < height_m) == (b.z < height_m)) continue;
        ends[found++] = a + (height_m - a.z) / (b.z - a.z) * (b - a);
    }
    return found == 2 ? std::optional(ends) : std::nullopt;
}

}  // namespace stilb::geometry
