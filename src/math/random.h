// Counter-based random numbers: what is drawn depends on (key, index, position) alone, never on who drew
// before.
#pragma once

#include <array>
#include <cstdint>

namespace stilb::math {

/// Names an independent family of random numbers; made from the run's seed by derived().
struct RandomKey {
    std::uint64_t value = 0;

    /// A key for a part (replicate, sensor, purpose ...) of what this key stands for.
    RandomKey derived(std::uint64_t part) const;
};

/// Philox 4x32-10 [Salmon et al. 2011]: four words of block `block` of stream `index` under a key.
std::array<std::uint32_t, 4> random_block(RandomKey key, std::uint64_t index, std::uint64_t block);

/// A number in [0, 1) on the grid of 2^-32.
constexpr double unit_interval(std::uint32_t word) { return word * 0x1p-32; }

}  // namespace stilb::math
