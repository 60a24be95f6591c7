// Choosing the kernel split's constant, and how often to gather, for every measuring point.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "estimators/light_chain.h"
#include "estimators/packed_points.h"

namespace stilb {

struct SplitPlan {
    double k_per_m2 = 0;
    std::uint64_t chains_per_ray = 1;  ///< light chains for each gathering ray: a power of two
};

/// chains_per_ray is at most this.
inline constexpr std::uint64_t kMostChainsPerRay = 64;

/// For each point the plan with the least product of variance and cost, the rays of a packet's points being
/// as many for all, by a model of both: nodes lie with density nu [1/m2 per chain] on what the point sees,
/// which gives, with the mean E[] over cosine-distributed rays,
///
///     variance / value^2 of a chain's fan       E[w^2 G] / (pi nu)
///     the same of a gathering ray               c E[1 - w]
///
/// `pilot_nodes` of `pilot_chains` chains give nu, a few rays from each point the distribution of G. Any plan
/// is unbiased; a poor one costs time only. The plans depend on `key`, which must be independent of what they
/// are used for.
std::vector<SplitPlan> plan_splits(const RayCaster& caster, std::span<const PackedPoint> points,
                                   std::span<const ChainNode> pilot_nodes, std::uint64_t pilot_chains,
                                   double scene_area_m2, RandomKey key);

}  // namespace stilb
