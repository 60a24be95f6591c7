// Stochastic iteration with ray bundles and first shot, for readings: bundle_iteration.h has the iteration,
// patch_readings.h what is made of it. Each batch is a walk of its own, which leaves out its first steps.
#include "estimators/patch_light/ray_bundle/ray_bundle.h"

#include <algorithm>
#include <bit>

#include "estimators/limits.h"
#include "estimators/patch_light/patch_readings.h"
#include "estimators/patch_light/ray_bundle/bundle_iteration.h"

namespace stilb::estimators {
namespace {

enum Purpose : std::uint64_t { kWalk, kReadings };

class RayBundle final : public Estimator {
  public:
    explicit RayBundle(const EstimatorInput& input)
        : transport_(input.scene, input.caster, input.patches), readings_(transport_, input.measurands) {
        require_all_reflections(input.max_reflections, "ray-bundle");
        require_first_shot_of_points(input.scene, transport_.first_shot.variant() != FirstShotVariant::none,
                                     "ray-bundle");
    }

    void run_batch(const Batch& batch, ReadingSums& sums) const override {
        BundleIteration iteration(transport_, batch.key.derived(kWalk).derived(batch.first));
        for (std::uint64_t i = 0; i < first_steps(transport_); ++i) iteration.step();
        for (std::uint64_t i = batch.first; i < batch.first + batch.count; ++i) {
            iteration.step();
            readings_.add(iteration, batch.key.derived(kReadings), i, sums);
        }
        sums.rays += iteration.rays();
    }

    std::span<const Rgb> known_part() const override { return readings_.known_part(); }
    /// At least twice the first steps that are left out.
    std::uint64_t batch_granularity() const override {
        return std::bit_ceil(std::max<std::uint64_t>(2 * first_steps(transport_), 16));
    }
    double rays_per_sample() const override {
        return 2 * static_cast<double>(transport_.patches.count()) +
               4 * static_cast<double>(known_part().size());
    }
    std::vector<std::string> warnings() const override {
        return patch_warnings(transport_.scene, "ray-bundle");
    }
    std::optional<PatchReport> patch_report() const override { return transport_.report(); }

  private:
    PatchTransport transport_;
    PatchReadings readings_;
};

}  // namespace

std::unique_ptr<Estimator> make_ray_bundle_estimator(const EstimatorInput& input) {
    return std::make_unique<RayBundle>(input);
}

}  // namespace stilb::estimators
