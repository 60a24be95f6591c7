#include "math/random.h"

#include <Random123/philox.h>

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
    constexpr std::uint64_t derivation = ~std::uint64_t{0};  // a block that no stream reaches
    const auto words = random_block(*this, part, derivation);
    return {words[0] | std::uint64_t{words[1]} << 32};
}

}  // namespace stilb::math
