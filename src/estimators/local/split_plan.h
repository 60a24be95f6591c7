// Planning of the constant k of bounded connections (weights.h), and of the number of gathering rays, for
// every receiver.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.h"
#include "transport/light_path.h"
#include "transport/path_tracer.h"
#include "transport/receiver.h"

namespace stilb::estimators {

struct SplitPlan {
    double k_per_m2 = 0;
    std::uint64_t paths_per_ray = 1;  ///< light paths for each gathering ray: a power of two
    /// The largest contribution of a gathering ray to the reading that the pilot has met [lx or cd/m2].
    double largest_of_rays = 0;
    double indirect = 0;  ///< light that is not direct, by the pilot [lx or cd/m2]
};

struct SplitPlans {
    std::vector<SplitPlan> of_receivers;
    /// The processor time of a light path, its connections and its share of the gathering rays. The unit is
    /// the time of a shadow ray.
    double cost_per_path = 1;
    /// The worth of processor time: the variance of a light path whose vertices are connected, divided by its
    /// cost. The variance is the sum over the readings of weight variance / value^2. In the best plan, other
    /// samples are worth their time as much.
    double variance_per_cost = 0;
    /// Selected light paths for each sample of direct light, by tile; empty where nothing plans them.
    std::vector<std::uint64_t> paths_per_direct{};
};

/// An estimate of the light before planning, and its sampling.
struct PilotLight {
    std::span<const transport::LightVertex> nodes;
    std::uint64_t light_paths = 1;   ///< that made the vertices
    std::span<const double> direct;  ///< of each reading: direct light [lx or cd/m2]
    double scene_area_m2 = 1;
    int max_reflections = 0;
    std::uint64_t paths_per_selected = 1;  ///< light paths for each whose vertices are connected
    /// The upper limit of SplitPlan::paths_per_ray: a power of two.
    std::uint64_t most_paths_per_ray = 64;
    double stands_for = 1;  ///< each receiver is one of so many
};

/// Plans, one for each receiver, that about minimise the sum over the readings of weight variance / value^2,
/// times the cost; the receivers of a packet send equally many rays. `weights`: of every reading. Variance
/// and cost come from a model: the surfaces seen from a receiver hold nu l [1/m2 per light path] vertices, l
/// being their luminance over its mean, which gives, E[] being the mean over rays in proportion to response x
/// cosine and in units of the indirect light squared,
///
///     variance of a light path's connections    E[l w^2 s G] / (pi nu)
///     variance of a gathering ray               c E[l^2 (1 - w) r]
///
/// with s of weights.h and r the ray's share of the density of all rays of its packet where it ends. The
/// pilot gives nu and the share of indirect light, a few paths from each receiver G, l and r. Any plan is
/// unbiased; a poor one only costs time. The plans depend on `key`, which must be independent of the keys
/// of their use.
SplitPlans plan_splits(const rays::RayCaster& caster, const transport::PathTracer& tracer,
                       std::span<const transport::Receiver> receivers, std::span<const double> weights,
                       const PilotLight& pilot, math::RandomKey key,
                       const Monitor& monitor = Monitor::none());
/// Its number of rays: of all receivers.
double planning_rays(std::size_t receivers);

/// One k for a packet of receivers (one at least, kPacketWidth at most), each of which gathers by one ray per
/// so many light paths whose vertices are all connected to it: by the same model.
double plan_constant(const rays::RayCaster& caster, const transport::PathTracer& tracer,
                     std::span<const transport::Receiver> receivers, const PilotLight& pilot,
                     std::uint64_t paths_per_ray, unsigned rays_per_receiver, math::RandomKey key);

}  // namespace stilb::estimators
