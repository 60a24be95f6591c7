// The families of random streams of a run: parts of the key of its seed.
#pragma once

#include <cstdint>

#include "math/random.h"

namespace stilb::run {

enum class RunStream : std::uint64_t {
    walks = 0,
    gathering = 1,
    readings = 1,
    glare = 2,
    picture = 1,
    picture_offset = 2,
    picture_comparison = 3,
    picture_cells = 4
};

inline math::KeyOf<RunStream> key_of_seed(std::uint64_t seed) { return {{seed}}; }

}  // namespace stilb::run
