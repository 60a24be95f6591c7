// Choosing one of several by weight.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace stilb::math {

struct DiscreteChoice {
    std::size_t index = 0;
    double probability = 1;
    double remainder = 0;  ///< uniform in [0, 1), independent of the choice
};

/// Draws an index by running sums of weights, as DiscreteDistribution; the last sum is above 0.
DiscreteChoice choose_by_sums(std::span<const double> sums, double u);

/// Draws indices in proportion to fixed weights, by inversion: neighbouring numbers give neighbouring
/// indices, and what is left of the number can be used again.
class DiscreteDistribution {
  public:
    DiscreteDistribution() = default;
    /// Weights are finite, none is negative, at least one is positive.
    explicit DiscreteDistribution(std::span<const double> weights);

    DiscreteChoice choose(double u) const { return choose_by_sums(cumulative_, u); }
    double probability(std::size_t index) const;

    double total() const { return cumulative_.empty() ? 0 : cumulative_.back(); }

  private:
    std::vector<double> cumulative_;
};

}  // namespace stilb::math
