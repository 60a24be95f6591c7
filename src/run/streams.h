// The families of random streams of a run: parts of the key of its seed.
#pragma once

#include <cstdint>

#include "math/random.h"

namespace stilb::run {

enum class RunStream : std::uint64_t {
    readings,
    glare,
    picture,
    picture_offset,
    picture_cells,
    picture_comparison,
    walks,
    gathering
};

inline math::KeyOf<RunStream> key_of_seed(std::uint64_t seed) { return {{seed}}; }

}  // namespace stilb::run
