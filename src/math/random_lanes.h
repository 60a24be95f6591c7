// The numbers of sixteen sample streams at once (random.h): bit by bit those of SampleStream.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/rays.h"
#include "math/random.h"

namespace stilb::math {

/// Streams side by side; all take as many dimensions from Sobol' points.
struct alignas(64) StreamPacket {
    using Words = RayPacket::Words;
    Words key_low{}, key_high{}, index_low{}, index_high{};
    /// Of the next number; a multiple of 4.
    Words dimension{};

    void set(std::size_t lane, const SampleStream& stream);
    /// `sobol_dimensions`: as in the constructor of SampleStream.
    SampleStream stream(std::size_t lane, unsigned sobol_dimensions) const;
};

/// Words of four dimensions, lane by lane.
struct alignas(64) NumberPacket {
    std::array<StreamPacket::Words, 4> words;

    /// A further word, hashed from all four: for decisions that need no even distribution, at a fraction of
    /// the time of other dimensions. Different for each `which`.
    STILB_INLINED std::uint32_t hashed(std::size_t lane, std::uint32_t which) const {
        std::uint32_t x = words[0][lane] ^ which * 0x9e3779b9u;
        for (std::size_t i = 1; i < 4; ++i) x = mixed(x) + words[i][lane];
        return mixed(x);
    }

  private:
    /// A permutation whose every bit influences all bits [Wellons 2018, "lowbias32"].
    STILB_INLINED static std::uint32_t mixed(std::uint32_t x) {
        x ^= x >> 16;
        x *= 0x7feb352du;
        x ^= x >> 15;
        x *= 0x846ca68bu;
        return x ^ x >> 16;
    }
};

/// The next four numbers of every stream.
NumberPacket next_four(StreamPacket& streams, unsigned sobol_dimensions);
void skip_four(StreamPacket& streams);

/// Sets the keys of the packet to key.derived(parts[lane]).
void set_derived_keys(RandomKey key, const StreamPacket::Words& parts, StreamPacket& streams);

/// A number in [0, 1) on the grid of 2^-24.
inline float lane_unit_interval(std::uint32_t word) {
    return static_cast<float>(static_cast<std::int32_t>(word >> 8)) * 0x1p-24f;
}

}  // namespace stilb::math
