// Stochastic iteration with ray bundles and first shot, for pictures: bundle_iteration.h has the iteration. A
// pass is the mean over the steps of some walks.
#include "estimators/patch_light/ray_bundle/picture_bundle.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "estimators/limits.h"
#include "estimators/patch_light/patch_picture.h"
#include "estimators/patch_light/ray_bundle/bundle_iteration.h"

namespace stilb::estimators {
namespace {

/// Of a pass, each a task of its own.
constexpr std::uint64_t kWalks = 4;
/// Of a walk, that count.
constexpr std::uint64_t kLeastSteps = 8;

enum Purpose : std::uint64_t { kWalk = kPixels + 1 };

class BundlePicture final : public PictureEstimator {
  public:
    explicit BundlePicture(const PictureInput& input)
        : tracing_(input),
          transport_(input.scene, input.caster, input.patches),
          seen_(transport_, tracing_.view.position()) {
        require_all_reflections(input.max_reflections, "ray-bundle");
        require_first_shot_of_points(input.scene, transport_.first_shot.variant() != FirstShotVariant::none,
                                     "ray-bundle");
    }

    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        return std::make_unique<PatchPass>(tracing_, transport_, pass, mean_of_walks(pass));
    }
    std::vector<std::string> warnings() const override {
        return patch_warnings(transport_.scene, "ray-bundle");
    }
    std::optional<PatchReport> patch_report() const override { return transport_.report(); }

  private:
    std::vector<FloatRgb> mean_of_walks(const Pass& pass) const {
        const std::uint64_t first = first_steps(transport_), steps = std::max(first, kLeastSteps);
        const math::RandomKey key = pass.key.derived(kWalk).derived(pass.index);
        std::array<std::vector<FloatRgb>, kWalks> sums;
        tbb::parallel_for(std::uint64_t{0}, kWalks, [&](std::uint64_t walk) {
            sums[walk].resize(seen_.count());
            BundleIteration iteration(transport_, key.derived(walk));
            for (std::uint64_t i = 0; i < first; ++i) iteration.step();
            for (std::uint64_t i = 0; i < steps; ++i) {
                iteration.step();
                seen_.add(iteration, sums[walk]);
            }
        });
        for (std::size_t walk = 1; walk < kWalks; ++walk) add_to(sums[0], sums[walk]);
        return seen_.mean_cd_m2(sums[0], static_cast<double>(kWalks * steps));
    }

    PictureTracing tracing_;
    PatchTransport transport_;
    VisibleSides seen_;
};

}  // namespace

std::unique_ptr<PictureEstimator> make_ray_bundle_picture(const PictureInput& input) {
    return std::make_unique<BundlePicture>(input);
}

}  // namespace stilb::estimators
