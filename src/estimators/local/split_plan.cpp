#include "estimators/local/split_plan.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/parallel.h"
#include "estimators/local/connection.h"
#include "materials/diffuse.h"
#include "math/sampling.h"
#include "transport/weights.h"

namespace stilb::estimators {
namespace {

// Costs in units of one shadow ray of a connection, and factors of the variance model; measured in the
// example office. From the end of a gathering ray two paths go on. The model has the cost and the variance of
// one path. A model of both paths was tried: plans became no better, and auto chose the guess of the light in
// a scene where it is slower (docs/lab-book.md).
constexpr double kRayCost = 12;        ///< a gathering ray to its hit
constexpr double kPathCost = 75;       ///< a path that goes on, shared by its packet
constexpr double kSegmentCost = 12;    ///< a light path's segment from one vertex to the next
constexpr double kPathVariance = 0.5;  ///< with Sobol' points, relative to independent paths
/// The remaining share of the variance after even selection, for a kernel that varies slowly, and the number
/// of vertices that lie evenly; a kernel that is peaked between two of these keeps its variance.
constexpr double kEvenVariance = 0.1;
constexpr double kEvenNodes = 512;

/// The hit of a ray from a receiver.
struct RaySample {
    double g_per_m2 = 0;      ///< infinite for a mirror, whose light is always gathered
    double luminance = 0;     ///< over the mean; both weighted by the response
    double own_share = 1;     ///< share of the density of its packet's rays at the same point
    double contribution = 0;  ///< to the reading [lx or cd/m2]
};

/// The model's prediction for a point and a k.
struct Outcome {
    double k_per_m2 = 0;
    double connection_variance = 0;  ///< of one light path, relative to the indirect light squared
    double gather_variance = 0;      ///< of one gathering ray, likewise
    double gather_cost = 0;          ///< of one gathering ray
    double largest_of_rays = 0;      ///< as SplitPlan
};
struct Prediction {
    double variance = 0, cost = 0;  ///< of a light path with its share of gathering
};
Prediction predict(const Outcome& outcome, std::uint64_t paths_per_ray) {
    const double light_paths = static_cast<double>(paths_per_ray);
    return {outcome.connection_variance + light_paths * outcome.gather_variance,
            outcome.gather_cost / light_paths};
}

/// One prediction for each tried k: powers of two times pi nu.
using PointModel = std::vector<Outcome>;
constexpr double kLeastFactor = 1.0 / 16;
/// The largest factor for each ray of the model. Close surfaces that cover little of the
/// hemisphere may be met by no ray; their vertices make the variance grow with k.
constexpr double kLargestFactorPerRay = 16;

/// `peak` is G times the area per evenly lying vertex.
double remaining_variance(double peak) { return (kEvenVariance + peak) / (1 + peak); }

PointModel model_of(std::span<const RaySample> rays, double density_per_m2) {
    PointModel model;
    const double largest = kLargestFactorPerRay * static_cast<double>(rays.size());
    for (double factor = kLeastFactor; factor <= largest; factor *= 2) {
        const double k = factor * kPi * density_per_m2;
        double connection_moment = 0, gathered = 0, gathered_moment = 0, largest_gathered = 0;
        for (const auto& [g, l, own_share, contribution] : rays) {
            const double rest = transport::GatheredShare{g / k}(1);
            const double w = 1 - rest;
            if (w > 0)
                connection_moment += l * w * w * g * remaining_variance(g / (kEvenNodes * density_per_m2));
            gathered += rest;
            gathered_moment += l * l * rest * own_share;
            largest_gathered = std::max(largest_gathered, contribution * rest * own_share);
        }
        const double per_ray = 1 / static_cast<double>(rays.size());
        model.push_back({k, per_ray * connection_moment / (kPi * density_per_m2),
                         per_ray * kPathVariance * gathered_moment, kRayCost + kPathCost * per_ray * gathered,
                         largest_gathered});
    }
    return model;
}

struct Choice {
    Prediction prediction;
    SplitPlan plan;
};
/// The best k for a given number of light paths per ray, when a unit of cost is worth `price` units of
/// variance.
Choice best_constant(const PointModel& point, std::uint64_t paths_per_ray, double price) {
    Choice best;
    double least = std::numeric_limits<double>::infinity();
    for (const Outcome& outcome : point) {
        const Prediction prediction = predict(outcome, paths_per_ray);
        const double loss = prediction.variance + price * prediction.cost;
        if (loss < least) {
            least = loss;
            best = {prediction, {outcome.k_per_m2, paths_per_ray, outcome.largest_of_rays, 0}};
        }
    }
    return best;
}

/// Plans for the points of a packet, which share the number of light paths per ray; returns their
/// sum.
Prediction plan_packet(std::span<const PointModel> packet, std::uint64_t most_paths_per_ray, double price,
                       std::span<SplitPlan> plans) {
    Prediction best;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint64_t light_paths = 1; light_paths <= most_paths_per_ray; light_paths *= 2) {
        std::array<SplitPlan, kPacketWidth> tried;
        Prediction sum;
        for (std::size_t j = 0; j < packet.size(); ++j) {
            const Choice choice = best_constant(packet[j], light_paths, price);
            tried[j] = choice.plan;
            sum.variance += choice.prediction.variance;
            sum.cost += choice.prediction.cost;
        }
        const double loss = sum.variance + price * sum.cost;
        if (loss < least) {
            least = loss;
            best = sum;
            std::copy_n(tried.begin(), packet.size(), plans.begin());
        }
    }
    return best;
}

/// The mean of w over rays.
double mean_connected_share(std::span<const RaySample> rays, double k_per_m2) {
    double sum = 0;
    for (const RaySample& ray : rays) sum += 1 - transport::GatheredShare{ray.g_per_m2 / k_per_m2}(1);
    return sum / static_cast<double>(rays.size());
}

/// G of a lane over the sum of all lanes': visibility is ignored.
double own_share(const rays::RayCaster& caster, const rays::Hit& hit, const PointTile& packet,
                 std::size_t lane) {
    RayPacket segments;
    LaneMask lanes;
    PointTile::Floats g_per_m2;
    connect(SegmentOrigin(hit, caster.center()), 1, packet, segments, lanes, g_per_m2);
    const double sum = std::accumulate(g_per_m2.begin(), g_per_m2.end(), 0.0);
    return sum > 0 ? double{g_per_m2[lane]} / sum : 1;
}

struct RaySamples {
    std::vector<RaySample> rays;
    double indirect = 0;  ///< of the receiver, from these rays alone [lx or cd/m2]
};

RaySamples sample_rays(const rays::RayCaster& caster, const transport::PathTracer& tracer,
                       const PointTile& packet, std::size_t lane, unsigned count, math::RandomKey key) {
    constexpr double floor = 0.2;  // of the mean: limits the influence of single bright paths
    const transport::Receiver& receiver = packet.receivers[lane];
    std::vector<RaySample> rays(count);
    double sum = 0;
    for (unsigned i = 0; i < count; ++i) {
        math::SampleStream stream(key, i);
        const auto [u1, u2] = stream.next_two();
        const auto sample = receiver.sample(u1, u2);
        if (!sample) continue;
        const Vec3& direction = sample->direction;
        const auto hit = caster.closest(receiver.lifted(), direction);
        if (!hit) continue;
        // A number is looked at only: path tracing chooses the same.
        math::SampleStream next = stream;
        rays::Hit from = *hit;
        Vec3 back = -direction;
        const auto scattering =
            transport::choose_lobe(tracer.material(*hit), from, back, transport::Carried::luminance, next);
        if (!scattering) continue;
        if (is_specular(*scattering->material)) {
            rays[i].g_per_m2 = std::numeric_limits<double>::infinity();
        } else {
            const double cosines = receiver.sensitivity(direction) * -dot(hit->normal, direction);
            rays[i].g_per_m2 = cosines / (hit->distance_m * hit->distance_m) *
                               mean_concentration(*scattering->material) *
                               receiver.response(direction).relative;
            rays[i].own_share = own_share(caster, *hit, packet, lane);
        }
        const Rgb luminance =
            tracer.luminance_without_direct(*hit, direction, packet.reflections_left[lane], stream);
        rays[i].contribution = (sample->weight * luminance).luminance();
        sum += rays[i].contribution;
    }
    const double mean = sum / count;
    for (RaySample& ray : rays) {
        if (ray.g_per_m2 == 0) continue;
        ray.luminance = mean > 0 ? (ray.contribution / mean + floor) / (1 + floor) : 1;
    }
    return {std::move(rays), mean};
}

/// Vertices of unit flux on white surfaces: their sum at a point is nu.
std::vector<transport::LightVertex> unit_nodes(std::span<const transport::LightVertex> nodes) {
    static const Material white = Diffuse{Rgb::grey(1)};
    std::vector<transport::LightVertex> result(nodes.begin(), nodes.end());
    for (transport::LightVertex& node : result) {
        node.material = &white;
        node.shading_normal = node.normal;
        node.flux_lm = Rgb::grey(1);
        node.only_by_light = false;
    }
    return result;
}

/// The data of a receiver before planning.
struct Survey {
    std::vector<RaySample> rays;
    double density_per_m2 = 0;  ///< of vertices, per light path, on the surfaces that it sees
    double indirect = 0;        ///< [lx or cd/m2]
};

/// The light from the pilot's vertices at the receivers of a packet, and the density of vertices there
/// [1/m2]: sums over its light paths, weighted by w of the bounded connection.
struct PilotSums {
    std::vector<double> indirect, density_per_m2;
};

PilotSums collect_pilot(const rays::RayCaster& caster, std::span<const transport::Receiver> receivers,
                        double k_per_m2, const PilotLight& pilot,
                        std::span<const transport::LightVertex> units) {
    const std::vector<double> k(receivers.size(), k_per_m2);
    const auto collect = [&](std::vector<transport::Receiver> packet,
                             std::span<const transport::LightVertex> nodes) {
        for (std::size_t i = 0; i < packet.size(); ++i) packet[i].set_reading(static_cast<std::uint32_t>(i));
        const std::vector<PointTile> tile = tiles_of(packet, k, caster, pilot.max_reflections);
        Tally sums(packet.size());
        Connections(caster, tile).collect(nodes, sums);
        std::vector<double> luminous;
        for (const Rgb& sum : sums.sum) luminous.push_back(sum.luminance());
        return luminous;
    };
    std::vector<transport::Receiver> of_illuminance;
    for (const transport::Receiver& receiver : receivers)
        of_illuminance.push_back(receiver.without_response());
    return {collect({receivers.begin(), receivers.end()}, pilot.nodes), collect(of_illuminance, units)};
}

std::vector<Survey> survey_packet(const rays::RayCaster& caster, const transport::PathTracer& tracer,
                                  std::span<const transport::Receiver> receivers, const PilotLight& pilot,
                                  std::span<const transport::LightVertex> units, unsigned rays_per_receiver,
                                  math::RandomKey key) {
    const double light_paths = static_cast<double>(pilot.light_paths);
    const double area_m2 = std::max(pilot.scene_area_m2, std::numeric_limits<double>::min());
    const double mean_density = (static_cast<double>(pilot.nodes.size()) + 1) / (light_paths * area_m2);
    // There are few vertices, and in a corner one may be very near by chance. Bounding kernels to a width
    // above the distance between vertices limits the influence of such a vertex.
    constexpr double nodes_within = 16;
    const double k_per_m2 = kPi * light_paths * mean_density / nodes_within;
    const PilotSums sums = collect_pilot(caster, receivers, k_per_m2, pilot, units);
    const std::vector<PointTile> tile =
        tiles_of(receivers, std::vector<double>(receivers.size(), k_per_m2), caster, pilot.max_reflections);
    std::vector<Survey> surveys;
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        RaySamples samples = sample_rays(caster, tracer, tile.front(), i, rays_per_receiver, key.derived(i));
        const double seen = light_paths * std::max(mean_connected_share(samples.rays, k_per_m2), 0.01);
        // A glossy sub-point reflects few or no vertices, and any point may see none: then the rays tell.
        const double of_vertices = receivers[i].constant_response() ? sums.indirect[i] / seen : 0;
        const double indirect = std::max(of_vertices, samples.indirect);
        // Without any light seen, planning cannot gain anything.
        const double density_per_m2 =
            indirect > 0 ? std::max(sums.density_per_m2[i] / seen, 1e-3 * mean_density) : mean_density;
        surveys.push_back({std::move(samples.rays), density_per_m2, indirect});
    }
    return surveys;
}

