// Elements of area lights, for sampling points by area and by the solid angle at a given point.
#pragma once

#include <array>
#include <optional>
#include <variant>
#include <vector>

#include "base/surface_point.h"
#include "geometry/shape.h"

namespace stilb::lights {

/// An element of an area light, with precomputed data for sampling.
struct EmitterElement {
    std::variant<Rectangle, std::array<Vec3, 3>, Sphere, Disk, Harmonics> shape;
    Vec3 middle;
    std::optional<Vec3> normal{};  ///< of flat ones
    double size_m = 0;
    double area_m2 = 0;  ///< visible: of a sphere its disk's
    /// At larger distances, points by area are as good as by solid angle (the density varies by some per
    /// cent), and cost a fraction of the time. Infinite for spheres; below 0 for surfaces by harmonics, which
    /// are always sampled by area.
    double squared_far_m2 = 0;
};

/// In the order of a mesh's or box's triangles, so that hits identify their element. Other shapes have one
/// element.
std::vector<EmitterElement> emitter_elements(const Shape& shape);

/// A point of an emitter, drawn about uniformly by area; with `weight`, exactly.
struct EmitterPoint : SurfacePoint {
    double weight = 1;
};
EmitterPoint sample_by_area(const EmitterElement& element, const std::array<double, 2>& u);

/// A point with the density of the direction towards it.
struct EmitterSample {
    Vec3 position, normal;
    double pdf_per_sr = 0;
};
/// Samples by solid angle or by area. Nothing where the element cannot be seen.
std::optional<EmitterSample> sample_seen(const EmitterElement& element, const Vec3& from,
                                         const std::array<double, 2>& u);
/// The approximate density of the direction to a point of an element by sample_seen(), for weights only: it
/// must be consistent for a direction, but its accuracy matters little.
double rough_pdf_per_sr(const EmitterElement& element, const Vec3& position, const Vec3& normal,
                        const Vec3& from);

}  // namespace stilb::lights
