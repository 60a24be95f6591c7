#include "io/import/radiance/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace stilb::io::radiance {
namespace {

/// Around the axis of curved surfaces: the normals of neighbours differ by less than 4 degrees.
constexpr std::uint32_t kSides = 96;
constexpr std::uint32_t kRows = 48;  ///< of a bubble, from pole to pole

Vec3 vector_at(std::span<const double> numbers, std::size_t i) {
    return {numbers[i], numbers[i + 1], numbers[i + 2]};
}

std::uint32_t vertex_count(const MeshBuilder& builder) {
    return static_cast<std::uint32_t>(builder.vertex_count());
}
std::uint32_t normal_count(const MeshBuilder& builder) {
    return static_cast<std::uint32_t>(builder.normal_count());
}

/// Unit vectors around an axis, kSides of them.
class Circle {
  public:
    explicit Circle(const Vec3& unit_axis) : frame_(Frame::around(unit_axis)) {}
    Vec3 at(double side) const {
        const double angle = 2 * kPi * side / kSides;
        return std::cos(angle) * frame_.u + std::sin(angle) * frame_.v;
    }
    const Vec3& axis() const { return frame_.w; }

  private:
    Frame frame_;
};

void add_polygon(std::span<const double> numbers, MeshBuilder& builder) {
    std::vector<std::uint32_t> corners(numbers.size() / 3);
    std::iota(corners.begin(), corners.end(), vertex_count(builder));
    for (std::size_t i = 0; i < numbers.size(); i += 3) builder.add_vertex(vector_at(numbers, i));
    builder.add_polygon(corners);
}

/// Two regular polygons, one in the other, with the area of the ring.
void add_ring(std::span<const double> numbers, MeshBuilder& builder) {
    const Vec3 center = vector_at(numbers, 0);
    const Circle circle(normalized(vector_at(numbers, 3)));
    constexpr double step = 2 * kPi / kSides;
    const double widening = std::sqrt(step / std::sin(step));
    const std::uint32_t first = vertex_count(builder);
    for (std::uint32_t i = 0; i < kSides; ++i) {
        for (const double radius : {numbers[6], numbers[7]})
            builder.add_vertex(center + radius * widening * circle.at(i));
    }
    for (std::uint32_t i = 0; i < kSides; ++i) {
        const std::uint32_t inner = first + 2 * i, next = first + 2 * ((i + 1) % kSides);
        builder.add_triangle({inner, inner + 1, next + 1});
        if (numbers[6] > 0) builder.add_triangle({inner, next + 1, next});
    }
}

/// The factor by which the radii of a frustum of flat sides grow, so that their area is that of the cone.
double frustum_widening(double height, double radius_difference) {
    constexpr double half = kPi / kSides;
    const double slant = std::hypot(height, radius_difference);
    const double across = std::cos(half) * radius_difference;
    double widening = half / std::sin(half);
    // The slant of the sides depends on the factor a little.
    for (int i = 0; i < 40; ++i)
        widening = half / std::sin(half) * slant / std::hypot(height, widening * across);
    return widening;
}

/// From `bottom` to `top` with these radii; the front is the outside unless `is_inward`.
void add_cone(const Vec3& bottom, const Vec3& top, double bottom_radius, double top_radius, bool is_inward,
              MeshBuilder& builder) {
    const double height = length(top - bottom), difference = bottom_radius - top_radius;
    const Circle circle((top - bottom) / height);
    const double widening = frustum_widening(height, difference);
    const double side = is_inward ? -1 : 1;
    const std::uint32_t vertices = vertex_count(builder), normals = normal_count(builder);
    for (std::uint32_t i = 0; i < kSides; ++i) {
        builder.add_vertex(bottom + bottom_radius * widening * circle.at(i));
        builder.add_vertex(top + top_radius * widening * circle.at(i));
    }
    // Also between the corners: an apex has another normal in each triangle.
    for (std::uint32_t i = 0; i < 2 * kSides; ++i)
        builder.add_normal(side * (height * circle.at(i / 2.0) + difference * circle.axis()));
    const auto add = [&](Triangle v, Triangle n) {
        if (is_inward) std::swap(v[1], v[2]), std::swap(n[1], n[2]);
        builder.add_triangle(v, n);
    };
    for (std::uint32_t i = 0; i < kSides; ++i) {
        const std::uint32_t j = (i + 1) % kSides;
        const std::uint32_t low = vertices + 2 * i, next_low = vertices + 2 * j;
        const std::uint32_t here = normals + 2 * i, between = here + 1, next = normals + 2 * j;
        if (bottom_radius > 0)
            add({low, next_low, top_radius > 0 ? next_low + 1 : low + 1},
                {here, next, top_radius > 0 ? next : between});
        if (top_radius > 0)
            add({low, next_low + 1, low + 1}, {bottom_radius > 0 ? here : between, next, here});
    }
}

/// A sphere seen from inside, of rows between parallels; its area is that of the sphere.
void add_bubble(const Vec3& center, double radius, MeshBuilder& builder) {
    const auto direction = [](std::uint32_t row, std::uint32_t side) {
        // At the poles all sides are the same point.
        if (row % kRows == 0) return Vec3{0, 0, row == 0 ? 1. : -1.};
        const double polar = kPi * row / kRows, azimuth = 2 * kPi * side / kSides;
        return Vec3{std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                    std::cos(polar)};
    };
    double area = 0;
    for (std::uint32_t row = 0; row < kRows; ++row) {
        const Vec3 a = direction(row, 0), b = direction(row + 1, 0), c = direction(row + 1, 1),
                   d = direction(row, 1);
        area += kSides * (length(cross(b - a, c - a)) + length(cross(c - a, d - a))) / 2;
    }
    const double widened = radius * std::sqrt(4 * kPi / area);
    const std::uint32_t vertices = vertex_count(builder), normals = normal_count(builder);
    for (std::uint32_t row = 0; row <= kRows; ++row) {
        for (std::uint32_t side = 0; side < kSides; ++side) {
            builder.add_vertex(center + widened * direction(row, side));
            builder.add_normal(-direction(row, side));
        }
    }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        builder.add_triangle({vertices + a, vertices + b, vertices + c},
                             Triangle{normals + a, normals + b, normals + c});
    };
    for (std::uint32_t row = 0; row < kRows; ++row) {
        for (std::uint32_t side = 0; side < kSides; ++side) {
            const std::uint32_t here = row * kSides + side, next = row * kSides + (side + 1) % kSides;
            if (row + 1 < kRows) add(here, next + kSides, here + kSides);
            if (row > 0) add(here, next, next + kSides);
        }
    }
}

