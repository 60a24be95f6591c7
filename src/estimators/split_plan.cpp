#include "estimators/split_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "base/sampling.h"
#include "estimators/fan.h"
#include "estimators/kernel_split.h"

namespace stilb {
namespace {

constexpr double kPi = std::numbers::pi;

// Costs in units of one ray of a fan, and factors of the variance model; measured in the example office.
constexpr double kRayCost = 17;         ///< a gathering ray to its hit
constexpr double kPathCost = 80;        ///< the path that goes on from there
constexpr double kConnectionCost = 20;  ///< sharing it out among the packet's points
constexpr double kChainCost = 35;       ///< walking one chain
constexpr double kPathVariance = 0.5;
/// What even selection leaves of the variance of a kernel that varies slowly, and how many nodes lie evenly;
/// a kernel that is peaked between two of these keeps its variance.
constexpr double kEvenVariance = 0.1;
constexpr double kEvenNodes = 512;

/// What a ray from a point meets.
struct RaySample {
    double g_per_m2 = 0;   ///< infinite where it is a mirror: what that shows is gathered always
    double luminance = 0;  ///< over the mean
    double own_share = 1;  ///< of the rays of its packet that could have met the same place
};

/// What the model says of a point.
struct PointModel {
    std::vector<RaySample> rays;
    double density_per_m2 = 0;  ///< nu
    double indirect_share = 0;  ///< of the illuminance
};

struct Prediction {
    double variance = 0;  ///< of a chain with its share of gathering, relative to the whole illuminance
    double cost = 0;      ///< of the gathering for a chain
};

/// `peak` is G times the area that one of the evenly lying nodes stands for.
double remaining_variance(double peak) { return (kEvenVariance + peak) / (1 + peak); }

Prediction predict(const PointModel& point, const SplitPlan& plan) {
    double fan_moment = 0, gathered = 0, gathered_moment = 0;
    for (const auto& [g, l, own] : point.rays) {
        const double rest = GatheredShare{g / plan.k_per_m2}(1);
        const double w = 1 - rest;
        if (w > 0) fan_moment += l * w * w * g * remaining_variance(g / (kEvenNodes * point.density_per_m2));
        gathered += rest;
        gathered_moment += l * l * rest * own;
    }
    const double rays = static_cast<double>(point.rays.size());
    const double chains = static_cast<double>(plan.chains_per_ray);
    const double variance =
        (fan_moment / (kPi * point.density_per_m2) + chains * kPathVariance * gathered_moment) / rays;
    return {point.indirect_share * point.indirect_share * variance,
            (kRayCost + (kPathCost + kConnectionCost) * gathered / rays) / chains};
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

/// A bound for G that leaves out what is unusually near, so that single near nodes do not decide: a few times
/// the upper quartile of what the rays meet.
double usual_kernel_per_m2(std::span<const RaySample> rays, double fallback_per_m2) {
    std::vector<double> kernels;
    for (const RaySample& ray : rays) {
        if (ray.g_per_m2 > 0 && std::isfinite(ray.g_per_m2)) kernels.push_back(ray.g_per_m2);
    }
    if (kernels.empty()) return fallback_per_m2;
    const auto quartile = kernels.begin() + static_cast<std::ptrdiff_t>(3 * kernels.size() / 4);
    std::nth_element(kernels.begin(), quartile, kernels.end());
    return 4 * *quartile;
}

/// G of a lane over the sum of all lanes': visibility left out.
double own_share(const RayCaster& caster, const Hit& hit, const PointTile& packet, std::size_t lane) {
    RayPacket segments;
    LaneMask lanes;
    PointTile::Floats g_per_m2;
    connect(SegmentOrigin(hit.position, hit.lifted, hit.normal, caster.center()), packet, segments, lanes,
            g_per_m2);
    const double sum = std::accumulate(g_per_m2.begin(), g_per_m2.end(), 0.0);
    return sum > 0 ? double{g_per_m2[lane]} / sum : 1;
}

std::vector<RaySample> sample_rays(const RayCaster& caster, const PathTracer& tracer,
                                   const PackedPoint& point, const PointTile& packet, std::size_t lane,
                                   unsigned count, RandomKey key) {
    constexpr double floor = 0.2;  // light that comes by more than one reflection, as a share of the mean
    constexpr int only_direct_light = 1;
    const Frame frame = Frame::around(point.normal);
    std::vector<RaySample> rays(count);
    double sum = 0;
    for (unsigned i = 0; i < count; ++i) {
        SampleStream stream(key, i);
        const std::array<double, 2> u = stream.next_two();
        const Vec3 local = sample_cosine_hemisphere(u[0], u[1]).direction;
        const Vec3 direction = frame.to_world(local);
        const auto hit = caster.closest(point.lifted, direction);
        if (!hit) continue;
        const PathTracer::View view = tracer.look_through_mirrors(*hit, direction, only_direct_light, stream);
        const double g = local.z * -dot(hit->normal, direction) / (hit->distance_m * hit->distance_m);
        rays[i].g_per_m2 = view.reflections > 0 ? std::numeric_limits<double>::infinity()
                                                : g * mean_concentration(tracer.material(*hit));
        rays[i].own_share = view.reflections > 0 ? 1 : own_share(caster, *hit, packet, lane);
        Spectrum luminance = view.emission_cd_m2;
        if (view.surface) {
            luminance += view.transmission *
                         tracer.reflected_luminance(*view.surface, view.outgoing, only_direct_light, stream);
        }
        rays[i].luminance = luminance.luminance();
        sum += rays[i].luminance;
    }
    const double mean = sum / count;
    for (RaySample& ray : rays) {
        if (ray.g_per_m2 == 0) continue;
        ray.luminance = mean > 0 ? (ray.luminance / mean + floor) / (1 + floor) : 1;
    }
    return rays;
}

std::vector<PointModel> model_points(const RayCaster& caster, const PathTracer& tracer,
                                     std::span<const PackedPoint> points, const PilotLight& pilot,
                                     RandomKey key) {
    const double chains = static_cast<double>(pilot.chains);
    const double mean_density =
        (static_cast<double>(pilot.nodes.size()) + 1) / (chains * pilot.scene_area_m2);
    // Few rays for each of many points: those of a packet share a plan.
    const unsigned rays = points.size() > 1000 ? 16 : 64;
    std::vector<PointModel> models(points.size());
    std::vector<double> bounds_per_m2;
    const std::vector<PointTile> packets = tiles_of(points, std::vector<double>(points.size(), 1.0), caster);
    for (std::size_t j = 0; j < points.size(); ++j) {
        models[j].rays = sample_rays(caster, tracer, points[j], packets[j / kPacketWidth], j % kPacketWidth,
                                     rays, key.derived(j));
        bounds_per_m2.push_back(usual_kernel_per_m2(models[j].rays, mean_density));
    }
    const std::vector<PointTile> tiles = tiles_of(points, bounds_per_m2, caster);
    const Fan fan(caster, tiles);
    ReadingSums indirect(points.size()), density(points.size());
    fan.collect(pilot.nodes, indirect);
    // Unit fluxes on white surfaces add up to nu.
    const Material white = Diffuse{Spectrum::grey(1)};
    std::vector<ChainNode> unit_nodes(pilot.nodes.begin(), pilot.nodes.end());
    for (ChainNode& node : unit_nodes) {
        node.material = &white;
        node.flux_lm = Spectrum::grey(1);
        node.only_by_light = false;
    }
    fan.collect(unit_nodes, density);
    for (std::size_t j = 0; j < points.size(); ++j) {
        const std::uint32_t reading = points[j].reading;
        const double indirect_lx = indirect.sum[reading].luminance() / chains;
        const double total_lx = indirect_lx + pilot.direct_lx[reading];
        // Nothing seen: a dark place, where nothing is to be gained.
        models[j].density_per_m2 =
            total_lx > 0 ? std::max(density.sum[reading][0] / chains, 1e-3 * mean_density) : mean_density;
        models[j].indirect_share = total_lx > 0 ? indirect_lx / total_lx : 0;
    }
    return models;
}

}  // namespace

std::vector<SplitPlan> plan_splits(const RayCaster& caster, const PathTracer& tracer,
                                   std::span<const PackedPoint> points, const PilotLight& pilot,
                                   RandomKey key) {
    const std::vector<PointModel> models = model_points(caster, tracer, points, pilot, key);
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
