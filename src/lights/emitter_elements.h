// Parts of area lights: points on them by area, and as a given point sees them.
#pragma once

#include <array>
#include <optional>
#include <variant>
#include <vector>

#include "geometry/shape.h"

namespace stilb::lights {

/// A part of an area light, with what makes it quick to sample.
struct EmitterElement {
    std::variant<Rectangle, std::array<Vec3, 3>, Sphere, Disk, Harmonics> shape;
    Vec3 middle;
    std::optional<Vec3> normal{};  ///< of flat ones
    double size_m = 0;
    double area_m2 = 0;  ///< that is seen: of a sphere its disk's
    /// From farther away, points by area are as good as by solid angle (the density varies by some per cent),
    /// and made in a fraction of the time. Infinite for spheres; below 0 for surfaces by harmonics, which are
    /// always drawn by area.
    double squared_far_m2 = 0;
};

/// In the order of a mesh's or box's triangles: hits tell which one they met. Of all else, one.
std::vector<EmitterElement> emitter_elements(const Shape& shape);

/// Drawn about uniformly by area: with `weight`, exactly.
struct EmitterPoint {
    Vec3 position, normal;
    double weight = 1;
};
EmitterPoint sample_by_area(const EmitterElement& element, const std::array<double, 2>& u);

/// A point with the density of the direction towards it.
struct EmitterSample {
    Vec3 position, normal;
    double pdf_per_sr = 0;
};
/// By solid angle or by area. Nothing where the element cannot be seen.
std::optional<EmitterSample> sample_seen(const EmitterElement& element, const Vec3& from,
                                         const std::array<double, 2>& u);
/// About the density of the direction to a point of an element by sample_seen(): for weighing, so that what
/// it says of one direction is all that counts, and how near it is to the truth matters little.
double rough_pdf_per_sr(const EmitterElement& element, const Vec3& position, const Vec3& normal,
                        const Vec3& from);

}  // namespace stilb::lights
