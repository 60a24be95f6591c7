// The scene, its lights and the path tracer, as readings and pictures by local estimation use them.
#pragma once

#include "estimators/estimator.h"
#include "estimators/limits.h"
#include "transport/direct/direct_light.h"
#include "transport/light_path.h"
#include "transport/path_tracer.h"

namespace stilb::estimators {

/// Light paths for planning; few suffice, because any plan is unbiased.
inline constexpr std::uint64_t kPilotPaths = 256;

/// Whether rays gather light, too.
enum class Split { none, balanced };

/// The common part of readings and pictures. Not movable, because its members refer to each other.
struct LocalTransport {
    LocalTransport(const Problem& problem, Split asked)
        : scene(problem.scene),
          caster(problem.caster),
          max_reflections(problem.max_reflections),
          split(asked),
          gathers(split == Split::balanced || has_specular_surfaces(scene) || caster.has_panes()),
          lights(scene, caster),
          tracer(scene, caster, lights),
          direct(scene, caster, lights),
          monitor(problem.monitor) {}
    LocalTransport(const LocalTransport&) = delete;
    LocalTransport& operator=(const LocalTransport&) = delete;

    std::vector<transport::LightVertex> trace_light_paths(math::RandomKey key, std::uint64_t first,
                                                          std::uint64_t end) const {
        return transport::trace_light_paths(scene, caster, lights, max_reflections, key, first, end);
    }

    const Scene& scene;
    const rays::RayCaster& caster;
    int max_reflections;
    Split split;
    bool gathers;
    transport::LightSampler lights;
    transport::PathTracer tracer;
    transport::DirectLight direct;
    const Monitor& monitor;
};

}  // namespace stilb::estimators
