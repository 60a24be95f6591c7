// Equirectangular pictures of a scene's surroundings: luminance by direction, and sampling in proportion to
// it.
#pragma once

#include <array>
#include <vector>

#include "base/rgb.h"
#include "base/vec.h"

namespace stilb::lights {

/// Constant over each pixel's solid angle. Directions are unit vectors in the picture's frame: x leads to its
/// middle, z to its top edge, y to a quarter of its width left of the middle: as a camera with projection
/// "panorama" that looks along x, z upwards, sees the world. Immutable.
class Panorama {
  public:
    struct Image {
        int width = 0, height = 0;
        std::vector<std::array<float, 3>> rgb_cd_m2;  ///< row by row from the top, from left to right
    };
    /// Throws InputError where the picture is not twice as wide as high, a value is negative or not finite,
    /// or all are 0.
    explicit Panorama(Image image);

    const Image& image() const { return image_; }
    int width() const { return image_.width; }
    int height() const { return image_.height; }
    Rgb luminance_cd_m2(const Vec3& direction) const { return rgb_of(pixel_towards(direction)); }
    /// Integral of the luminance over the sphere [lx]: 4 pi times its mean.
    const Rgb& total_lx() const { return total_lx_; }
    /// The illuminance of an unshaded plane with this unit normal, accurate to about a pixel's size.
    Rgb illuminance_lx(const Vec3& normal) const;

    /// Drawn with density luminance / total by inversion of two numbers in [0, 1): u1 gives the row, u2 the
    /// column, both continuous and increasing.
    struct Sample {
        Vec3 direction;
        double pdf_per_sr = 0;
        Rgb luminance_cd_m2;
    };
    Sample sample(double u1, double u2) const;
    double pdf_per_sr(const Vec3& direction) const {
        return luminance_cd_m2(direction).luminance() / total_luminous_lx_;
    }

    /// A part of the picture, with its illuminance on a perpendicular surface.
    struct Part {
        Vec3 direction;  ///< to its middle
        Rgb normal_illuminance_lx;
    };
    /// The whole picture in at most 64 x 32 parts, for rough sums.
    const std::vector<Part>& parts() const { return parts_; }

  private:
    std::size_t pixel_towards(const Vec3& direction) const;
    Rgb rgb_of(std::size_t pixel) const;
    /// cos(theta) of the upper edge of a row.
    double top_of(int row) const;
    double pixel_sr(int row) const;
    Vec3 direction_at(double column, double z) const;
    void check() const;
    void add_up();
    void divide();

    Image image_;
    std::vector<double> row_sums_;    ///< running sums of the rows' luminous integrals [lx]
    std::vector<double> pixel_sums_;  ///< running sums of luminance, of each row by itself
    Rgb total_lx_;
    double total_luminous_lx_ = 0;
    std::vector<Part> parts_;
};

}  // namespace stilb::lights

namespace stilb {
using lights::Panorama;
}  // namespace stilb
