// Survey of the directions from a centre in which a mesh is not star-shaped.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "geometry/harmonics/surface.h"
#include "rays/ray_caster.h"

namespace stilb::fit {

// Radial distances of a mesh from points inside: to its outermost and its innermost surface.

/// The distance in a direction without a surface.
inline constexpr double kNoSurface = std::numeric_limits<double>::quiet_NaN();

class RadialCaster {
  public:
    /// Throws std::runtime_error as RayCaster does.
    explicit RadialCaster(const Mesh& mesh);

    /// Distances from a centre, in the order of the (unit) directions; kNoSurface where there is none.
    std::vector<double> outermost(const Vec3& center, std::span<const Vec3> directions) const;
    std::vector<double> innermost(const Vec3& center, std::span<const Vec3> directions) const;

  private:
    std::vector<double> distances(const Vec3& center, std::span<const Vec3> directions,
                                  std::span<const rays::Ray> rays) const;

    Scene scene_;
    rays::RayCaster caster_;
};

/// A direction that meets the surface more than once.
struct Fold {
    Vec3 direction;
    double depth = 0;  ///< from the outermost surface to the innermost
};

struct StarSurvey {
    geometry::ParallelGrid grid;
    std::vector<double> outermost;  ///< distances on the grid; kNoSurface where nothing is met
    /// Shares of all directions.
    double folded_share = 0, missed_share = 0;
    /// The deepest folds first; at most kMostNamed, 10 degrees or more apart from each other.
    std::vector<Fold> worst_folds;
    /// Directions without a surface, in the same selection.
    std::vector<Vec3> misses;

    double share() const { return folded_share + missed_share; }
};

inline constexpr std::size_t kMostNamed = 3;

/// Surveys some 200,000 directions, none of them on a gauss_grid(). A direction counts as folded where
/// outermost and innermost surface are more than 1e-5 of `size` apart, so that doubled faces do not count.
StarSurvey survey(const RadialCaster& caster, const Vec3& center, double size);

/// The angles of a unit vector.
struct Angles {
    double theta_deg = 0, phi_deg = 0;  ///< from +z, 0 to 180; from +x, 0 to 360
};
Angles angles_of(const Vec3& direction);

/// "(0.1, 0.2, 0.97), theta 12.9, phi 63.4 degrees"
std::string named_direction(const Vec3& direction);

}  // namespace stilb::fit