/// A model in units of the indirect light, and that light.
struct ReceiverModel {
    PointModel model;
    double indirect = 0;  ///< [lx or cd/m2]
};

/// A constant number for all points together, except for very few or very many points.
unsigned planning_rays_per_point(double points) {
    constexpr double rays = 1u << 13;
    return static_cast<unsigned>(std::clamp(rays / points, 16., 1024.));
}

std::vector<ReceiverModel> model_receivers(const rays::RayCaster& caster, const transport::PathTracer& tracer,
                                           std::span<const transport::Receiver> receivers,
                                           const PilotLight& pilot, math::RandomKey key,
                                           const Monitor& monitor) {
    const unsigned rays_per_point =
        planning_rays_per_point(pilot.stands_for * static_cast<double>(receivers.size()));
    const std::vector<transport::LightVertex> units = unit_nodes(pilot.nodes);
    std::vector<ReceiverModel> models(receivers.size());
    const std::size_t packets = (receivers.size() + kPacketWidth - 1) / kPacketWidth;
    std::atomic<std::size_t> done = 0;
    parallel_for(packets, [&](std::size_t p) {
        const double share = static_cast<double>(done++) / static_cast<double>(packets);
        monitor.report("planning", share);
        monitor.require_time("planning", share);
        const std::size_t first = p * kPacketWidth;
        const std::size_t count = std::min<std::size_t>(kPacketWidth, receivers.size() - first);
        const std::vector<Survey> surveys = survey_packet(caster, tracer, receivers.subspan(first, count),
                                                          pilot, units, rays_per_point, key.derived(p));
        for (std::size_t i = 0; i < count; ++i) {
            models[first + i] = {model_of(surveys[i].rays, surveys[i].density_per_m2), surveys[i].indirect};
        }
    });
    return models;
}

