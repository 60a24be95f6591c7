// A picture of a camera, pass by pass, with standard errors.
#pragma once

#include <atomic>

#include "run/options.h"
#include "run/progress.h"
#include "run/result.h"
#include "scene/scene.h"

namespace stilb::estimators {
struct PatchSolution;
}

namespace stilb::run {

/// Renders one camera. Without any target, for a minute. The result depends on scene, camera, method, bounces
/// and seed, and on the passes done: not on threads. `interrupt` ends the run early, in good order. Throws as
/// measure() does.
RenderResult render(const Scene& scene, const Sensor& camera, const RunOptions& options,
                    PictureSink* sink = nullptr, const std::atomic<bool>* interrupt = nullptr);

/// The same of light that is known: a few passes for smooth edges. Errors come from the solution's
/// replicates. Throws InputError where the solution does not fit the scene.
RenderResult render_solution(const Scene& scene, const Sensor& camera, estimators::PatchSolution solution,
                             int threads = 0, PictureSink* sink = nullptr,
                             const std::atomic<bool>* interrupt = nullptr);

}  // namespace stilb::run
