// Pictures on surfaces: where a point of a surface lies in the picture, and means over surfaces.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "base/rgb.h"
#include "io/image/texture_file.h"

namespace stilb::io {

/// Texture coordinates: (0, 0) is the top left corner of the picture, (1, 1) the bottom right one.
using Uv = std::array<double, 2>;
/// The texture coordinates of a triangle's corners.
using FacePlace = std::array<Uv, 3>;

/// The place of a triangle without texture coordinates: they are no numbers.
FacePlace no_place();
/// Whether all coordinates are numbers from -1e9 to 1e9.
bool has_place(const FacePlace& place);
/// The texture coordinates of a point of a triangle.
Uv uv_at(const FacePlace& place, const std::array<double, 3>& barycentric);

/// How a picture continues beyond its edges.
enum class TextureWrap { repeat, mirror, clamp };

struct TextureMap {
    std::shared_ptr<const Texture> picture;
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;

    /// The texel at texture coordinates.
    const std::array<std::uint8_t, 4>& at(const Uv& uv) const;
};

/// The colour of a texel as shares of light.
inline Rgb linear_rgb(const std::array<std::uint8_t, 4>& texel) {
    return {{linear_of_srgb(texel[0]), linear_of_srgb(texel[1]), linear_of_srgb(texel[2])}};
}

/// Point `i` of a sequence that fills the unit square evenly.
Uv even_point(std::size_t i);
/// Barycentric coordinates of point `i` of a sequence that fills a triangle evenly.
std::array<double, 3> even_point_of_triangle(std::size_t i);

/// Points that lie evenly on triangles, by area.
struct PointOfTriangle {
    std::size_t triangle;
    std::array<double, 3> barycentric;
};
std::vector<PointOfTriangle> points_on_surface(std::span<const double> areas_m2);

/// A picture stores red, green and blue by the tone curve of sRGB, or as plain numbers.
enum class Texels { colours, numbers };

/// The means of red, green, blue and alpha (from 0 to 1) at these texture coordinates, or over the whole
/// picture where there are none.
std::array<double, 4> mean_of(const TextureMap& map, std::span<const Uv> places, Texels texels);

}  // namespace stilb::io
