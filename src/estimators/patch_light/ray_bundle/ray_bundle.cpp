// Stochastic iteration with ray bundles and first shot: bundle_iteration.h describes the iteration,
// patch_readings.h readings and pictures. For readings each batch is a walk of its own,
// without its first steps; a pass over a picture is the mean over the steps of some walks.

#include <algorithm>
#include <array>
#include <bit>

#include "base/parallel.h"
#include "estimators/estimator_list.h"
#include "estimators/limits.h"
#include "estimators/patch_light/patch_readings.h"
#include "estimators/patch_light/ray_bundle/bundle_iteration.h"

namespace stilb::estimators {
namespace {

constexpr std::string_view kRayBundle = "ray-bundle";

PatchTransport bundle_transport(const Problem& problem) {
    const FirstShotVariant variant = problem.patches.first_shot.variant.value_or(kUsualFirstShot);
    require_all_reflections(problem.max_reflections, kRayBundle);
    require_first_shot_of_points(problem.scene, variant, kRayBundle);
    return {problem.scene, problem.caster, problem.patches, problem.monitor};
}

double rays_per_step(const PatchTransport& transport) {
    return 2 * static_cast<double>(transport.patches.count());
}

class RayBundle final : public Estimator {
  public:
    explicit RayBundle(const Problem& problem)
        : transport_(bundle_transport(problem)),
          readings_(transport_, problem.measurands, rays_per_step(transport_), problem.monitor),
          monitor_(problem.monitor) {
        if (!problem.camera) return;
        tracing_.emplace(problem, transport_.lights);
        seen_.emplace(transport_, tracing_->view.position());
    }

    std::string_view technique() const override { return kRayBundle; }
    void run_batch(const Batch& batch, Tally& sums) const override {
        BundleIteration iteration(transport_, {batch.key.derived(BatchStream::walk).derived(batch.first)});
        const auto step = [&] {
            monitor_.require_more();
            iteration.step();
        };
        for (std::uint64_t i = 0; i < first_steps(transport_); ++i) step();
        for (std::uint64_t i = batch.first; i < batch.first + batch.count; ++i) {
            step();
            readings_.add(iteration, {batch.key.derived(BatchStream::patch_readings)}, i, sums);
        }
        sums.rays += iteration.rays();
    }

    std::span<const Rgb> known_part() const override { return readings_.known_part(); }
    std::span<const std::optional<Vec3>> sight_ends() const override { return readings_.sight_ends(); }
    /// At least twice the first steps that are left out.
    std::uint64_t batch_granularity() const override {
        return std::bit_ceil(std::max<std::uint64_t>(2 * first_steps(transport_), 16));
    }
    double rays_per_sample() const override {
        return rays_per_step(transport_) + 4 * static_cast<double>(known_part().size());
    }

    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        return std::make_unique<PatchPass>(*tracing_, transport_, pass, mean_of_walks(pass));
    }
    std::vector<std::string> warnings() const override {
        return patch_warnings(transport_.scene, kRayBundle);
    }
    std::optional<PatchReport> patch_report() const override { return transport_.report(); }

  private:
    /// Walks of a pass, each a task of its own.
    static constexpr std::uint64_t kWalks = 4;
    /// Counted steps of a walk.
    static constexpr std::uint64_t kLeastSteps = 8;

    std::vector<FloatRgb> mean_of_walks(const Pass& pass) const {
        const std::uint64_t first = first_steps(transport_), steps = std::max(first, kLeastSteps);
        const math::RandomKey key = pass.key.derived(PassStream::walk).derived(pass.index);
        std::array<std::vector<FloatRgb>, kWalks> sums;
        parallel_for(kWalks, [&](std::uint64_t walk) {
            sums[walk].resize(seen_->count());
            BundleIteration iteration(transport_, {key.derived(walk)});
            for (std::uint64_t i = 0; i < first; ++i) iteration.step();
            for (std::uint64_t i = 0; i < steps; ++i) {
                iteration.step();
                seen_->add(iteration, sums[walk]);
            }
        });
        for (std::size_t walk = 1; walk < kWalks; ++walk) add_to(sums[0], sums[walk]);
        return seen_->mean_cd_m2(sums[0], static_cast<double>(kWalks * steps));
    }

    PatchTransport transport_;
    PatchReadings readings_;
    const Monitor& monitor_;
    std::optional<PictureTracing> tracing_;
    std::optional<VisibleSides> seen_;
};

}  // namespace

std::unique_ptr<Estimator> make_ray_bundle(const Problem& problem) {
    return std::make_unique<RayBundle>(problem);
}

}  // namespace stilb::estimators