void add_mesh_triangle(std::span<const double> numbers, MeshBuilder& builder) {
    const std::uint32_t vertices = vertex_count(builder), normals = normal_count(builder);
    Triangle of_corners{kNoNormal, kNoNormal, kNoNormal};
    for (std::uint32_t i = 0; i < 3; ++i) {
        const std::size_t at = std::size_t{3} * i;
        builder.add_vertex(vector_at(numbers, at));
        const Vec3 normal = vector_at(numbers, 9 + at);
        builder.add_normal(normal);
        if (length(normal) > 0) of_corners[i] = normals + i;
    }
    builder.add_triangle({vertices, vertices + 1, vertices + 2}, of_corners);
}

}  // namespace

std::optional<Shape> simple_shape(SurfaceKind kind, std::span<const double> numbers) {
    if (kind == SurfaceKind::sphere) return Sphere{vector_at(numbers, 0), numbers[3]};
    if (kind == SurfaceKind::ring && numbers[6] == 0)
        return Disk{vector_at(numbers, 0), normalized(vector_at(numbers, 3)), numbers[7]};
    return std::nullopt;
}

void add_flat(SurfaceKind kind, std::span<const double> numbers, MeshBuilder& builder) {
    kind == SurfaceKind::ring ? add_ring(numbers, builder) : add_polygon(numbers, builder);
}

void add_smooth(SurfaceKind kind, std::span<const double> numbers, MeshBuilder& builder) {
    if (kind == SurfaceKind::mesh) return add_mesh_triangle(numbers, builder);
    const Vec3 first = vector_at(numbers, 0);
    if (kind == SurfaceKind::bubble) return add_bubble(first, numbers[3], builder);
    add_cone(first, vector_at(numbers, 3), numbers[6], numbers.back(),
             kind == SurfaceKind::tube || kind == SurfaceKind::cup, builder);
}

std::optional<Rectangle> parallelogram_of(const Mesh& mesh) {
    const std::vector<Vec3>& v = mesh.vertices;
    if (v.size() != 4 || mesh.triangles.size() != 2 || !mesh.normals.empty()) return std::nullopt;
    constexpr double rounding = 1e-9;
    const auto [first, second, third] = mesh.triangles[0];
    // The corner that the first triangle lacks lies opposite of one of its corners.
    const std::uint32_t missing = 6 - first - second - third;
    for (const std::array<std::uint32_t, 3>& order :
         {std::array{first, second, third}, {second, third, first}, {third, first, second}}) {
        const auto& [a, corner, b] = order;
        const Vec3 u = v[b] - v[corner], w = v[a] - v[corner];
        if (length(v[corner] + u + w - v[missing]) < rounding * (length(u) + length(w)))
            return Rectangle{v[corner], u, w};
    }
    return std::nullopt;
}

}  // namespace stilb::io::radiance
