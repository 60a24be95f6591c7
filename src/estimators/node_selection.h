// Fewer nodes of more chains: what a fan costs goes to nodes that lie evenly.
#pragma once

#include <cstddef>
#include <vector>

#include "estimators/light_chain.h"

namespace stilb {

/// Replaces nodes by about `count` of them without bias: for every function of a node the expectation over u
/// (uniform in [0, 1)) of the sum over the selected ones, with their fluxes, is the sum over all.
///
/// Systematic sampling in proportion to the reflected flux along a space-filling curve, surfaces of different
/// orientation one after another: the selected nodes carry about equal fluxes and lie as evenly as the flux
/// does, so that a kernel which varies slowly over surfaces is summed with far less variance than over as
/// many nodes of chains of their own.
std::vector<ChainNode> select_nodes(const std::vector<ChainNode>& nodes, std::size_t count, double u);

}  // namespace stilb
