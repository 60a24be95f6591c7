#include "math/random_lanes.h"

#include <algorithm>
#include <bit>

namespace stilb::math {
namespace {

using Words = StreamPacket::Words;

constexpr std::uint32_t high(std::uint64_t word) { return static_cast<std::uint32_t>(word >> 32); }
constexpr std::uint32_t low(std::uint64_t word) { return static_cast<std::uint32_t>(word); }

/// The upper half of a product, from products of halves: vectorised products of 32 by 32 bits take longer.
STILB_INLINED std::uint32_t high_product(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t a0 = a & 0xffffu, a1 = a >> 16, b0 = b & 0xffffu, b1 = b >> 16;
    const std::uint32_t across = a0 * b1;
    const std::uint32_t middle = (a0 * b0 >> 16) + (across & 0xffffu) + a1 * b0;
    return a1 * b1 + (across >> 16) + (middle >> 16);
}

/// Philox 4x32-10 as in random_block(): block `blocks[lane]` of stream `index` under a key.
STILB_VECTORIZED void random_blocks(const Words& __restrict key_low, const Words& __restrict key_high,
                                    const Words& __restrict index_low, const Words& __restrict index_high,
                                    const Words& __restrict block_low, std::uint32_t block_high,
                                    NumberPacket& __restrict result) {
    for (int i = 0; i < kPacketWidth; ++i) {
        std::uint32_t c0 = index_low[i], c1 = index_high[i], c2 = block_low[i], c3 = block_high;
        std::uint32_t k0 = key_low[i], k1 = key_high[i];
        for (int round = 0; round < 10; ++round) {
            constexpr std::uint32_t m0 = 0xD2511F53u, m1 = 0xCD9E8D57u;
            const std::uint32_t high0 = high_product(c0, m0), high1 = high_product(c2, m1);
            const std::uint32_t low0 = c0 * m0, low1 = c2 * m1;
            c0 = high1 ^ c1 ^ k0;
            c1 = low1;
            c2 = high0 ^ c3 ^ k1;
            c3 = low0;
            k0 += 0x9E3779B9u;
            k1 += 0xBB67AE85u;
        }
        result.words[0][i] = c0, result.words[1][i] = c1, result.words[2][i] = c2, result.words[3][i] = c3;
    }
}

/// Replaces scrambles by the scrambled coordinates of Sobol' points where `lanes` is set.
STILB_VECTORIZED void scramble_lanes(const Words& __restrict index, std::uint32_t bits,
                                     const std::uint32_t* __restrict directions,
                                     const LaneMask& __restrict lanes, Words& __restrict words) {
    Words reversed{};
    for (std::uint32_t k = 0; k < bits; ++k) {
        for (int i = 0; i < kPacketWidth; ++i) reversed[i] ^= directions[k] & (0u - (index[i] >> k & 1u));
    }
    for (int i = 0; i < kPacketWidth; ++i) {
        const std::uint32_t coordinate = reversed_bits(permuted_upwards(reversed[i], words[i]));
        words[i] = lanes[i] != 0 ? coordinate : words[i];
    }
}

/// The coordinates of the lanes whose numbers come from Sobol' points, of which `words` has the scrambles.
void scramble(const StreamPacket& streams, const LaneMask& sobol_lanes, NumberPacket& numbers) {
    LaneMask from_sobol = sobol_lanes;
    for (;;) {
        const auto first = std::ranges::find(from_sobol, -1) - from_sobol.begin();
        if (first == kPacketWidth) return;
        const std::uint32_t dimension = streams.dimension[static_cast<std::size_t>(first)];
        LaneMask lanes{};
        std::uint32_t indices = 0;
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            if (from_sobol[i] == 0 || streams.dimension[i] != dimension) continue;
            lanes[i] = -1;
            from_sobol[i] = 0;
            indices |= streams.index_low[i];
        }
        for (unsigned d = 0; d < 4; ++d) {
            scramble_lanes(streams.index_low, static_cast<std::uint32_t>(std::bit_width(indices)),
                           reversed_direction_numbers(dimension + d).data(), lanes, numbers.words[d]);
        }
    }
}

}  // namespace

void StreamPacket::set(std::size_t lane, const SampleStream& stream) {
    key_low[lane] = low(stream.key().value), key_high[lane] = high(stream.key().value);
    index_low[lane] = low(stream.index()), index_high[lane] = high(stream.index());
    dimension[lane] = stream.next_block();
}

SampleStream StreamPacket::stream(std::size_t lane, unsigned sobol_dimensions) const {
    const auto both = [lane](const Words& lows, const Words& highs) {
        return lows[lane] | std::uint64_t{highs[lane]} << 32;
    };
    return SampleStream({both(key_low, key_high)}, both(index_low, index_high), sobol_dimensions)
        .from(dimension[lane]);
}

NumberPacket next_four(StreamPacket& streams, unsigned sobol_dimensions) {
    Words index_low, index_high, block;
    LaneMask from_sobol;
    std::int32_t any = 0;
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
        const bool is_sobol = streams.dimension[i] < sobol_dimensions;
        from_sobol[i] = is_sobol ? -1 : 0;
        any |= from_sobol[i];
        index_low[i] = is_sobol ? low(kScrambles) : streams.index_low[i];
        index_high[i] = is_sobol ? high(kScrambles) : streams.index_high[i];
        block[i] = streams.dimension[i] / 4;
    }
    NumberPacket numbers;
    random_blocks(streams.key_low, streams.key_high, index_low, index_high, block, 0, numbers);
    if (any != 0) scramble(streams, from_sobol, numbers);
    skip_four(streams);
    return numbers;
}

void skip_four(StreamPacket& streams) {
    for (std::uint32_t& dimension : streams.dimension) dimension += 4;
}

void set_derived_keys(RandomKey key, const Words& parts, StreamPacket& streams) {
    Words key_low, key_high, part_high{}, block_low;
    key_low.fill(low(key.value));
    key_high.fill(high(key.value));
    block_low.fill(low(kDerivation));
    NumberPacket words;
    random_blocks(key_low, key_high, parts, part_high, block_low, high(kDerivation), words);
    streams.key_low = words.words[0];
    streams.key_high = words.words[1];
}

}  // namespace stilb::math
