// Options of the methods on patches: plain values, without the machinery.
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

/// The replacement of small lights (first_shot.h).
enum class FirstShotVariant { none, classical, diffuse, incoming, on_the_fly };
inline constexpr std::array<std::string_view, 5> kFirstShotNames{"none", "classical", "diffuse", "incoming",
                                                                 "on-the-fly"};
constexpr std::string_view name_of(FirstShotVariant variant) {
    return kFirstShotNames[static_cast<std::size_t>(variant)];
}

/// The default, except for path tracing, which has none.
inline constexpr FirstShotVariant kUsualFirstShot = FirstShotVariant::incoming;

/// Item buffers.
struct ShootingOptions {
    patches::BufferShape window =
        patches::BufferShape::hemicube;  ///< around samples of area lights; points have cubes
    patches::BufferBackend backend = patches::BufferBackend::rays;
    static constexpr int kAutomatic = 0;  ///< first shot: by the numbers of patches and light samples
    int resolution = 512;
};

struct FirstShotOptions {
    std::optional<FirstShotVariant> variant;  ///< absent: the method's default
    ShootingOptions shooting;
    int bin_rings = 4;  ///< classical: 4 bin_rings^2 bins where reflection depends on direction
};

/// Directions of a step of stochastic iteration (theory 8).
enum class BundleDirections { single, pair, frame };
inline constexpr std::array<std::string_view, 3> kBundleDirectionsNames{"single", "pair", "frame"};
constexpr std::string_view name_of(BundleDirections directions) {
    return kBundleDirectionsNames[static_cast<std::size_t>(directions)];
}

/// The options of methods on patches, without the size of the patches.
struct PatchMethodOptions {
    FirstShotOptions first_shot;
    /// Resolution of first shot's item buffers; absent: by the number of patches.
    std::optional<int> resolution;
    BundleDirections directions = BundleDirections::frame;
    /// Resolution of the item buffers around patches in method radiosity, whose window and backend are first
    /// shot's.
    int shot_resolution = 64;
};

struct PatchOptions : PatchMethodOptions {
    /// Longest edge; absent: by the scene, for about 10,000 patches.
    std::optional<double> patch_m;
};

// Patches and first shot in the results: plain values.

/// First shot's decision on a light.
struct FirstShotLight {
    std::string name;
    bool is_replaced = false;
    std::string why;          ///< in words: "a point", "large: it would take more than 32 vertices ..."
    std::size_t samples = 0;  ///< 0 where it is not replaced
    Rgb colour{};             ///< of its light, with luminance 1; 0 for a dark light
};

/// All values except the time depend on the scene and options alone.
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
