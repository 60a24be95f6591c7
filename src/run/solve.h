// The view-independent light of a scene, by stochastic iteration with ray bundles (bundle_iteration.h):
// independent walks, whose spread gives the error that ends them.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/bytes.h"
#include "estimators/patch_light/solution/patch_solution.h"
#include "run/options.h"
#include "run/prepared_scene.h"
#include "run/result.h"
#include "run/run.h"
#include "scene/scene.h"

namespace stilb::run {

/// The degree of the basis for the light of glossy sides; docs/solution.md states its cost and accuracy.
inline constexpr int kDefaultDegree = 6;

/// The attained error is that of the places which get 95 % of the flux.
struct SolveResult : RunSummary {
    estimators::PatchSolution solution;
};

/// A sink that can show unfinished solutions.
class SolutionSink {
  public:
    virtual ~SolutionSink() = default;
    /// The surfaces are divided: everything but the light is known. Called once, from the run's thread.
    virtual void prepare(const rays::RayCaster& caster, const estimators::PatchSolution& dark) = 0;
    /// Whether the unfinished solution is wanted now; asked some times in a second. If so, show() is called
    /// with it.
    virtual bool wants_solution() = 0;
    virtual void show(const estimators::PatchSolution& solution, const RunSummary& so_far) = 0;
};

/// The longest edge of patches: by the scene, unless the options say. Light is gathered at the vertices of
/// finer patches, so that far fewer are needed than for pictures by ray-bundle.
inline constexpr double kSolutionPatches = 3000;
/// At most so many finer patches.
inline constexpr std::size_t kMostFinePatches = 60'000;

/// A solution that is being computed, between two of its steps: a value that another run continues.
class SolutionState {
  public:
    bool has_begun() const { return live_ || !bytes_.empty(); }
    void write(ByteWriter& bytes) const { bytes.add_list(live_ ? live_() : bytes_); }
    static SolutionState read(ByteReader& bytes);

    // For solve().

    const std::string& bytes() const { return bytes_; }
    /// While a run goes on, it gives the bytes.
    void follow(std::function<std::string()> live) { live_ = std::move(live); }
    void end() {
        bytes_ = live_();
        live_ = nullptr;
    }

  private:
    std::string bytes_;
    std::function<std::string()> live_;
};

/// Solves by method ray-bundle and by gathering at vertices, regardless of the options' method; their `paths`
/// are steps of all replicates together. Without any limit, for a minute. The result depends on scene,
/// patches, degree and seed, and on the steps done: not on threads. `interrupt` ends the run early, with a
/// result. Throws as measure(), and InputError for first shots that cannot be stored: all but incoming and
/// none. `state`: may be null; it is continued as the state of measure() is.
SolveResult solve(const PreparedScene& scene, const RunOptions& options, int degree = kDefaultDegree,
                  ProgressSink* progress = nullptr, const std::atomic<bool>* interrupt = nullptr,
                  SolutionSink* sink = nullptr, SolutionState* state = nullptr);

}  // namespace stilb::run

namespace stilb {
using run::SolutionSink;
using run::SolveResult;
}  // namespace stilb
