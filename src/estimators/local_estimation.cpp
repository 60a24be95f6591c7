// Local estimation: illuminance at all points from one set of light chains, by the kernel split (theory T.1b)
//
//   E(x) = E_direct + sum over nodes of W f_r w G + integral of L_r (1 - w) cos(theta_x) dw,    w = k / (k +
//   G).
//
//   local   k = infinity: the estimator as published [LocalEstimation (5)]; rays from the point bring in only
//   what
//           mirrors show. Infinite variance where chains come arbitrarily near to a point: in corners.
//   auto    k from the density of nodes that the point sees, which balances both ways of making the same
//   light
//           (see split_constants_per_m2). Unbiased and of finite variance everywhere.
//
// Not made: light from point-like sources that reaches a point, or a surface that it sees by a mirror,
// through mirrors alone; the run warns of it.
#include "estimators/local_estimation.h"

#include <limits>

#include "estimators/direct_light.h"
#include "estimators/fan.h"
#include "estimators/gather.h"
#include "estimators/limits.h"
#include "estimators/split_plan.h"

namespace stilb {
namespace {

/// Light chains for each sample of direct light from area lights.
constexpr std::uint64_t kChainsPerDirectSample = 8;
/// Chains whose nodes are sent to the points together.
constexpr std::uint64_t kChainBlock = 256;
/// Chains that are spent on planning; few suffice, because any plan is unbiased.
constexpr std::uint64_t kPilotChains = 256;

enum Purpose : std::uint64_t { kChains, kDirect, kGather, kPilot, kPlan };

class LocalEstimation final : public Estimator {
  public:
    enum class Split { none, balanced };

    LocalEstimation(const EstimatorInput& input, Split split)
        : scene_(input.scene),
          caster_(input.caster),
          points_(packed(input.points, caster_)),
          max_reflections_(input.max_reflections),
          lights_(scene_, caster_),
          tracer_(scene_, caster_, lights_),
          gathers_(split == Split::balanced || has_mirrors(scene_)),
          plans_(plans(split, input.preparation_key)),
          fan_(caster_, points_, constants_per_m2(plans_)),
          gather_(caster_, tracer_, points_, plans_, max_reflections_),
          known_part_lx_(points_.size()) {
        for (const PackedPoint& point : points_) {
            known_part_lx_[point.reading] =
                direct_from_points_lx(point.position, point.normal, caster_, lights_);
        }
    }

    void run_batch(const Batch& batch, ReadingSums& sums) const override {
        const RandomKey chain_key = batch.key.derived(kChains);
        const std::uint64_t end = batch.first + batch.count;
        for (std::uint64_t first = batch.first; first < end; first += kChainBlock) {
            fan_.collect(walk_chains(chain_key, first, std::min(end, first + kChainBlock)), sums);
        }
        if (lights_.has_area_lights()) add_direct_light(batch, sums);
        if (gathers_) gather_.collect({batch.key.derived(kGather), batch.first, batch.count}, sums);
    }

    std::span<const Spectrum> known_part_lx() const override { return known_part_lx_; }
    std::uint64_t batch_granularity() const override { return kMostChainsPerRay; }
    double rays_per_sample() const override { return 2.0 * static_cast<double>(points_.size()); }
    std::vector<std::string> warnings() const override {
        return mirror_warnings(
            scene_,
            "local estimation cannot make light that goes from a point or photometry light "
            "to the point, or to what the point sees in a mirror, by mirrors alone");
    }

  private:
    std::vector<ChainNode> walk_chains(RandomKey key, std::uint64_t first, std::uint64_t end) const {
        std::vector<ChainNode> nodes;
        for (std::uint64_t chain = first; chain < end; ++chain) {
            walk_light_chain(scene_, caster_, lights_, max_reflections_, SampleStream(key, chain), nodes);
        }
        return nodes;
    }

    void add_direct_light(const Batch& batch, ReadingSums& sums) const {
        const RandomKey key = batch.key.derived(kDirect);
        const std::uint64_t end = (batch.first + batch.count) / kChainsPerDirectSample;
        for (std::size_t j = 0; j < points_.size(); ++j) {
            const RandomKey point_key = key.derived(j);
            for (std::uint64_t i = batch.first / kChainsPerDirectSample; i < end; ++i) {
                SampleStream stream(point_key, i);
                const Spectrum sample = sample_direct_from_areas_lx(points_[j].position, points_[j].normal,
                                                                    caster_, lights_, stream);
                sums.add(points_[j].reading, static_cast<double>(kChainsPerDirectSample) * sample);
            }
        }
    }

    std::vector<SplitPlan> plans(Split split, RandomKey key) const {
        if (split == Split::none) {
            return std::vector<SplitPlan>(points_.size(),
                                          {std::numeric_limits<double>::infinity(), kChainsPerDirectSample});
        }
        double area = 0;
        for (const Object& object : scene_.objects) area += area_m2(object.shape);
        return plan_splits(caster_, points_, walk_chains(key.derived(kPilot), 0, kPilotChains), kPilotChains,
                           std::max(area, std::numeric_limits<double>::min()), key.derived(kPlan));
    }

    static std::vector<double> constants_per_m2(std::span<const SplitPlan> plans) {
        std::vector<double> constants;
        for (const SplitPlan& plan : plans) constants.push_back(plan.k_per_m2);
        return constants;
    }

    const Scene& scene_;
    const RayCaster& caster_;
    PackedPoints points_;
    int max_reflections_;
    LightSampler lights_;
    PathTracer tracer_;
    bool gathers_;
    std::vector<SplitPlan> plans_;
    Fan fan_;
    Gather gather_;
    std::vector<Spectrum> known_part_lx_;
};

}  // namespace

std::unique_ptr<Estimator> make_local_estimator(const EstimatorInput& input) {
    return std::make_unique<LocalEstimation>(input, LocalEstimation::Split::none);
}

std::unique_ptr<Estimator> make_auto_estimator(const EstimatorInput& input) {
    return std::make_unique<LocalEstimation>(input, LocalEstimation::Split::balanced);
}

}  // namespace stilb
