// How pictures are estimated: pass by pass, each one sample of every pixel, in blocks of pixels.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/rgb.h"
#include "estimators/patch_light/patch_options.h"
#include "estimators/patch_light/patch_report.h"
#include "math/random.h"
#include "rays/ray_caster.h"
#include "sensors/camera.h"

namespace stilb::estimators {

/// A part of the picture that is worked on at a time.
struct PixelBlock {
    int left = 0, top = 0, width = 0, height = 0;
};

/// Edge of the largest blocks.
inline constexpr int kBlockSize = 16;

/// The blocks of a picture, row by row; the first reaches down to `offset` (each from 1 to kBlockSize).
std::vector<PixelBlock> blocks_of(const std::array<int, 2>& resolution,
                                  const std::array<int, 2>& offset = {kBlockSize, kBlockSize});

/// Sample `index` of the replicate that `key` stands for. What a pass makes of a block depends on these and
/// the block alone.
struct Pass {
    math::RandomKey key;
    std::uint64_t index = 0;
    std::uint64_t replicate = 0;  ///< its number, for what was computed before
};

/// A pass with what its blocks have in common.
class PicturePass {
  public:
    virtual ~PicturePass() = default;

    /// One unbiased sample of every pixel's luminance [cd/m2] of a block, row by row; returns the number of
    /// samples that were not finite: these are 0. Blocks may run in parallel.
    virtual std::uint64_t sample(const PixelBlock& block, std::span<Rgb> pixels) const = 0;
};

class PictureEstimator {
  public:
    virtual ~PictureEstimator() = default;

    /// Keeps a reference to the estimator.
    virtual std::unique_ptr<const PicturePass> start(const Pass& pass) const = 0;
    /// What the method cannot make in this scene, for the user; empty where nothing is missing.
    virtual std::vector<std::string> warnings() const = 0;
    /// Where patches stand for surfaces.
    virtual std::optional<PatchReport> patch_report() const { return std::nullopt; }
};

/// The estimator keeps references to scene and caster.
struct PictureInput {
    const Scene& scene;
    const rays::RayCaster& caster;
    Camera camera;
    int max_reflections;
    /// For decisions that are taken before sampling starts; independent of all passes' keys.
    math::RandomKey preparation_key;
    /// For methods that light patches.
    PatchOptions patches = {};
};

}  // namespace stilb::estimators
