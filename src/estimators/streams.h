// The families of random streams of estimators: one enumeration for each key, so that no two purposes share
// a stream.
#pragma once

#include <cstdint>

namespace stilb::estimators {

/// Parts of the key of decisions before sampling starts.
enum class PreparationStream : std::uint64_t {
    path_pilot,
    light_paths_pilot,
    guided_pilot,
    guess,
    light_paths,
    direct,
    plan,
    picture_light_paths,
    picture_plan,
    guided_picture
};

/// Parts of a batch's key.
enum class BatchStream : std::uint64_t {
    camera_paths,
    light_paths,
    selection,
    direct,
    gather,
    faint,
    residual,
    residual_selection,
    guess_rays,
    continued_rays,
    general_rays,
    shift,
    dark,
    particles,
    walk,
    patch_readings
};

/// Parts of a pass's key.
enum class PassStream : std::uint64_t {
    pixels,
    direct,
    light_paths,
    selection,
    gather,
    plan_rays,
    residual,
    residual_selection,
    guess_points,
    guess_rays,
    continued_rays,
    shift,
    particles,
    walk
};

}  // namespace stilb::estimators