/// The models with variances relative to the readings of the receivers, times their weights.
std::vector<PointModel> weighted_models(std::vector<ReceiverModel> models,
                                        std::span<const transport::Receiver> receivers,
                                        std::span<const double> weights, std::span<const double> direct) {
    std::vector<double> values(direct.begin(), direct.end());
    for (std::size_t j = 0; j < receivers.size(); ++j) values[receivers[j].reading()] += models[j].indirect;
    std::vector<PointModel> weighted;
    for (std::size_t j = 0; j < receivers.size(); ++j) {
        const std::uint32_t reading = receivers[j].reading();
        const double share = values[reading] > 0 ? models[j].indirect / values[reading] : 0;
        weighted.push_back(std::move(models[j].model));
        for (Outcome& outcome : weighted.back()) {
            outcome.connection_variance *= weights[reading] * share * share;
            outcome.gather_variance *= weights[reading] * share * share;
        }
    }
    return weighted;
}

/// The largest number of packets that are surveyed. Others take the plan of the one before them, which lies
/// near them: receivers are in the order of a space-filling curve.
constexpr std::size_t kMostSurveyed = 1024;

/// plan_splits() for all receivers.
SplitPlans plan_surveyed(const rays::RayCaster& caster, const transport::PathTracer& tracer,
                         std::span<const transport::Receiver> receivers, std::span<const double> weights,
                         const PilotLight& pilot, math::RandomKey key, const Monitor& monitor) {
    std::vector<ReceiverModel> unweighted = model_receivers(caster, tracer, receivers, pilot, key, monitor);
    std::vector<double> indirect;
    for (const ReceiverModel& model : unweighted) indirect.push_back(model.indirect);
    const std::vector<PointModel> models =
        weighted_models(std::move(unweighted), receivers, weights, pilot.direct);
    // About half of the vertices face a point; all points share the cost of tracing.
    const double vertices_per_path =
        (static_cast<double>(pilot.nodes.size()) + 1) / static_cast<double>(pilot.light_paths);
    const std::size_t lanes = (receivers.size() + kPacketWidth - 1) / kPacketWidth * kPacketWidth;
    const double connection_cost = 0.5 * vertices_per_path * static_cast<double>(lanes) +
                                   kSegmentCost * (vertices_per_path + 1) *
                                       static_cast<double>(pilot.paths_per_selected) / pilot.stands_for;
    // The worth of a unit of cost: at the best plan, the quotient of variance and cost. Both depend on the
    // plan; after some rounds they change little.
    double price = 0, cost = 0;
    for (const PointModel& model : models)
        price += predict(model[model.size() / 2], 16).variance / connection_cost;
    std::vector<SplitPlan> plans(receivers.size());
    constexpr int rounds = 4;
    for (int round = 0; round < rounds; ++round) {
        price = std::max(price, std::numeric_limits<double>::min());  // cost decides where nothing varies
        Prediction sum{0, connection_cost};
        for (std::size_t first = 0; first < models.size(); first += kPacketWidth) {
            const std::size_t count = std::min<std::size_t>(kPacketWidth, models.size() - first);
            const Prediction packet = plan_packet({models.data() + first, count}, pilot.most_paths_per_ray,
                                                  price, {plans.data() + first, count});
            sum.variance += packet.variance;
            sum.cost += packet.cost;
        }
        price = sum.variance / sum.cost;
        cost = sum.cost;
    }
    for (std::size_t j = 0; j < plans.size(); ++j) plans[j].indirect = indirect[j];
    return {std::move(plans), cost * pilot.stands_for / static_cast<double>(pilot.paths_per_selected), price};
}

}  // namespace

