// Fewer nodes of more chains: what a fan costs goes to nodes that lie evenly.
#pragma once

#include <cstddef>
#include <vector>

#include "transport/light_path.h"

namespace stilb::estimators {

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
