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

/// A key whose parts serve the purposes of one enumeration: two families of streams under one key do not
/// compile.
template <typename Purpose>
struct KeyOf {
    RandomKey key;

    RandomKey derived(Purpose purpose) const { return key.derived(static_cast<std::uint64_t>(purpose)); }
};

// Blocks and indices that no stream reaches.

/// The block of the words of derived keys.
inline constexpr std::uint64_t kDerivation = ~std::uint64_t{0};
/// The index of the words that scramble Sobol' points.
inline constexpr std::uint64_t kScrambles = ~std::uint64_t{0} - 1;

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

// The parts of scrambled_sobol(), for many points at once (random_lanes.h).

/// The contributions of the index's bits to a coordinate, bits reversed.
const std::array<std::uint32_t, 32>& reversed_direction_numbers(unsigned dimension);

constexpr std::uint32_t reversed_bits(std::uint32_t x) {
    x = x << 24 | (x & 0xff00u) << 8 | (x >> 8 & 0xff00u) | x >> 24;
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    return (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
}

/// Point `index` of `count` (a power of two) that are spread evenly over the unit square and shifted
/// together: Hammersley's.
constexpr std::array<double, 2> even_point(std::uint32_t index, std::uint32_t count,
                                           const std::array<double, 2>& shift) {
    const double x = (index + shift[0]) / count;
    const double y = unit_interval(reversed_bits(index)) + shift[1];
    return {x < 1 ? x : 1 - 0x1p-53, y < 1 ? y : y - 1};
}

/// A random permutation in which a bit influences only higher bits: on reversed fractions that is Owen's
/// nested scrambling. Multipliers: Vegdahl's, chosen there for small bias.
constexpr std::uint32_t permuted_upwards(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

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
    /// The same stream, with the number of this dimension, a multiple of 4, as the next.
    SampleStream from(unsigned dimension) const {
        SampleStream stream(key_, index_, sobol_dimensions_);
        stream.dimension_ = dimension;
        return stream;
    }

    RandomKey key() const { return key_; }
    std::uint64_t index() const { return index_; }
    unsigned sobol_dimensions() const { return sobol_dimensions_; }
    /// The first dimension of four that are all still to come.
    unsigned next_block() const { return (dimension_ + 3) / 4 * 4; }

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