double planning_rays(std::size_t receivers) {
    const auto points = static_cast<double>(receivers);
    constexpr double most_points = kMostSurveyed * kPacketWidth;
    return std::min(points, most_points) * planning_rays_per_point(points);
}

SplitPlans plan_splits(const rays::RayCaster& caster, const transport::PathTracer& tracer,
                       std::span<const transport::Receiver> receivers, std::span<const double> weights,
                       const PilotLight& pilot, math::RandomKey key, const Monitor& monitor) {
    if (receivers.empty()) return {};
    const std::size_t packets = (receivers.size() + kPacketWidth - 1) / kPacketWidth;
    const std::size_t stride = (packets + kMostSurveyed - 1) / kMostSurveyed;
    std::vector<transport::Receiver> surveyed;
    for (std::size_t first = 0; first < receivers.size(); first += stride * kPacketWidth) {
        const auto packet =
            receivers.subspan(first, std::min<std::size_t>(kPacketWidth, receivers.size() - first));
        surveyed.insert(surveyed.end(), packet.begin(), packet.end());
    }
    PilotLight of_surveyed = pilot;
    of_surveyed.stands_for *= static_cast<double>(stride);
    SplitPlans of_some = plan_surveyed(caster, tracer, surveyed, weights, of_surveyed, key, monitor);
    std::vector<SplitPlan> plans(receivers.size());
    for (std::size_t i = 0; i < plans.size(); ++i) {
        const std::size_t packet = i / kPacketWidth / stride;
        plans[i] = of_some.of_receivers[packet * kPacketWidth + i % kPacketWidth];
    }
    of_some.of_receivers = std::move(plans);
    return of_some;
}

