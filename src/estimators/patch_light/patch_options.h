// How methods that light patches are asked to do it: plain values, without the machinery.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/rgb.h"
#include "patches/visibility/buffer_options.h"

namespace stilb::estimators {

/// What stands for small lights (first_shot.h).
enum class FirstShotVariant { none, classical, diffuse, incoming, on_the_fly };
inline constexpr std::array<std::string_view, 5> kFirstShotNames{"none", "classical", "diffuse", "incoming",
                                                                 "on-the-fly"};
constexpr std::string_view name_of(FirstShotVariant variant) {
    return kFirstShotNames[static_cast<std::size_t>(variant)];
}

/// Where none is asked for, but for path tracing: that takes none.
inline constexpr FirstShotVariant kUsualFirstShot = FirstShotVariant::incoming;

/// Item buffers.
struct ShootingOptions {
    patches::BufferShape window =
        patches::BufferShape::hemicube;  ///< around samples of area lights; points have cubes
    patches::BufferBackend backend = patches::BufferBackend::rays;
    int resolution = 512;
};

struct FirstShotOptions {
    std::optional<FirstShotVariant> variant;  ///< absent: as is usual with the method
    ShootingOptions shooting;
    int bin_rings = 4;  ///< classical: 4 bin_rings^2 bins where reflection depends on direction
};

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

// What became of surfaces and lights where patches stand for them, for the results: plain values.

/// What first shot made of a light.
struct FirstShotLight {
    std::string name;
    bool is_replaced = false;
    std::string why;          ///< in words: "a point", "large: it would take more than 32 vertices ..."
    std::size_t samples = 0;  ///< 0 where it is not replaced
    Rgb colour{};             ///< of its light: luminance 1; nothing where it is dark
};

/// All but the time is the same whenever the same is computed.
struct PatchReport {
    std::size_t count = 0;  ///< of patches
    double size_m = 0;      ///< no edge is longer
    FirstShotVariant first_shot = FirstShotVariant::none;
    std::optional<int> resolution;       ///< of first shot's item buffers, where there are any
    std::size_t missed = 0;              ///< as FirstShot::missed()
    double bytes_per_patch = 0;          ///< stored by first shot
    double set_up_s = 0;                 ///< of first shot
    std::vector<FirstShotLight> lights;  ///< as Scene::lights
};

}  // namespace stilb::estimators
