// Selection of fewer vertices from more light paths: connections cost most, so they go to vertices that lie
// evenly.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "estimators/local/kernel_choice.h"
#include "transport/light_path.h"

namespace stilb::estimators {

/// Vertices along a space-filling curve, surfaces of different orientation one after another.
class NodePool {
  public:
    explicit NodePool(const std::vector<transport::LightVertex>& nodes);

    std::size_t size() const { return nodes_.size(); }

    /// Selects about `count` vertices that represent all without bias: for every function of a vertex the
    /// expectation over u (uniform in [0, 1)) of the sum over the selected ones, with their fluxes, is the
    /// sum over all.
    ///
    /// Systematic sampling in proportion to importance, the reflected flux or, of gloss, more: the selected
    /// vertices carry about equal fluxes and lie as evenly as the flux does, so that a kernel which varies
    /// slowly over surfaces is summed with far less variance than over as many vertices of independent light
    /// paths.
    std::vector<transport::LightVertex> select(std::size_t count, double u) const;

  private:
    std::vector<transport::LightVertex> nodes_;
    std::vector<double> passed_;  ///< importance up to each vertex, its own included
};

/// Vertices that are chosen for groups of receivers: by their reflected flux, the kernel, and the lobe of a
/// glossy vertex.
class NearNodePool {
  public:
    NearNodePool(const std::vector<transport::LightVertex>& nodes, const Vec3& center);

    KernelChoice::Sums sums_for(std::span<const transport::Receiver> receivers, double k_per_m2) const {
        return choice_.sums_for(receivers, k_per_m2);
    }
    /// As NodePool's.
    std::vector<transport::LightVertex> select(const KernelChoice::Sums& sums, std::size_t count,
                                               double u) const;

  private:
    std::vector<transport::LightVertex> nodes_;
    KernelChoice choice_;
};

}  // namespace stilb::estimators
