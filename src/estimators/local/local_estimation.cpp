// Local estimation: illuminance at all points from one set of light chains, by the kernel split (theory T.1b)
//
//   E(x) = E_direct + sum over nodes of W f_r w G + integral of L_r (1 - w) s_x dw
//
// with w = k / (k + s G) of kernel_split.h. Double local estimation: luminance, by the same sums with the
// response of the sub-points that are seen (receiver.h, theory T.2).
//
//   local         k = infinity: the estimator as published [LocalEstimation (5)]. Rays from the point bring
//                 in only what mirrors and glass show. Infinite variance where chains come arbitrarily near
//                 to a point: in corners.
//   double-local  the same for luminance [LocalEstimation (8) to (10)]; local at illuminance readings.
//   auto          k and the number of gathering rays by plan_splits(), nodes from a NodePool. Unbiased and
//                 of finite variance, but for light that only chains can make (it met a mirror or glass
//                 first): w = 1.
//
// Not made: light that leaves a point-like source, meets a mirror or glass first and comes to the receiver by
// a mirror or glass last; the run warns of it.
#include "estimators/local/local_estimation.h"

#include <limits>

#include "estimators/limits.h"
#include "estimators/local/connection.h"
#include "estimators/local/gather.h"
#include "estimators/local/node_selection.h"
#include "estimators/local/split_plan.h"
#include "transport/direct_light.h"

namespace stilb::estimators {
namespace {

/// Nodes are sent to the points after so many chains per selected one (below).
constexpr std::uint64_t kChainBlock = 512;
/// Chains (divided by the selection's share) for each sample of direct light from area lights.
constexpr std::uint64_t kChainsPerDirectSample = 2;
/// Chains for each ray that `local` sends out where there are mirrors or glass.
constexpr std::uint64_t kChainsPerSpecularRay = 4;
/// Chains that are spent on planning; few suffice, because any plan is unbiased.
constexpr std::uint64_t kPilotChains = 256;

enum Purpose : std::uint64_t { kChains, kSelection, kDirect, kGather, kPilot, kPlan, kFaint };

/// Of so many chains' nodes `auto` sends one chain's to the points: a chain costs some 50 rays of a fan, so
/// the more points there are the more is gained by choosing well; the square root balances the cost and the
/// variance of both.
std::uint64_t chains_per_selected(std::size_t points) {
    std::uint64_t chains = 1;
    while (chains < 64 && 80 * chains * chains <= points) chains *= 2;
    return chains;
}

class LocalEstimation final : public Estimator {
  public:
    enum class Split { none, balanced };

    LocalEstimation(const EstimatorInput& input, Split split)
        : scene_(input.scene),
          caster_(input.caster),
          max_reflections_(input.max_reflections),
          lights_(scene_, caster_),
          tracer_(scene_, caster_, lights_),
          seen_(receive(input.measurands)),
          gathers_(split == Split::balanced || has_specular_surfaces(scene_)),
          chains_per_selected_(split == Split::balanced ? chains_per_selected(seen_.receivers.size()) : 1),
          plans_(plans(split, input.weights, input.preparation_key)),
          tiles_(tiles_of(seen_.receivers, constants_per_m2(plans_), caster_, max_reflections_)),
          fan_(caster_, tiles_),
          gather_(caster_, tracer_, tiles_, plans_) {}

    void run_batch(const Batch& batch, ReadingSums& sums) const override {
        const std::uint64_t end = batch.first + batch.count;
        const std::uint64_t block = kChainBlock * chains_per_selected_;
        for (std::uint64_t first = batch.first; first < end; first += block) {
            fan_.collect(fan_nodes(batch.key, first, std::min(end, first + block)), sums);
        }
        if (lights_.has_area_lights()) add_direct_light(batch, sums);
        if (gathers_) gather_.collect({batch.key.derived(kGather), batch.first, batch.count}, sums);
        add_faint_ways(batch, sums);
    }

    std::span<const Rgb> known_part() const override { return seen_.known_part; }
    std::uint64_t batch_granularity() const override { return kMostChainsPerRay * chains_per_selected_; }
    double rays_per_sample() const override {
        constexpr double chain_cost = 50;
        return chain_cost +
               2.0 * static_cast<double>(seen_.receivers.size()) / static_cast<double>(chains_per_selected_);
    }
    std::vector<std::string> warnings() const override { return local_warnings(scene_); }

  private:
    std::vector<transport::LightVertex> walk_chains(math::RandomKey key, std::uint64_t first,
                                                    std::uint64_t end) const {
        return trace_light_paths(scene_, caster_, lights_, max_reflections_, key, first, end);
    }

    std::vector<transport::LightVertex> fan_nodes(math::RandomKey key, std::uint64_t first,
                                                  std::uint64_t end) const {
        std::vector<transport::LightVertex> nodes = walk_chains(key.derived(kChains), first, end);
        if (chains_per_selected_ == 1) return nodes;
        const double u = math::SampleStream(key.derived(kSelection).derived(first), 0).next();
        return NodePool(nodes).select(nodes.size() / chains_per_selected_ + 1, u);
    }

