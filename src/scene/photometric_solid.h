// The luminous intensity distribution of a luminaire, as IES and EULUMDAT files state it.
#pragma once

#include <vector>

#include "base/vec.h"

namespace stilb {

/// Angles of a photometric file: IES types A, B and C differ in the axis that the planes turn about.
enum class PhotometryType { A, B, C };

/// Intensity [cd], bilinear in the two angles of its grid, zero outside the range of the angles.
///
/// Directions are unit vectors in the luminaire's frame (left-handed, as C planes are): x towards C0, y
/// towards C90, z towards the nadir (gamma = 0). Immutable.
class PhotometricSolid {
  public:
    /// The grid of a file after its symmetry was unfolded, angles in degrees and strictly increasing.
    /// Type C: `planes` are C in [0, 360] (first 0, last 360; a single plane means rotational symmetry),
    /// `polar` gamma in [0, 180]. Types A and B: `planes` horizontal, `polar` vertical angles of the file.
    struct Grid {
        PhotometryType type = PhotometryType::C;
        std::vector<double> planes_deg;
        std::vector<double> polar_deg;
        std::vector<double> intensity_cd;  ///< planes x polar, polar angle fastest
    };

    /// Throws InputError where the grid is not as above, an intensity is negative or not finite, or all are
    /// 0.
    explicit PhotometricSolid(Grid grid);

    double intensity_cd(const Vec3& direction) const;
    /// Integral of the interpolated intensity over the sphere: exact, not a sum over the grid.
    double flux_lm() const { return flux_lm_; }
    double peak_cd() const { return peak_cd_; }

    /// A direction drawn with density intensity / flux exactly, by inversion of two numbers in [0, 1).
    Vec3 sample_direction(double u1, double u2) const;
    /// intensity / flux.
    double pdf_per_sr(const Vec3& direction) const;

  private:
    Grid grid_;
    double flux_lm_ = 0;
    double peak_cd_ = 0;
};

}  // namespace stilb