double plan_constant(const rays::RayCaster& caster, const transport::PathTracer& tracer,
                     std::span<const transport::Receiver> receivers, const PilotLight& pilot,
                     std::uint64_t paths_per_ray, unsigned rays_per_receiver, math::RandomKey key) {
    const std::vector<Survey> surveys =
        survey_packet(caster, tracer, receivers, pilot, unit_nodes(pilot.nodes), rays_per_receiver, key);
    double density_per_m2 = 0;
    for (const Survey& survey : surveys) {
        density_per_m2 += survey.density_per_m2 / static_cast<double>(surveys.size());
    }
    std::vector<Outcome> sums;
    for (const Survey& survey : surveys) {
        const PointModel model = model_of(survey.rays, density_per_m2);
        sums.resize(model.size());
        for (std::size_t i = 0; i < model.size(); ++i) {
            sums[i].k_per_m2 = model[i].k_per_m2;
            sums[i].connection_variance += model[i].connection_variance;
            sums[i].gather_variance += model[i].gather_variance;
            sums[i].gather_cost += model[i].gather_cost;
        }
    }
    const double light_paths = static_cast<double>(paths_per_ray);
    const double vertices_per_path =
        (static_cast<double>(pilot.nodes.size()) + 1) / static_cast<double>(pilot.light_paths);
    const double connection_cost = light_paths * vertices_per_path * static_cast<double>(surveys.size());
    Outcome best;
    double least = std::numeric_limits<double>::infinity();
    for (const Outcome& outcome : sums) {
        const double loss = (outcome.connection_variance / light_paths + outcome.gather_variance) *
                            (connection_cost + outcome.gather_cost);
        if (loss < least) {
            least = loss;
            best = outcome;
        }
    }
    return best.k_per_m2;
}

}  // namespace stilb::estimators
