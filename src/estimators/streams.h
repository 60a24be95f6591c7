// The families of random streams of estimators: one enumeration for each key, so that no two purposes share
// a stream.
#pragma once

#include <cstdint>

namespace stilb::estimators {

/// Parts of the key of decisions before sampling starts.
enum class PreparationStream : std::uint64_t {
    path_pilot = 0,
    light_paths_pilot = 1,
    guided_pilot = 2,
    direct = 2,
    light_paths = 4,
    plan = 5,
    guided_picture = 8,
    picture_light_paths = 4096 + 3,
    picture_plan = 4096 + 4,
    guess = 1 << 16
};

/// Parts of a batch's key.
enum class BatchStream : std::uint64_t {
    camera_paths = 100,
    light_paths = 0,
    selection = 1,
    direct = 2,
    gather = 3,
    faint = 6,
    residual = 0,
    residual_selection = 1,
    guess_rays = 2,
    shift = 3,
    continued_rays = 4,
    general_rays = 5,
    dark = 6,
    particles = 2,
    evaluations = 3,
    walk = 0,
    patch_readings = 1
};

/// Parts of a pass's key.
enum class PassStream : std::uint64_t {
    pixels = 1,
    direct = 1 << 10,
    light_paths = 1 << 12,
    selection = (1 << 12) + 1,
    gather = (1 << 12) + 2,
    residual = 2,
    guess_points = 3,
    residual_selection = 4,
    guess_rays = 5,
    continued_rays = 6,
    shift = 7,
    particles = 2,
    walk = 2
};

}  // namespace stilb::estimators
