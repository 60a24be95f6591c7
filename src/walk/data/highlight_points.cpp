#include "walk/data/highlight_points.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include "math/random.h"
#include "math/sampling.h"

namespace stilb::walk {
namespace {

using lights::EmitterPoint;

constexpr std::size_t kRows = 4, kOnSurface = kRows * kRows, kAround = 64;
/// The distance of light from infinity, in extents of the scene.
constexpr double kFar = 100;

/// Point i of n on the unit sphere, evenly spread (a Fibonacci lattice).
Vec3 lattice_direction(std::size_t i, std::size_t n) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(n);
    const double azimuth = static_cast<double>(i) * kPi * (3 - std::sqrt(5.0)), r = std::sqrt(1 - z * z);
    return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

std::vector<EmitterPoint> points_on(const Rectangle& rectangle) {
    const Vec3 normal = normalized(cross(rectangle.edge_u, rectangle.edge_v));
    std::vector<EmitterPoint> points;
    for (std::size_t i = 0; i < kOnSurface; ++i) {
        const std::size_t row = i / kRows, column = i % kRows;
        const double s = (static_cast<double>(column) + 0.5) / kRows;
        const double t = (static_cast<double>(row) + 0.5) / kRows;
        points.push_back({{rectangle.corner + s * rectangle.edge_u + t * rectangle.edge_v, normal}});
    }
    return points;
}

std::vector<EmitterPoint> points_on(const Sphere& sphere) {
    std::vector<EmitterPoint> points;
    for (std::size_t i = 0; i < kOnSurface; ++i) {
        const Vec3 outwards = lattice_direction(i, kOnSurface);
        points.push_back({{sphere.center + sphere.radius * outwards, outwards}});
    }
    return points;
}

/// Any other shape: elements by area, and on these the points of a (0, 2)-sequence.
template <typename AnyShape>
std::vector<EmitterPoint> points_on(const AnyShape& shape) {
    const std::vector<lights::EmitterElement> elements = lights::emitter_elements(shape);
    std::vector<double> areas;
    for (const lights::EmitterElement& element : elements) areas.push_back(element.area_m2);
    const math::DiscreteDistribution by_area(areas);
    std::vector<EmitterPoint> points;
    for (std::size_t i = 0; i < kOnSurface; ++i) {
        const auto u = math::SampleStream(math::RandomKey{2}, i).next_two();
        const auto choice = by_area.choose(u[0]);
        points.push_back(sample_by_area(elements[choice.index], {choice.remainder, u[1]}));
    }
    return points;
}

/// Of light from infinity.
template <lights::InfiniteEmitterKind Emitter>
std::vector<EmitterPoint> points_around(const Bounds& bounds, const Emitter& emitter) {
    std::vector<EmitterPoint> points;
    for (std::size_t i = 0; i < kAround; ++i) {
        const Vec3 direction = lattice_direction(i, kAround);
        points.push_back({{bounds.middle() + 2 * kFar * bounds.half_extent() * direction},
                          emitter.luminance_cd_m2(direction).luminance()});
    }
    return points;
}

template <lights::LightKind Source>
std::vector<EmitterPoint> points_of(const Scene& scene, const Source& light) {
    if constexpr (Source::kLocation == LightLocation::point) {
        return {{{light.origin().position}}};
    } else if constexpr (Source::kLocation == LightLocation::surface) {
        return std::visit([](const auto& shape) { return points_on(shape); },
                          scene.object(light.object).shape);
    } else {
        static_assert(Source::kLocation == LightLocation::infinity);
        const scene::LightSurroundings surroundings(scene);
        return points_around(surroundings.bounds(),
                             typename Source::Emitter(light, surroundings, scene::lift_of(scene)));
    }
}

}  // namespace

std::vector<EmitterPoint> highlight_points(const Scene& scene, const Light& light) {
    std::vector<EmitterPoint> points =
        std::visit([&](const auto& source) { return points_of(scene, source); }, light.source);
    double sum = 0;
    for (const EmitterPoint& point : points) sum += point.weight;
    for (EmitterPoint& point : points) point.weight = sum > 0 ? point.weight / sum : 0;
    return points;
}

}  // namespace stilb::walk
