// The fan: light from the nodes of chains to all receivers, in packets of rays with a common origin.
//
// From node y receiver x gets W f_r(y; in, y->x) w G response(x->y), with G = cos+ cos+ V / d^2 and w of the
// kernel split (theory T.1, T.1b and, with a BRDF at both ends, T.2). Geometry is in single precision; sums
// over more than a short block of nodes are in double.
#pragma once

#include <span>

#include "estimators/estimator.h"
#include "estimators/local/point_tile.h"
#include "transport/light_path.h"

namespace stilb::estimators {

/// Keeps what its arguments refer to. Immutable.
class Fan {
  public:
    /// An infinite k of a tile's receiver makes w = 1 there (plain local estimation). Nodes that path tracing
    /// cannot make (LightVertex::only_by_light) have w = 1 whatever k is.
    Fan(const rays::RayCaster& caster, std::span<const PointTile> tiles) : caster_(caster), tiles_(tiles) {}

    /// Adds what the nodes send to each receiver, and keeps the largest single contributions. Counts rays.
    void collect(std::span<const transport::LightVertex> nodes, ReadingSums& sums) const;

  private:
    const rays::RayCaster& caster_;
    std::span<const PointTile> tiles_;
};

}  // namespace stilb::estimators
