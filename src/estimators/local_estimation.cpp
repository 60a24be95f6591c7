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
#include <numbers>

#include "estimators/direct_light.h"
#include "estimators/fan.h"
#include "estimators/gather.h"
#include "estimators/limits.h"

namespace stilb {
namespace {

/// One sample of direct light and one gathering ray for so many chains: a gathering ray costs some twenty
/// times what a ray of a fan does, and has less to bring.
constexpr std::uint64_t kChainsPerRay = 8;
/// Chains whose nodes are sent to the points together.
constexpr std::uint64_t kChainBlock = 256;
/// Chains that are spent on finding k; few suffice, because any k > 0 is unbiased.
constexpr std::uint64_t kPilotChains = 256;

enum Purpose : std::uint64_t { kChains, kRays };

class LocalEstimation final : public Estimator {
  public:
    enum class Split { none, balanced };

    LocalEstimation(const EstimatorInput& input, Split split)
        : scene_(input.scene),
          caster_(input.caster),
          points_(input.points.begin(), input.points.end()),
          max_reflections_(input.max_reflections),
          lights_(scene_, caster_),
          tracer_(scene_, caster_, lights_),
          gathers_(split == Split::balanced || has_mirrors(scene_)),
          k_per_m2_(split_constants_per_m2(split, input.preparation_key)),
          fan_(caster_, points_, k_per_m2_) {
        for (const MeasuringPoint& point : points_) {
            known_part_lx_.push_back(direct_from_points_lx(point, caster_, lights_));
        }
    }

    void run_batch(const Batch& batch, ReadingSums& sums) const override {
        const RandomKey chain_key = batch.key.derived(kChains);
        const std::uint64_t end = batch.first + batch.count;
        for (std::uint64_t first = batch.first; first < end; first += kChainBlock) {
            fan_.collect(walk_chains(chain_key, first, std::min(end, first + kChainBlock)), sums);
        }
        if (gathers_ || lights_.has_area_lights()) add_rays(batch, sums);
    }

    std::span<const Spectrum> known_part_lx() const override { return known_part_lx_; }
    std::uint64_t batch_granularity() const override { return kChainsPerRay; }
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

    void add_rays(const Batch& batch, ReadingSums& sums) const {
        const RandomKey key = batch.key.derived(kRays);
        for (std::size_t j = 0; j < points_.size(); ++j) {
            const RandomKey point_key = key.derived(j);
            for (std::uint64_t i = batch.first / kChainsPerRay;
                 i < (batch.first + batch.count) / kChainsPerRay; ++i) {
                SampleStream stream(point_key, i);
                Spectrum sample = sample_direct_from_areas_lx(points_[j], caster_, lights_, stream);
                if (gathers_) {
                    sample += sample_gathered_lx(points_[j], k_per_m2_[j], max_reflections_, caster_, tracer_,
                                                 stream);
                }
                sums.add(j, static_cast<double>(kChainsPerRay) * sample);
            }
        }
    }

    /// The balance heuristic's k: chains place nodes at y with density nu(y) [1/m2] each, gathering rays
    /// arrive there with density G / pi, so w = nu c / (nu c + G / pi) for c chains per ray. Instead of
    /// nu(y), its mean over what x sees, (1/pi) times the mean of the sum of G over a chain's nodes,
    /// estimated by pilot chains of their own; G is bounded by half of the same kernel split with the mean
    /// density in the scene, so that single near nodes do not count.
    std::vector<double> split_constants_per_m2(Split split, RandomKey key) const {
        if (split == Split::none) {
            return std::vector<double>(points_.size(), std::numeric_limits<double>::infinity());
        }
        std::vector<ChainNode> nodes = walk_chains(key, 0, kPilotChains);
        double area = 0;
        for (const Object& object : scene_.objects) area += area_m2(object.shape);
        const double per_ray = static_cast<double>(kChainsPerRay);
        const double chains = static_cast<double>(kPilotChains);
        const double mean_k = std::numbers::pi * per_ray * (static_cast<double>(nodes.size()) + 1) /
                              (chains * std::max(area, 1e-300));
        // A unit of flux on a white surface: the fan then adds w G / pi for every node.
        const Material white = Diffuse{Spectrum::grey(1)};
        for (ChainNode& node : nodes) {
            node = {node.position, node.normal, node.incoming, &white, Spectrum::grey(1), false};
        }
        ReadingSums seen(points_.size());
        const std::vector<double> first_k(points_.size(), mean_k);
        Fan(caster_, points_, first_k).collect(nodes, seen);
        std::vector<double> k(points_.size());
        for (std::size_t j = 0; j < points_.size(); ++j) {
            const double density_per_m2 = seen.sum[j][0] / chains;
            k[j] = std::max(std::numbers::pi * per_ray * density_per_m2, 1e-3 * mean_k);
        }
        return k;
    }

    const Scene& scene_;
    const RayCaster& caster_;
    std::vector<MeasuringPoint> points_;
    int max_reflections_;
    LightSampler lights_;
    PathTracer tracer_;
    bool gathers_;
    std::vector<double> k_per_m2_;
    Fan fan_;
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
