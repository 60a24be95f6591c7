// The luminous intensity distribution of a luminaire, as IES and EULUMDAT files state it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/vec.h"

namespace stilb::lights {

/// The axis of the planes of a photometric file: vertical for A and C, horizontal for B.
enum class PhotometryType { A, B, C };

/// Intensity [cd], bilinear in the two angles of its grid, zero outside the range of the angles.
///
/// Directions are unit vectors in the luminaire's frame (left-handed, as C planes are): x towards C0, y
/// towards C90, z towards the nadir (gamma = 0). Immutable. Angles, interpolation and sampling:
/// docs/photometry.md.
class PhotometricSolid {
  public:
    /// The grid of a file with its symmetry expanded. Angles in degrees, each list increasing by
    /// kSmallestStepDeg or more. With H and V the horizontal and vertical angles of LM-63, H clockwise seen
    /// from above, and (plane, polar) in the frame:
    /// - C: planes C, a full turn or one for all; polar gamma in [0, 180]. (0, 90) is x, (90, 90) is y.
    /// - A: planes H in [-180, 180]; polar V in [-90, 90]. (0, 0) is x, (90, 0) is -y, (any, -90) is z.
    /// - B: planes V in [-180, 180]; polar H in [-90, 90]. (0, 0) is z, (90, 0) is x, (any, 90) is -y.
    struct Grid {
        PhotometryType type = PhotometryType::C;
        std::vector<double> planes_deg;
        std::vector<double> polar_deg;
        std::vector<double> intensity_cd;  ///< planes x polar, polar angle fastest
    };
    static constexpr double kSmallestStepDeg = 1e-6;

    /// Throws InputError where the grid is not as above, an intensity is negative or not finite, or all are
    /// 0.
    explicit PhotometricSolid(const Grid& grid);

    double intensity_cd(const Vec3& direction) const;
    /// An upper bound of intensity_cd(direction), fast to compute: the largest intensity at about its polar
    /// angle.
    double intensity_bound_cd(const Vec3& direction) const;
    /// Integral of the interpolated intensity over the sphere: exact, not a sum over grid points.
    double flux_lm() const { return flux_lm_; }
    double peak_cd() const { return peak_cd_; }
    /// The share of the flux that leaves into the half space of the nadir, exact likewise; 1 where all of it
    /// does.
    double share_below() const;

    /// A direction drawn with density intensity / flux exactly, by inversion of two numbers in [0, 1): u1
    /// gives the plane, u2 the angle in it, both continuous and increasing.
    Vec3 sample_direction(double u1, double u2) const;
    /// intensity / flux.
    double pdf_per_sr(const Vec3& direction) const { return intensity_cd(direction) / flux_lm_; }

  private:
    double relative(std::size_t plane, std::size_t ring) const {
        return relative_intensity_[plane * polar_.size() + ring];
    }
    bool has_horizontal_pole() const { return axes_.w.z == 0; }
    void add_up_flux();
    /// Per radian of a plane's angle: from the pole to the horizon, or all where the horizon is two planes.
    double flux_to_horizon(std::size_t plane) const;
    void find_bounds();

    Frame axes_;                              ///< plane angle 0 and 90 on the equator, pole of polar angle 0
    std::vector<double> planes_;              ///< radians
    std::vector<double> polar_;               ///< radians from the pole
    std::vector<double> relative_intensity_;  ///< intensity / peak: neither sums nor squares overflow
    std::vector<double> flux_below_;   ///< planes x polar: per radian of plane angle, from the pole down
    std::vector<double> flux_before_;  ///< per plane: of all slices before it
    static constexpr std::size_t kBounds = 128;
    std::array<double, kBounds> bound_cd_{};  ///< in equal steps of cos(polar angle), from -1 on
    double flux_lm_ = 0;
    double peak_cd_ = 0;
};

}  // namespace stilb::lights

namespace stilb {
using lights::PhotometricSolid;
}  // namespace stilb
