#include "estimators/split_plan.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "base/sampling.h"
#include "estimators/fan.h"

namespace stilb {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr unsigned kRays = 32;

// Costs in units of one ray of a fan, and c of the variance model; measured in the example office.
constexpr double kRayCost = 12;   ///< a gathering ray to its hit
constexpr double kPathCost = 40;  ///< the path that goes on from there
constexpr double kPathVariance = 3;

/// nu of every point: what a fan of unit fluxes on white surfaces adds up to is nu per chain. Its kernel is
/// bounded by the mean density in the scene, so that single near nodes do not count.
std::vector<double> node_densities_per_m2(const RayCaster& caster, std::span<const MeasuringPoint> points,
                                          std::span<const ChainNode> nodes, double chains,
                                          double mean_per_m2) {
    const Material white = Diffuse{Spectrum::grey(1)};
    std::vector<ChainNode> unit_nodes(nodes.begin(), nodes.end());
    for (ChainNode& node : unit_nodes) {
        node.material = &white;
        node.flux_lm = Spectrum::grey(1);
        node.only_by_light = false;
    }
    ReadingSums seen(points.size());
    const std::vector<double> bounded(points.size(), 16 * kPi * mean_per_m2);
    Fan(caster, points, bounded).collect(unit_nodes, seen);
    std::vector<double> densities(points.size());
    for (std::size_t j = 0; j < points.size(); ++j) {
        densities[j] = std::max(seen.sum[j][0] / chains, 1e-3 * mean_per_m2);
    }
    return densities;
}

/// G [1/m2] of the surfaces that a few cosine-distributed rays meet; 0 for rays that meet none.
std::array<double, kRays> sampled_kernels(const RayCaster& caster, const MeasuringPoint& point,
                                          RandomKey key) {
    const Frame frame = Frame::around(point.normal);
    const Vec3 from = lifted_position(point, caster);
    std::array<double, kRays> kernels{};
    for (unsigned i = 0; i < kRays; ++i) {
        SampleStream stream(key, i);
        const auto [u1, u2] = stream.next_two();
        const Vec3 local = sample_cosine_hemisphere(u1, u2).direction;
        const Vec3 direction = frame.to_world(local);
        const auto hit = caster.closest(from, direction);
        if (hit) kernels[i] = local.z * -dot(hit->normal, direction) / (hit->distance_m * hit->distance_m);
    }
    return kernels;
}

SplitPlan best_plan(std::span<const double> kernels_per_m2, double density_per_m2, double rays_per_chain) {
    SplitPlan best;
    double least = std::numeric_limits<double>::infinity();
    for (int step = -2; step <= 8; ++step) {
        const double k = kPi * density_per_m2 * std::ldexp(1.0, step);
        double fan_moment = 0, gathered = 0;
        for (const double g : kernels_per_m2) {
            const double w = k / (k + g);
            fan_moment += w * w * g / kRays;
            gathered += (1 - w) / kRays;
        }
        for (std::uint64_t chains = 4; chains <= kMostChainsPerRay; chains *= 4) {
            const double per_ray = static_cast<double>(chains);
            const double variance = fan_moment / (kPi * density_per_m2) + per_ray * kPathVariance * gathered;
            const double cost = rays_per_chain + (kRayCost + kPathCost * gathered) / per_ray;
            if (variance * cost < least) {
                least = variance * cost;
                best = {k, chains};
            }
        }
    }
    return best;
}

}  // namespace

std::vector<SplitPlan> plan_splits(const RayCaster& caster, std::span<const MeasuringPoint> points,
                                   std::span<const ChainNode> pilot_nodes, std::uint64_t pilot_chains,
                                   double scene_area_m2, RandomKey key) {
    const double chains = static_cast<double>(pilot_chains);
    const double nodes_per_chain = (static_cast<double>(pilot_nodes.size()) + 1) / chains;
    const double mean_density = nodes_per_chain / scene_area_m2;
    const auto densities = node_densities_per_m2(caster, points, pilot_nodes, chains, mean_density);
    std::vector<SplitPlan> plans;
    plans.reserve(points.size());
    for (std::size_t j = 0; j < points.size(); ++j) {
        // About half of the nodes face a point.
        plans.push_back(
            best_plan(sampled_kernels(caster, points[j], key.derived(j)), densities[j], nodes_per_chain / 2));
    }
    return plans;
}

}  // namespace stilb
