// Choosing the kernel split's constant, and how often to gather, for every receiver.
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
    std::uint64_t chains_per_ray = 1;  ///< light chains for each gathering ray: a power of two
};

/// chains_per_ray is at most this.
inline constexpr std::uint64_t kMostChainsPerRay = 64;

/// What is known of the light before planning, roughly, and how it was learnt.
struct PilotLight {
    std::span<const transport::LightVertex> nodes;
    std::uint64_t chains = 1;        ///< that made the nodes
    std::span<const double> direct;  ///< of each reading: light straight from sources [lx or cd/m2]
    double scene_area_m2 = 1;
    int max_reflections = 0;
    std::uint64_t chains_per_selected = 1;  ///< chains walked for each whose nodes go into the fan
};

/// Plans, one for each receiver, that make the sum over the readings of weight variance / value^2, times the
/// cost, about as small as can be; the rays of a packet's receivers are equally many. `weights`: of every
/// reading. Variance and cost come from a model: surfaces that a receiver sees hold nu l [1/m2 per chain]
/// nodes, l being their luminance over its mean, which gives, E[] being the mean over rays in proportion to
/// response x cosine and in units of the indirect light squared,
///
///     variance of a chain's fan    E[l w^2 s G] / (pi nu)      of a gathering ray    c E[l^2 (1 - w) r]
///
/// with s of kernel_split.h and r the ray's share of the density of all rays of its packet where it ends. The
/// pilot gives nu and the share of indirect light, a few paths from each receiver G, l and r. Any plan is
/// unbiased; a poor one costs time only. The plans depend on `key`, which must be independent of what they
/// are used for.
std::vector<SplitPlan> plan_splits(const rays::RayCaster& caster, const transport::PathTracer& tracer,
                                   std::span<const transport::Receiver> receivers,
                                   std::span<const double> weights, const PilotLight& pilot,
                                   math::RandomKey key, const Monitor& monitor = Monitor::none());

/// One k for a packet of receivers (one at least, kPacketWidth at most), each of which gathers by one ray for
/// so many chains of which all nodes are sent to it: by the same model.
double plan_constant(const rays::RayCaster& caster, const transport::PathTracer& tracer,
                     std::span<const transport::Receiver> receivers, const PilotLight& pilot,
                     std::uint64_t chains_per_ray, unsigned rays_per_receiver, math::RandomKey key);

}  // namespace stilb::estimators
