// Standard errors from few replicates of values that lie side by side, the pixels of a picture or the
// readings of a grid, with the help of their neighbours.
//
// An error from four replicates has three degrees of freedom: it scatters by 40 %, and a 95 % interval is 1.6
// times as wide as it need be. Neighbours have about the same relative error. So the variance of a value is
// the mean of its own and that of the 5 x 5 values around, by their degrees of freedom, as moderated t
// statistics take it [Smyth 2004]: the neighbours count as d0 degrees, fewer where their variances differ by
// more than chance, as at edges.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace stilb::statistics {

/// One for each value.
template <typename Real>
struct PooledErrors {
    std::vector<Real> standard_errors;  ///< in the unit of the values
    std::vector<int> degrees_of_freedom;
};

/// `values`, `standard_errors`: row by row, `width` of them in a row; the errors are those of independent
/// replicates with so many degrees of freedom. Where the value or the error is 0 (known exactly), it stays.
/// Rows are divided between threads. Throws std::invalid_argument where the rows are not whole. `Real`: float
/// or double.
template <typename Real>
PooledErrors<Real> pool_errors(std::size_t width, std::span<const Real> values,
                               std::span<const Real> standard_errors, int degrees_of_freedom);

}  // namespace stilb::statistics
