#include "estimators/split_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/sampling.h"
#include "estimators/fan.h"

namespace stilb {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr unsigned kRays = 32;

// Costs in units of one ray of a fan, and factors of the variance model; measured in the example office.
constexpr double kRayCost = 4;     ///< a gathering ray to its hit
constexpr double kPathCost = 100;  ///< the path that goes on from there
constexpr double kChainCost = 35;  ///< walking one chain
constexpr double kPathVariance = 3;
constexpr double kFanVariance = 0.2;  ///< below 1 thanks to the even selection of nodes

/// What the model says of a point.
struct PointModel {
    std::array<double, kRays> kernels_per_m2{};  ///< G of what a few rays meet; 0 where they meet nothing
    double density_per_m2 = 0;                   ///< nu
    double indirect_share = 0;                   ///< of the illuminance
};

struct Prediction {
    double variance = 0;  ///< of a chain with its share of gathering, relative to the whole illuminance
    double cost = 0;      ///< of the gathering for a chain
};

Prediction predict(const PointModel& point, const SplitPlan& plan) {
    double fan_moment = 0, gathered = 0;
    for (const double g : point.kernels_per_m2) {
        const double w = plan.k_per_m2 / (plan.k_per_m2 + g);
        fan_moment += w * w * g / kRays;
        gathered += (1 - w) / kRays;
    }
    const double chains = static_cast<double>(plan.chains_per_ray);
    const double variance =
        kFanVariance * fan_moment / (kPi * point.density_per_m2) + chains * kPathVariance * gathered;
    return {point.indirect_share * point.indirect_share * variance,
            (kRayCost + kPathCost * gathered) / chains};
}

/// The k that is best for a given number of chains per ray, when a unit of cost is worth `price` units of
/// variance.
SplitPlan best_constant(const PointModel& point, std::uint64_t chains_per_ray, double price) {
    SplitPlan best;
    double least = std::numeric_limits<double>::infinity();
    for (int step = -4; step <= 8; ++step) {
        const SplitPlan plan{kPi * point.density_per_m2 * std::ldexp(1.0, step), chains_per_ray};
        const Prediction prediction = predict(point, plan);
        const double loss = prediction.variance + price * prediction.cost;
        if (loss < least) {
            least = loss;
            best = plan;
        }
    }
    return best;
}

void plan_packet(std::span<const PointModel> packet, double price, std::span<SplitPlan> plans) {
    double least = std::numeric_limits<double>::infinity();
    for (std::uint64_t chains = 1; chains <= kMostChainsPerRay; chains *= 2) {
        std::array<SplitPlan, kPacketWidth> tried;
        double loss = 0;
        for (std::size_t j = 0; j < packet.size(); ++j) {
            tried[j] = best_constant(packet[j], chains, price);
            const Prediction prediction = predict(packet[j], tried[j]);
            loss += prediction.variance + price * prediction.cost;
        }
        if (loss < least) {
            least = loss;
            std::copy_n(tried.begin(), packet.size(), plans.begin());
        }
    }
}

/// The price at which variance times cost is least for the given plans: the quotient of both.
double price_of(std::span<const PointModel> points, std::span<const SplitPlan> plans, double fan_cost) {
    double variance = 0, cost = 0;
    for (std::size_t j = 0; j < points.size(); ++j) {
        const Prediction prediction = predict(points[j], plans[j]);
        variance += prediction.variance;
        cost += prediction.cost + fan_cost;
    }
    return variance / cost;
}

/// What a fan of the nodes, with G bounded, brings to each reading.
ReadingSums pilot_fan(const RayCaster& caster, std::span<const PackedPoint> points,
                      std::span<const ChainNode> nodes, double bound_per_m2) {
    ReadingSums sums(points.size());
    const std::vector<double> bounds(points.size(), bound_per_m2);
    Fan(caster, points, bounds).collect(nodes, sums);
    return sums;
}

/// G of the surfaces that a few cosine-distributed rays meet.
std::array<double, kRays> sampled_kernels(const RayCaster& caster, const PackedPoint& point, RandomKey key) {
    const Frame frame = Frame::around(point.normal);
    std::array<double, kRays> kernels{};
    for (unsigned i = 0; i < kRays; ++i) {
        SampleStream stream(key, i);
        const auto [u1, u2] = stream.next_two();
        const Vec3 local = sample_cosine_hemisphere(u1, u2).direction;
        const Vec3 direction = frame.to_world(local);
        const auto hit = caster.closest(point.lifted, direction);
        if (hit) kernels[i] = local.z * -dot(hit->normal, direction) / (hit->distance_m * hit->distance_m);
    }
    return kernels;
}

std::vector<PointModel> model_points(const RayCaster& caster, std::span<const PackedPoint> points,
                                     const PilotLight& pilot, RandomKey key) {
    const double chains = static_cast<double>(pilot.chains);
    const double mean_density =
        (static_cast<double>(pilot.nodes.size()) + 1) / (chains * pilot.scene_area_m2);
    // Bounded, so that single near nodes do not count.
    const double bound = 16 * kPi * mean_density;
    const ReadingSums indirect = pilot_fan(caster, points, pilot.nodes, bound);
    // Unit fluxes on white surfaces add up to nu.
    const Material white = Diffuse{Spectrum::grey(1)};
    std::vector<ChainNode> unit_nodes(pilot.nodes.begin(), pilot.nodes.end());
    for (ChainNode& node : unit_nodes) {
        node.material = &white;
        node.flux_lm = Spectrum::grey(1);
        node.only_by_light = false;
    }
    const ReadingSums density = pilot_fan(caster, points, unit_nodes, bound);
    std::vector<PointModel> models;
    models.reserve(points.size());
    for (std::size_t j = 0; j < points.size(); ++j) {
        const std::uint32_t reading = points[j].reading;
        const double indirect_lx = indirect.sum[reading].luminance() / chains;
        const double total_lx = indirect_lx + pilot.direct_lx[reading];
        models.push_back({sampled_kernels(caster, points[j], key.derived(j)),
                          std::max(density.sum[reading][0] / chains, 1e-3 * mean_density),
                          total_lx > 0 ? indirect_lx / total_lx : 1});
    }
    return models;
}

}  // namespace

std::vector<SplitPlan> plan_splits(const RayCaster& caster, std::span<const PackedPoint> points,
                                   const PilotLight& pilot, RandomKey key) {
    const std::vector<PointModel> models = model_points(caster, points, pilot, key);
    // About half of the nodes face a point; the walk is shared by all points.
    const double nodes_per_chain =
        (static_cast<double>(pilot.nodes.size()) + 1) / static_cast<double>(pilot.chains);
    const double fan_cost = 0.5 * nodes_per_chain + kChainCost *
                                                        static_cast<double>(pilot.chains_per_selected) /
                                                        static_cast<double>(points.size());
    std::vector<SplitPlan> plans;
    for (const PointModel& model : models) plans.push_back({kPi * model.density_per_m2, 16});
    constexpr int rounds = 3;  // the price depends on the plans that it leads to; more rounds change little
    for (int round = 0; round < rounds; ++round) {
        const double price = price_of(models, plans, fan_cost);
        for (std::size_t first = 0; first < models.size(); first += kPacketWidth) {
            const std::size_t count = std::min<std::size_t>(kPacketWidth, models.size() - first);
            plan_packet({models.data() + first, count}, price, {plans.data() + first, count});
        }
    }
    return plans;
}

}  // namespace stilb
