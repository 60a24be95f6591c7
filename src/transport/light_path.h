// Light paths: emission, then one surface after another [LocalEstimation 2]. The papers call a light path a
// chain, and its vertices nodes.
#pragma once

#include <memory>
#include <vector>

#include "transport/light_sampler.h"

namespace stilb::transport {

/// A vertex of a light path: a surface point that a particle reaches, on the side that it came from, with the
/// flux that it carries.
struct LightVertex : SurfacePoint {
    Vec3 shading_normal;                 ///< as in rays::Hit
    Vec3 incoming;                       ///< unit, towards the previous vertex
    const Material* material = nullptr;  ///< owned by the scene
    /// W_n of theory (T.1), divided by the probability that the particle was not absorbed here: the factor of
    /// f_r in a connection from this vertex.
    Rgb flux_lm;
    int reflections = 0;  ///< of the particle so far, this one included
    /// The particle left a point-like source and met a mirror or glass first (and did not pass straight
    /// through a pane): path tracing cannot find this light, at any vertex.
    bool only_by_light = false;
    double favour = 1;  ///< as EmittedParticle's: the vertex counts so much more where some are selected
    double split = 1;   ///< the k of other connections over that of its own (weights.h)
    std::uint32_t light = 0;  ///< that the particle left, of Scene::lights
    /// The shares of the channels in the flux, band by band, as they are after one reflection. Null: all of
    /// it is of `light`.
    std::shared_ptr<const std::vector<Rgb>> shares = nullptr;
};

/// Traces one light path. Absorption (Russian roulette with the surface's reflectance) comes before a vertex
/// is recorded, so that all vertices of all light paths carry about the same flux: an equal share of the
/// estimate for each shadow ray of a connection. Vertices on mirrors and glass are not recorded. Unbiased; at
/// most `max_nodes` reflections.
void trace_light_path(const Scene& scene, const rays::RayCaster& caster, const LightSampler& lights,
                      int max_nodes, math::SampleStream stream, std::vector<LightVertex>& nodes);

/// The vertices of light paths number `first` ... `end` - 1 of the streams of a key.
std::vector<LightVertex> trace_light_paths(const Scene& scene, const rays::RayCaster& caster,
                                           const LightSampler& lights, int max_nodes, math::RandomKey key,
                                           std::uint64_t first, std::uint64_t end);

}  // namespace stilb::transport
