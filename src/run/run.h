// Runs: readings of all sensors of a scene, and pictures of a camera.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <string_view>

#include "run/options.h"
#include "run/plan.h"
#include "run/prepared_scene.h"
#include "run/result.h"
#include "scene/light_groups.h"
#include "scene/scene.h"

namespace stilb::estimators {
struct PatchSolution;
}  // namespace stilb::estimators

namespace stilb::run {

class PictureSums;

// Progress of a run.

class ProgressSink {
  public:
    virtual ~ProgressSink() = default;

    /// Called before the first sample, some ten times in a second at most; from any thread, one call at a
    /// time.
    struct SetUp {
        std::string_view stage;  ///< "first shot", "shooting" ...
        double share = 0;        ///< of the stage, from 0 to 1
        double elapsed_s = 0;
    };
    virtual void report_set_up(const SetUp&) {}

    /// Called from the run's own thread after each piece of work: a part of a second or more of all threads'
    /// work, if there is so much.
    struct Progress {
        double elapsed_s = 0;
        double remaining_s = 0;     ///< estimated; infinite where there is no limit
        double attained_error = 0;  ///< at the last estimate; infinite before it
        std::uint64_t samples = 0;  ///< as RunSummary
    };
    virtual void report(const Progress& progress) = 0;
};

/// A sink that can show unfinished pictures.
class PictureSink : public ProgressSink {
  public:
    /// Whether the unfinished picture is wanted now; called after each report(). If so, show() is called with
    /// it.
    virtual bool wants_picture() = 0;
    virtual void show(const Pixels& pixels) = 0;
};

// Runs take a scene, or a prepared one, which spares later runs the set-up that they have in common.

// Readings.

/// Measures all sensors at once. Without any limit in the options, to an error of 1 % or for a minute. The
/// result depends on scene, sensors, method, bounces and seed, and on the samples done: not on threads or
/// time (a time limit decides how many samples are done). `interrupt` ends the run early, with a result.
/// Throws InputError where an option is wrong, Cancelled where user or time limit end the run before there is
/// a result, std::runtime_error where the numbers are wrong (too many are not finite).
///
/// `state`: may be null. One without a plan receives the plan of the run and its sums. One with a plan is
/// continued, in the technique and with the seed of its plan, and keeps what was done where an exception ends
/// it. The other options must be those that it began with. A run that stopped by its error, by time or by the
/// user then gives the bits of a run in one go; so do parts that were merged. One that ended at its number of
/// paths between two error estimates goes on with batches of other lengths, so that last bits may differ.
RunResult measure(const PreparedScene& scene, std::span<const Sensor> sensors, const RunOptions& options,
                  ProgressSink* progress = nullptr, const std::atomic<bool>* interrupt = nullptr,
                  RunState* state = nullptr);

/// The result of the sums in `state`, without more samples, at the limits that the run had. `dimmed`: with
/// the lamps in this state, or null. Throws InputError where the run has not kept apart what this needs.
RunResult result_of(const PreparedScene& scene, std::span<const Sensor> sensors, const RunOptions& options,
                    RunState& state, const LightScene* dimmed = nullptr, ProgressSink* progress = nullptr,
                    const std::atomic<bool>* interrupt = nullptr);

/// Makes the samples of a part of the run whose plan `state` has: as many as `options` asks of the whole run.
/// Throws as measure() does. All parts need the same options, and the same plan. A plan that is not complete
/// is completed by the first samples of all parts, which cost each part as much as the whole run.
RunSummary measure_part(const PreparedScene& scene, std::span<const Sensor> sensors,
                        const RunOptions& options, RunPart part, RunState& state,
                        ProgressSink* progress = nullptr, const std::atomic<bool>* interrupt = nullptr);

// Pictures, pass by pass, with standard errors.

/// Renders one camera. Without any limit, for a minute. The result depends on scene, camera, method, bounces
/// and seed, and on the passes done: not on threads. `interrupt` ends the run early, with a result. Throws as
/// measure() does. `state`: may be null; it is continued as the state of measure() is.
RenderResult render(const PreparedScene& scene, const Sensor& camera, const RunOptions& options,
                    PictureSink* sink = nullptr, const std::atomic<bool>* interrupt = nullptr,
                    PictureSums* state = nullptr);

/// The picture of the sums in `state`, without more passes, at the limits that the run had. Throws InputError
/// where a replicate has none: the other parts are lacking.
RenderResult result_of(const PreparedScene& scene, const Sensor& camera, const RunOptions& options,
                       PictureSums& state, const std::atomic<bool>* interrupt = nullptr);

/// Makes the passes of a part of the picture whose plan `state` has: as many as `options` asks of the whole
/// picture. As measure_part(); a picture has as many parts at most as replicates, otherwise InputError.
RunSummary render_part(const PreparedScene& scene, const Sensor& camera, const RunOptions& options,
                       RunPart part, PictureSums& state, PictureSink* sink = nullptr,
                       const std::atomic<bool>* interrupt = nullptr);

/// Renders one camera from a solution, its groups of lights multiplied by factors: a few passes for smooth
/// edges. Errors come from the solution's replicates. Throws InputError where the solution does not fit the
/// scene, and for names that are no groups.
RenderResult render_solution(const Scene& scene, const Sensor& camera, estimators::PatchSolution solution,
                             std::span<const LightFactor> factors = {}, int threads = 0,
                             PictureSink* sink = nullptr, const std::atomic<bool>* interrupt = nullptr);

}  // namespace stilb::run

namespace stilb {
using run::PictureSink;
using run::ProgressSink;
}  // namespace stilb
