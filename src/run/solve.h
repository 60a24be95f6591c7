// The light of a scene for all eyes at once, by stochastic iteration with ray bundles (bundle_iteration.h):
// independent walks, asked when to stop by what they differ in.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "estimators/patch_light/patch_solution.h"
#include "run/options.h"
#include "run/run.h"
#include "scene/scene.h"

namespace stilb::run {

/// Of the basis that the light of glossy sides is kept in; docs/solution.md has what it costs and gives.
inline constexpr int kDefaultDegree = 6;

struct SolveResult {
    estimators::PatchSolution solution;
    estimators::PatchReport patches;
    std::uint64_t seed = 0;
    std::uint64_t steps = 0;  ///< of all walks together, without the first ones of each
    double elapsed_s = 0;
    StopReason stop_reason = StopReason::paths_done;
    bool converged = true;      ///< false where an error was asked for and is not met
    double attained_error = 0;  ///< relative half-width that the sides keep which get 95 % of the flux
    std::vector<std::string> warnings;
};

/// Solves by method ray-bundle, whatever the options' method; their `paths` are steps of all walks together.
/// Without any target, for a minute. The result depends on scene, patches, degree and seed, and
/// on the steps done: not on threads. `interrupt` ends the run early, in good order. Throws InputError where
/// an option is wrong, and for first shots that are not stored: all but incoming and none.
SolveResult solve(const Scene& scene, const RunOptions& options, int degree = kDefaultDegree,
                  ProgressSink* progress = nullptr, const std::atomic<bool>* interrupt = nullptr);

}  // namespace stilb::run

namespace stilb {
using run::SolveResult;
}  // namespace stilb