    /// What the readings are made from.
    struct Seen {
        std::vector<transport::Receiver> receivers;
        struct Faint {
            std::uint32_t reading = 0;
            transport::FaintRay way;
        };
        std::vector<Faint> faint;
        std::vector<Rgb> known_part;
    };
    Seen receive(std::span<const Measurand> measurands) const {
        Seen seen;
        seen.known_part.resize(measurands.size());
        for (std::uint32_t reading = 0; reading < measurands.size(); ++reading) {
            const Measurand& measurand = measurands[reading];
            if (auto receiver = transport::receiver_of_illuminance(reading, measurand, caster_)) {
                seen.receivers.push_back(std::move(*receiver));
                continue;
            }
            const transport::VisibleSurfaces sight =
                look(measurand, scene_, caster_, lights_, max_reflections_);
            seen.known_part[reading] = sight.emission_cd_m2;
            for (const transport::FaintRay& way : sight.faint) seen.faint.push_back({reading, way});
            for (const transport::SubPoint& sub_point : sight.sub_points) {
                if (sub_point.reflections == max_reflections_) continue;
                seen.receivers.emplace_back(reading, sub_point, scene_.material(sub_point.surface.material));
            }
        }
        seen.receivers = sorted_receivers(std::move(seen.receivers));
        for (const transport::Receiver& receiver : seen.receivers) {
            seen.known_part[receiver.reading()] += direct_from_points(receiver, caster_, lights_);
        }
        return seen;
    }

    void add_direct_light(const Batch& batch, ReadingSums& sums) const {
        const math::RandomKey key = batch.key.derived(kDirect);
        const std::uint64_t chains = kChainsPerDirectSample * chains_per_selected_;
        const std::uint64_t end = (batch.first + batch.count) / chains;
        for (std::size_t j = 0; j < seen_.receivers.size(); ++j) {
            const transport::Receiver& receiver = seen_.receivers[j];
            const math::RandomKey own_key = key.derived(j);
            for (std::uint64_t i = batch.first / chains; i < end; ++i) {
                math::SampleStream stream(own_key, i);
                const Rgb sample = sample_direct_from_areas(receiver, caster_, lights_, stream);
                sums.add(receiver.reading(), static_cast<double>(chains) * sample);
            }
        }
    }

    /// So little light comes along these that a path for each granule of chains does.
    void add_faint_ways(const Batch& batch, ReadingSums& sums) const {
        const math::RandomKey key = batch.key.derived(kFaint);
        const std::uint64_t chains = batch_granularity();
        for (std::size_t j = 0; j < seen_.faint.size(); ++j) {
            const auto& [reading, way] = seen_.faint[j];
            const auto hit = caster_.closest(way.origin, way.direction);
            if (!hit) continue;
            for (std::uint64_t i = batch.first / chains; i < (batch.first + batch.count) / chains; ++i) {
                math::SampleStream stream(key.derived(j), i);
                const Rgb luminance =
                    tracer_.luminance(*hit, way.direction, max_reflections_ - way.reflections, stream);
                sums.add(reading, static_cast<double>(chains) * way.transmission * luminance);
            }
        }
    }

    std::vector<SplitPlan> plans(Split split, std::span<const double> weights, math::RandomKey key) const {
        if (split == Split::none) {
            return std::vector<SplitPlan>(seen_.receivers.size(),
                                          {std::numeric_limits<double>::infinity(), kChainsPerSpecularRay});
        }
        const std::vector<transport::LightVertex> nodes = walk_chains(key.derived(kPilot), 0, kPilotChains);
        const std::vector<double> direct = pilot_direct(key.derived(kDirect));
        const std::vector<double> alike(weights.empty() ? direct.size() : 0, 1.0);
        const PilotLight pilot{
            nodes, kPilotChains, direct, surface_area_m2(scene_), max_reflections_, chains_per_selected_};
        std::vector<SplitPlan> plans = plan_splits(
            caster_, tracer_, seen_.receivers, weights.empty() ? alike : weights, pilot, key.derived(kPlan));
        for (SplitPlan& plan : plans) plan.chains_per_ray *= chains_per_selected_;
        return plans;
    }

    std::vector<double> pilot_direct(math::RandomKey key) const {
        constexpr int samples = 4;
        std::vector<double> direct;
        for (const Rgb& known : seen_.known_part) direct.push_back(known.luminance());
        for (std::size_t j = 0; j < seen_.receivers.size(); ++j) {
            const transport::Receiver& receiver = seen_.receivers[j];
            for (int i = 0; i < samples; ++i) {
                math::SampleStream stream(key.derived(j), static_cast<std::uint64_t>(i));
                direct[receiver.reading()] +=
                    sample_direct_from_areas(receiver, caster_, lights_, stream).luminance() / samples;
            }
        }
        return direct;
    }

    static std::vector<double> constants_per_m2(std::span<const SplitPlan> plans) {
        std::vector<double> constants;
        for (const SplitPlan& plan : plans) constants.push_back(plan.k_per_m2);
        return constants;
    }

    const Scene& scene_;
    const rays::RayCaster& caster_;
    int max_reflections_;
    transport::LightSampler lights_;
    transport::PathTracer tracer_;
    Seen seen_;
    bool gathers_;
    std::uint64_t chains_per_selected_;
    std::vector<SplitPlan> plans_;
    std::vector<PointTile> tiles_;
    Fan fan_;
    Gather gather_;
};

}  // namespace

std::unique_ptr<Estimator> make_local_estimator(const EstimatorInput& input) {
    return std::make_unique<LocalEstimation>(input, LocalEstimation::Split::none);
}

std::unique_ptr<Estimator> make_auto_estimator(const EstimatorInput& input) {
    return std::make_unique<LocalEstimation>(input, LocalEstimation::Split::balanced);
}

}  // namespace stilb::estimators
