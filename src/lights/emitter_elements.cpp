#include "lights/emitter_elements.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/harmonics/cells.h"
#include "geometry/harmonics/surface.h"
#include "lights/solid_angle/solid_angle.h"
#include "math/sampling.h"

namespace stilb::lights {
namespace {

using Corners = std::array<Vec3, 3>;

double size(const Rectangle& r) { return std::max(length(r.edge_u), length(r.edge_v)); }
double size(const Corners& t) { return std::max(length(t[1] - t[0]), length(t[2] - t[0])); }
double size(const Disk& d) { return d.radius; }

double area(const Rectangle& r) { return length(cross(r.edge_u, r.edge_v)); }
double area(const Corners& t) { return length(cross(t[1] - t[0], t[2] - t[0])) / 2; }
double area(const Disk& d) { return kPi * d.radius * d.radius; }

Vec3 middle(const Rectangle& r) { return r.corner + 0.5 * (r.edge_u + r.edge_v); }
Vec3 middle(const Corners& t) { return (t[0] + t[1] + t[2]) / 3; }
Vec3 middle(const Disk& d) { return d.center; }

Vec3 front_normal(const Rectangle& r) { return normalized(cross(r.edge_u, r.edge_v)); }
Vec3 front_normal(const Corners& t) { return normalized(cross(t[1] - t[0], t[2] - t[0])); }
Vec3 front_normal(const Disk& d) { return d.normal; }

// Points of flat elements leave the normal out, because the element has it.
EmitterPoint by_area(const Rectangle& r, const std::array<double, 2>& u) {
    return {{r.corner + u[0] * r.edge_u + u[1] * r.edge_v}};
}
EmitterPoint by_area(const Corners& t, const std::array<double, 2>& u) {
    const math::Barycentric b = math::sample_triangle(u[0], u[1]);
    return {{b.b0 * t[0] + b.b1 * t[1] + b.b2 * t[2]}};
}
EmitterPoint by_area(const Disk& d, const std::array<double, 2>& u) {
    const Frame frame = Frame::around(d.normal);
    const math::DiskPoint p = math::sample_unit_disk(u[0], u[1]);
    return {{d.center + d.radius * (p.x * frame.u + p.y * frame.v)}};
}
EmitterPoint by_area(const Sphere& s, const std::array<double, 2>& u) {
    const Vec3 normal = math::sample_sphere(u[0], u[1]).direction;
    return {{s.center + s.radius * normal, normal}};
}
EmitterPoint by_area(const Harmonics& h, const std::array<double, 2>& u) {
    const geometry::HarmonicArea::Point point = h.area->sample(u);
    return {{h.to_world(point.position), h.axes.to_world(point.normal)},
            1 / (point.pdf_per_area * h.area->total())};
}

template <typename Flat>
EmitterElement element_of(const Flat& shape) {
    const double size_m = size(shape);
    return {shape, middle(shape), front_normal(shape), size_m, area(shape), 9 * size_m * size_m};
}
/// From every direction, the projected area is a quarter of the surface.
EmitterElement element_of(const Sphere& sphere) {
    return {sphere,        sphere.center,       std::nullopt,
            sphere.radius, area_m2(sphere) / 4, std::numeric_limits<double>::infinity()};
}
EmitterElement element_of(const Harmonics& h) {
    return {h, h.center, std::nullopt, h.scale * h.surface->greatest_radius(), area_m2(h), -1};
}

std::vector<EmitterElement> elements_of(const Mesh& mesh) {
    std::vector<EmitterElement> elements;
    for (const auto& [a, b, c] : mesh.triangles) {
        elements.push_back(element_of(Corners{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}));
    }
    return elements;
}
std::vector<EmitterElement> elements_of(const Instance& instance) {
    return elements_of(triangulated(instance));
}
std::vector<EmitterElement> elements_of(const Box& box) { return elements_of(triangulated(box)); }
template <typename Other>
std::vector<EmitterElement> elements_of(const Other& shape) {
    return {element_of(shape)};
}

/// The density of the direction to a point that is drawn by area.
double area_pdf_per_sr(const EmitterElement& element, const Vec3& offset, const Vec3& normal) {
    const double squared_distance = squared_length(offset);
    return squared_distance * std::sqrt(squared_distance) / (std::abs(dot(offset, normal)) * element.area_m2);
}

/// Empty for surfaces by harmonics, which are sampled by area.
struct SolidAngleSampler {
    const Vec3& from;
    const std::array<double, 2>& u;

    template <typename Simple>
    std::optional<SolidAngleSample> operator()(const Simple& shape) const {
        return sample_by_solid_angle(shape, from, u[0], u[1]);
    }
    std::optional<SolidAngleSample> operator()(const Harmonics&) const { return std::nullopt; }
};

}  // namespace

std::vector<EmitterElement> emitter_elements(const Shape& shape) {
    return std::visit([](const auto& s) { return elements_of(s); }, shape);
}

EmitterPoint sample_by_area(const EmitterElement& element, const std::array<double, 2>& u) {
    EmitterPoint point = std::visit([&](const auto& shape) { return by_area(shape, u); }, element.shape);
    if (element.normal) point.normal = *element.normal;
    return point;
}

std::optional<EmitterSample> sample_seen(const EmitterElement& element, const Vec3& from,
                                         const std::array<double, 2>& u) {
    if (squared_length(element.middle - from) > element.squared_far_m2) {
        const EmitterPoint point = sample_by_area(element, u);
        return EmitterSample{point.position, point.normal,
                             area_pdf_per_sr(element, point.position - from, point.normal) / point.weight};
    }
    const auto sample = std::visit(SolidAngleSampler{from, u}, element.shape);
    if (!sample) return std::nullopt;
    const Vec3 normal =
        element.normal ? *element.normal : normalized(sample->point - std::get<Sphere>(element.shape).center);
    return EmitterSample{sample->point, normal, sample->pdf_per_sr};
}

double rough_pdf_per_sr(const EmitterElement& element, const Vec3& position, const Vec3& normal,
                        const Vec3& from) {
    const Vec3 towards = element.middle - from;
    const double squared_distance = squared_length(towards);
    if (squared_distance > element.squared_far_m2) return area_pdf_per_sr(element, position - from, normal);
    double cosine = 1;
    if (element.normal) {
        // Edge-on and close by this is inaccurate; it only has to be consistent for all callers.
        constexpr double least = 0.05;
        cosine = std::max(std::abs(dot(towards, *element.normal)) / std::sqrt(squared_distance), least);
    }
    const double projected_m2 = element.area_m2 * cosine;
    return (squared_distance + projected_m2 / (2 * kPi)) / projected_m2;
}

}  // namespace stilb::lights
