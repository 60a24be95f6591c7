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
constexpr double kPathCost = 70;  ///< the path that goes on from there
constexpr double kPathVariance = 3;
constexpr double kFanVariance = 0.3;  ///< below 1 thanks to the chains' low discrepancy

/// nu of every point: what a fan of unit fluxes on white surfaces adds up to is nu per chain. Its kernel is
/// bounded by the mean density in the scene, so that single near nodes do not count.
std::vector<double> node_densities_per_m2(const RayCaster& caster, std::span<const PackedPoint> points,
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
        densities[j] = std::max(seen.sum[points[j].reading][0] / chains, 1e-3 * mean_per_m2);
    }
    return densities;
}

/// G [1/m2] of the surfaces that a few cosine-distributed rays meet; 0 for rays that meet none.
std::array<double, kRays> sampled_kernels(const RayCaster& caster, const PackedPoint& point, RandomKey key) {
    const Frame frame = Frame::around(point.normal);
    std::array<double, kRays> kernels{};
    for (unsigned i = 0; i < kRays; ++i) {
        SampleStream stream(key, i);
        const auto [u1, u2] = stream.next_two();
        const Vec3 local = sample_cosine_hemisphere(u1, u2).direction;
        const Vec3 direction = frame.to_world(local);
        const auto hit = caster.closest(point.position, direction);
        if (hit) kernels[i] = local.z * -dot(hit->normal, direction) / (hit->distance_m * hit->distance_m);
    }
    return kernels;
}

/// What the model says of a point.
struct PointModel {
    std::array<double, kRays> kernels_per_m2;
    double density_per_m2;
};

struct Choice {
    double k_per_m2 = 0;
    double variance_times_cost = std::numeric_limits<double>::infinity();
};

/// The best k for a given number of chains per ray.
Choice best_constant(const PointModel& point, double chains_per_ray, double rays_per_chain) {
    Choice best;
    const double node_factor = kPi * point.density_per_m2;
    for (int step = -2; step <= 8; ++step) {
        const double k = node_factor * std::ldexp(1.0, step);
        double fan_moment = 0, gathered = 0;
        for (const double g : point.kernels_per_m2) {
            const double w = k / (k + g);
            fan_moment += w * w * g / kRays;
            gathered += (1 - w) / kRays;
        }
        const double variance =
            kFanVariance * fan_moment / node_factor + chains_per_ray * kPathVariance * gathered;
        const double cost = rays_per_chain + (kRayCost + kPathCost * gathered) / chains_per_ray;
        if (variance * cost < best.variance_times_cost) best = {k, variance * cost};
    }
    return best;
}

/// Plans of the points of one packet.
std::vector<SplitPlan> best_plans(std::span<const PointModel> packet, double rays_per_chain) {
    std::vector<SplitPlan> best(packet.size());
    double least = std::numeric_limits<double>::infinity();
    for (std::uint64_t chains = 4; chains <= kMostChainsPerRay; chains *= 2) {
        std::vector<SplitPlan> plans;
        double total = 0;
        for (const PointModel& point : packet) {
            const Choice choice = best_constant(point, static_cast<double>(chains), rays_per_chain);
            plans.push_back({choice.k_per_m2, chains});
            total += choice.variance_times_cost;
        }
        if (total < least) {
            least = total;
            best = plans;
        }
    }
    return best;
}

}  // namespace

std::vector<SplitPlan> plan_splits(const RayCaster& caster, std::span<const PackedPoint> points,
                                   std::span<const ChainNode> pilot_nodes, std::uint64_t pilot_chains,
                                   double scene_area_m2, RandomKey key) {
    const double chains = static_cast<double>(pilot_chains);
    const double nodes_per_chain = (static_cast<double>(pilot_nodes.size()) + 1) / chains;
    const double mean_density = nodes_per_chain / scene_area_m2;
    const auto densities = node_densities_per_m2(caster, points, pilot_nodes, chains, mean_density);
    std::vector<SplitPlan> plans;
    plans.reserve(points.size());
    std::vector<PointModel> packet;
    for (std::size_t j = 0; j < points.size(); ++j) {
        packet.push_back({sampled_kernels(caster, points[j], key.derived(j)), densities[j]});
        if (packet.size() < kPacketWidth && j + 1 < points.size()) continue;
        // About half of the nodes face a point.
        for (const SplitPlan& plan : best_plans(packet, nodes_per_chain / 2)) plans.push_back(plan);
        packet.clear();
    }
    return plans;
}

}  // namespace stilb
