
#include "math/random.h"

#include <Random123/philox.h>

#include <bit>
#include <boost/random/detail/sobol_table.hpp>

namespace stilb::math {

std::array<std::uint32_t, 4> random_block(RandomKey key, std::uint64_t index, std::uint64_t block) {
    const auto low = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
    const auto high = [](std::uint64_t word) { return static_cast<std::uint32_t>(word >> 32); };
    const r123::Philox4x32::ctr_type counter{{low(index), high(index), low(block), high(block)}};
    const r123::Philox4x32::key_type philox_key{{low(key.value), high(key.value)}};
    const r123::Philox4x32::ctr_type words = r123::Philox4x32{}(counter, philox_key);
    return {words[0], words[1], words[2], words[3]};
}

RandomKey RandomKey::derived(std::uint64_t part) const {
    const auto words = random_block(*this, part, kDerivation);
    return {words[0] | std::uint64_t{words[1]} << 32};
}

namespace {

constexpr unsigned kBits = 32;
/// direction_numbers[dimension][k] is the contribution of bit k of the index.
using DirectionNumbers = std::array<std::array<std::uint32_t, kBits>, kSobolDimensions>;

/// The recurrence of Bratley and Fox 1988 on the primitive polynomials and initial numbers of Joe and Kuo.
DirectionNumbers make_direction_numbers() {
    using Table = boost::random::detail::qrng_tables::sobol;
    DirectionNumbers numbers{};
    for (unsigned k = 0; k < kBits; ++k) numbers[0][k] = 1u << (kBits - 1 - k);
    for (unsigned dimension = 1; dimension < kSobolDimensions; ++dimension) {
        auto& v = numbers[dimension];
        const std::uint32_t polynomial = Table::polynomial(dimension - 1);
        const unsigned degree = static_cast<unsigned>(std::bit_width(polynomial)) - 1;
        for (unsigned k = 0; k < kBits; ++k) {
            if (k < degree) {
                v[k] = std::uint32_t{Table::minit(dimension - 1, k)} << (kBits - 1 - k);
                continue;
            }
            v[k] = v[k - degree] ^ (v[k - degree] >> degree);
            for (unsigned j = 1; j < degree; ++j) {
                if ((polynomial >> (degree - j)) & 1u) v[k] ^= v[k - j];
            }
        }
    }
    return numbers;
}

const DirectionNumbers& direction_numbers() {
    static const DirectionNumbers numbers = make_direction_numbers();
    return numbers;
}

DirectionNumbers reversed_numbers() {
    DirectionNumbers numbers = direction_numbers();
    for (auto& of_dimension : numbers) {
        for (std::uint32_t& number : of_dimension) number = reversed_bits(number);
    }
    return numbers;
}

}  // namespace

std::uint32_t sobol(std::uint32_t index, unsigned dimension) {
    const auto& numbers = direction_numbers()[dimension];
    std::uint32_t result = 0;
    for (; index != 0; index &= index - 1) result ^= numbers[std::countr_zero(index)];
    return result;
}

const std::array<std::uint32_t, kBits>& reversed_direction_numbers(unsigned dimension) {
    static const DirectionNumbers numbers = reversed_numbers();
    return numbers[dimension];
}

std::uint32_t scrambled_sobol(std::uint32_t index, unsigned dimension, std::uint32_t scramble) {
    return reversed_bits(permuted_upwards(reversed_bits(sobol(index, dimension)), scramble));
}

SampleStream SampleStream::continued(RandomKey key) const {
    return SampleStream(key, index_, sobol_dimensions_).from(next_block());
}

std::array<std::uint32_t, 4> SampleStream::words_from(unsigned dimension) const {
    if (dimension >= sobol_dimensions_) return random_block(key_, index_, dimension / 4);
    // Four dimensions' scrambles come from one block, which belongs to the key alone, not to the index.
    std::array<std::uint32_t, 4> words = random_block(key_, kScrambles, dimension / 4);
    for (unsigned lane = 0; lane < 4; ++lane) {
        words[lane] = scrambled_sobol(static_cast<std::uint32_t>(index_), dimension + lane, words[lane]);
    }
    return words;
}

}  // namespace stilb::math
