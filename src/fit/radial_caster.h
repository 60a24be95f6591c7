// A mesh as seen from points inside: how far its outermost and its innermost surface are.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "rays/ray_caster.h"

namespace stilb::fit {

/// Where a direction meets nothing.
inline constexpr double kNoSurface = std::numeric_limits<double>::quiet_NaN();

class RadialCaster {
  public:
    /// Throws std::runtime_error as RayCaster does.
    explicit RadialCaster(const Mesh& mesh);

    /// Distances from a centre, in the (unit) directions' order; kNoSurface where nothing is met.
    std::vector<double> outermost(const Vec3& center, std::span<const Vec3> directions) const;
    std::vector<double> innermost(const Vec3& center, std::span<const Vec3> directions) const;

  private:
    std::vector<double> distances(const Vec3& center, std::span<const Vec3> directions,
                                  std::span<const rays::Ray> rays) const;

    Scene scene_;
    rays::RayCaster caster_;
};

}  // namespace stilb::fit
