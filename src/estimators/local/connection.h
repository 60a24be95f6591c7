// The fan: light from the nodes of chains to all receivers, in packets of rays with a common origin.
//
// From node y receiver x gets W f_r(y; in, y->x) w G response(x->y), with G = cos+ cos+ V / d^2 and w of the
// kernel split (theory T.1, T.1b and, with a BRDF at both ends, T.2). Geometry is in single precision; sums
// over more than a short block of nodes are in double.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

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

// Fewer nodes of more chains: what a fan costs goes to nodes that lie evenly.

/// Nodes along a space-filling curve, surfaces of different orientation one after another.
class NodePool {
  public:
    explicit NodePool(const std::vector<transport::LightVertex>& nodes);

    std::size_t size() const { return nodes_.size(); }

    /// About `count` of them that stand for all without bias: for every function of a node the expectation
    /// over u (uniform in [0, 1)) of the sum over the selected ones, with their fluxes, is the sum over all.
    ///
    /// Systematic sampling in proportion to the reflected flux: the selected nodes carry about equal fluxes
    /// and lie as evenly as the flux does, so that a kernel which varies slowly over surfaces is summed with
    /// far less variance than over as many nodes of chains of their own.
    std::vector<transport::LightVertex> select(std::size_t count, double u) const;

  private:
    std::vector<transport::LightVertex> nodes_;
    std::vector<double> passed_lm_;  ///< reflected flux up to each node, its own included
};

}  // namespace stilb::estimators
