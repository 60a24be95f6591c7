// The numbers that one sample (a chain, a path, a direction) is made from: scrambled Sobol' points in the
// first dimensions, where smoothness pays, and counter-based random numbers behind them.
#pragma once

#include <array>
#include <cstdint>

#include "base/random.h"

namespace stilb {

/// Coordinate `dimension` of Sobol' point `index` [Joe and Kuo 2008], scrambled after Owen by hashing under
/// `scramble` [Laine and Karras 2011; Burley 2020]. Every point by itself is uniform over [0, 1).
double scrambled_sobol(std::uint32_t index, unsigned dimension, std::uint32_t scramble);

/// Unscrambled coordinate, as a 32-bit fraction.
std::uint32_t sobol(std::uint32_t index, unsigned dimension);

/// Dimensions that come from Sobol' points; later ones are random.
inline constexpr unsigned kSobolDimensions = 32;

/// The coordinates of point `index`, one after another. Streams of different keys are independent; the points
/// of one key, index 0, 1, 2 ..., are a scrambled low-discrepancy sequence.
class SampleStream {
  public:
    SampleStream(RandomKey key, std::uint64_t index) : key_(key), index_(index) {}

    /// What comes after the dimensions drawn so far, under another key: for points that share their first
    /// dimensions. (A new stream of the same index would repeat the point's first dimensions, not independent
    /// of these.)
    SampleStream continued(RandomKey key) const;

    /// Uniform in [0, 1).
    double next();
    /// Two coordinates, in the order drawn.
    std::array<double, 2> next_two() {
        const double first = next();
        return {first, next()};
    }

  private:
    RandomKey key_;
    std::uint64_t index_;
    unsigned dimension_ = 0;
    std::array<std::uint32_t, 4> words_{};
};

}  // namespace stilb
