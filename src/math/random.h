// Counter-based random numbers: a number depends on (key, index, position) alone, not on earlier
// draws.
#pragma once

#include <array>
#include <cstdint>

namespace stilb::math {

/// The identifier of an independent family of random numbers; made from the run's seed by derived().
struct RandomKey {
    std::uint64_t value = 0;

    /// The key of a part (replicate, sensor, purpose ...) of this key's work.
    RandomKey derived(std::uint64_t part) const;
};

/// Philox 4x32-10 [Salmon et al. 2011]: four words of block `block` of stream `index` under a key.
std::array<std::uint32_t, 4> random_block(RandomKey key, std::uint64_t index, std::uint64_t block);

/// A number in [0, 1) on the grid of 2^-32.
constexpr double unit_interval(std::uint32_t word) { return word * 0x1p-32; }

// The numbers of one sample (a light path, a camera path, a direction): scrambled Sobol' points in the
// first dimensions, where the integrand is smooth, followed by counter-based random numbers.

/// Coordinate `dimension` of Sobol' point `index` [Joe and Kuo 2008], scrambled after Owen by hashing under
/// `scramble` [Laine and Karras 2011; Burley 2020], as a 32-bit fraction. Every point by itself is uniform.
std::uint32_t scrambled_sobol(std::uint32_t index, unsigned dimension, std::uint32_t scramble);

/// Unscrambled coordinate, as a 32-bit fraction.
std::uint32_t sobol(std::uint32_t index, unsigned dimension);

/// The number of dimensions from Sobol' points; later ones are random.
inline constexpr unsigned kSobolDimensions = 32;

/// The coordinates of point `index`, one after another. Streams of different keys are independent; the points
/// of one key, index 0, 1, 2 ..., are a scrambled low-discrepancy sequence.
class SampleStream {
  public:
    /// Uses fewer Sobol' dimensions: saves time where there are too few points for the later ones to matter.
    SampleStream(RandomKey key, std::uint64_t index, unsigned sobol_dimensions = kSobolDimensions)
        : key_(key), index_(index), sobol_dimensions_(sobol_dimensions) {}

    /// A stream for the dimensions after those drawn so far, under another key: for points that share their
    /// first dimensions. (A new stream of the same index would repeat the point's first dimensions, not
    /// independent of these.)
    SampleStream continued(RandomKey key) const;

    /// Uniform in [0, 1).
    double next() {
        const unsigned dimension = dimension_++;
        const unsigned lane = dimension % 4;
        if (lane == 0) words_ = words_from(dimension);
        return unit_interval(words_[lane]);
    }
    /// Two coordinates, in the order drawn.
    std::array<double, 2> next_two() {
        const double first = next();
        return {first, next()};
    }

  private:
    /// Words of four dimensions.
    std::array<std::uint32_t, 4> words_from(unsigned dimension) const;

    RandomKey key_;
    std::uint64_t index_;
    unsigned sobol_dimensions_;  ///< a multiple of 4
    unsigned dimension_ = 0;
    std::array<std::uint32_t, 4> words_{};
};

}  // namespace stilb::math
