// The view-independent light of a scene, by stochastic iteration with ray bundles (bundle_iteration.h):
// independent walks, whose spread gives the error that ends them.
#pragma once

#include <atomic>

#include "estimators/patch_light/patch_solution.h"
#include "run/options.h"
#include "run/result.h"
#include "run/run.h"
#include "scene/scene.h"

namespace stilb::run {

/// The degree of the basis for the light of glossy sides; docs/solution.md states its cost and accuracy.
inline constexpr int kDefaultDegree = 6;

/// The attained error is that of the sides which get 95 % of the flux.
struct SolveResult : RunSummary {
    estimators::PatchSolution solution;
};

/// Solves by method ray-bundle, regardless of the options' method; their `paths` are steps of all walks
/// together. Without any limit, for a minute. The result depends on scene, patches, degree and seed, and on
/// the steps done: not on threads. `interrupt` ends the run early, with a result. Throws as measure(), and
/// InputError for first shots that cannot be stored: all but incoming and none.
SolveResult solve(const Scene& scene, const RunOptions& options, int degree = kDefaultDegree,
                  ProgressSink* progress = nullptr, const std::atomic<bool>* interrupt = nullptr);

}  // namespace stilb::run

namespace stilb {
using run::SolveResult;
}  // namespace stilb
