// Sobolev's problem: two infinite parallel diffuse planes and an isotropic point source between them.
#pragma once

namespace stilb::exact {

/// Plane 1 lies under the source and plane 2 above it; both are diffuse on the side that faces the source.
struct ParallelPlanes {
    double reflectance_1 = 0.5, reflectance_2 = 0.5;  ///< 0 to 1, their product below 1
    double distance_1_m = 0.5, distance_2_m = 0.5;    ///< from the source to each plane, positive
    double intensity_cd = 1;                          ///< the same in all directions
};

enum class Plane { first, second };

/// The illuminance on either plane as a function of the radius, that is the distance from the source's foot.
/// Exact for infinite planes [LocalEstimation (15), (16)]; the formula is derived in docs/exact-solutions.md.
/// Every function throws std::domain_error on a negative or infinite radius.
class SobolevProblem {
  public:
    /// The largest served radius, in units of distance_1_m + distance_2_m.
    static constexpr double kLargestRelativeRadius = 100;

    /// Throws std::domain_error where a value of `planes` is outside its range. At a product of 1 of the
    /// reflectances nothing is absorbed at a finite radius, and the illuminance is infinite.
    explicit SobolevProblem(const ParallelPlanes& planes);

    /// Straight from the source. Relative error below 1e-15.
    double direct_illuminance_lx(Plane plane, double radius_m) const;
    /// After one or more reflections. Relative error below 1e-14 up to a relative radius of 5, 1e-11 up to 50
    /// and 1e-9 up to 100; radii beyond kLargestRelativeRadius are refused.
    double indirect_illuminance_lx(Plane plane, double radius_m) const;
    double illuminance_lx(Plane plane, double radius_m) const;

    /// An upper bound of what illuminance_lx() loses at `radius_m` when every point of the planes farther
    /// than `half_size_m` from the axis through the source is left out: for disks of that radius, and for
    /// anything that contains them such as squares of that half side. The true loss lies between 0 and this
    /// bound. Needs radius_m < half_size_m.
    double truncation_bound_lx(Plane plane, double radius_m, double half_size_m) const;

  private:
    double separation_m() const;

    ParallelPlanes planes_;
};

}  // namespace stilb::exact
