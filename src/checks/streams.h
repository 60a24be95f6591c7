// The random streams of checks: the same in every run, so that a scene always gets the same words.
#pragma once

#include <cstdint>

#include "math/random.h"

namespace stilb::checks {

enum class CheckStream : std::uint64_t {
    from_sensors,
    from_lights,
    pairs,
    lamp_fronts,
    light_origins,
    unlit_particles,
    unlit_connections
};

inline constexpr math::KeyOf<CheckStream> kCheckKey{};

}  // namespace stilb::checks
