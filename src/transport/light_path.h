// The random walk of light particles: emission, then one surface after another [LocalEstimation 2].
#pragma once

#include <vector>

#include "transport/light_sampler.h"

namespace stilb::transport {

/// A surface point that a particle reaches, and the flux that it carries into it.
struct LightVertex {
    Vec3 position;
    Vec3 lifted;                         ///< off the surface, where rays start
    Vec3 normal;                         ///< on the side that the particle came from
    Vec3 shading_normal;                 ///< as rays::Hit has it
    Vec3 incoming;                       ///< unit, towards where the particle came from
    const Material* material = nullptr;  ///< owned by the scene
    /// W_n of theory (T.1), divided by the probability that the particle was not absorbed here: what a
    /// connection from this node multiplies with f_r.
    Rgb flux_lm;
    int reflections = 0;  ///< that the particle has met so far, this one included
    /// The particle left a point-like source and met a mirror or glass first (and did not go straight on
    /// through a pane): path tracing cannot make this light, at whatever node it comes along.
    bool only_by_light = false;
};

/// One chain. Absorption (Russian roulette with the surface's reflectance) comes before a node is recorded,
/// so that all nodes of all chains carry about the same flux: an equal share of the estimate for each ray of
/// the fan. Nodes on mirrors and glass are not recorded. Unbiased; at most `max_nodes` reflections.
void trace_light_path(const Scene& scene, const rays::RayCaster& caster, const LightSampler& lights,
                      int max_nodes, math::SampleStream stream, std::vector<LightVertex>& nodes);

/// The nodes of chains number `first` ... `end` - 1 of the streams of a key.
std::vector<LightVertex> trace_light_paths(const Scene& scene, const rays::RayCaster& caster,
                                           const LightSampler& lights, int max_nodes, math::RandomKey key,
                                           std::uint64_t first, std::uint64_t end);

}  // namespace stilb::transport
