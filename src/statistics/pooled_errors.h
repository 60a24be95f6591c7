// Standard errors of a picture's pixels from few replicates, with the help of their neighbours.
//
// An error from four replicates has three degrees of freedom: it scatters by 40 %, and a 95 % interval is 1.6
// times as wide as it need be. Neighbouring pixels have about the same relative error. So the variance of a
// pixel is the mean of its own and that of the 5 x 5 pixels around, by their degrees of freedom, as moderated
// t statistics take it [Smyth 2004]: the neighbours count as d0 degrees, fewer where their variances differ
// by more than chance, as at edges.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace stilb::statistics {

struct PixelErrors {
    std::vector<float> standard_errors;  ///< in the unit of the values
    std::vector<int> degrees_of_freedom;
};

/// `values`, `standard_errors`: of the pixels, row by row; the errors are those of independent replicates
/// with so many degrees of freedom. Pixels of value 0 or error 0, which are known exactly, keep their own.
/// Rows are divided between threads. Throws std::invalid_argument where the numbers of pixels do not match.
PixelErrors pool_errors(std::size_t width, std::span<const float> values,
                        std::span<const float> standard_errors, int degrees_of_freedom);

}  // namespace stilb::statistics
