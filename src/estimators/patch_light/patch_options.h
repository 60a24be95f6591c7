// How methods that light patches are asked to do it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "estimators/patch_light/first_shot/first_shot.h"

namespace stilb::estimators {

/// Directions of a step of stochastic iteration (theory 8).
enum class BundleDirections { single, pair, frame };
inline constexpr std::array<std::string_view, 3> kBundleDirectionsNames{"single", "pair", "frame"};
constexpr std::string_view name_of(BundleDirections directions) {
    return kBundleDirectionsNames[static_cast<std::size_t>(directions)];
}

struct PatchOptions {
    /// Longest edge; by the scene where absent: about 10,000 patches.
    std::optional<double> patch_m;
    FirstShotOptions first_shot;
    /// Of first shot's item buffers; by the number of patches where absent.
    std::optional<int> resolution;
    BundleDirections directions = BundleDirections::frame;
    /// Of the item buffers around patches of method radiosity, whose window and backend are first shot's.
    int shot_resolution = 64;
};

}  // namespace stilb::estimators
