// Runs: readings of all sensors of a scene, and pictures of a camera.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <string_view>

#include "run/options.h"
#include "run/result.h"
#include "scene/scene.h"

namespace stilb::estimators {
struct PatchSolution;
}  // namespace stilb::estimators

namespace stilb::run {

// How far a run is.

class ProgressSink {
  public:
    virtual ~ProgressSink() = default;

    /// Before the first sample, some ten times in a second at most; from any thread, one call at a time.
    struct SetUp {
        std::string_view stage;  ///< "first shot", "shooting" ...
        double share = 0;        ///< of the stage, from 0 to 1
        double elapsed_s = 0;
    };
    virtual void report_set_up(const SetUp&) {}

    /// From the run's own thread, after each piece of work: a part of a second or more of all threads' work,
    /// where there is so much.
    struct Progress {
        double elapsed_s = 0;
        double remaining_s = 0;     ///< estimated; infinite where nothing says when to stop
        double attained_error = 0;  ///< at the last look; infinite before it
        std::uint64_t samples = 0;  ///< as RunSummary
    };
    virtual void report(const Progress& progress) = 0;
};

/// One that can show pictures before they are finished.
class PictureSink : public ProgressSink {
  public:
    /// Whether the picture so far is wanted now; asked for after each report(). show() is then called with
    /// it.
    virtual bool wants_picture() = 0;
    virtual void show(const Pixels& pixels) = 0;
};

// Readings.

/// Measures all sensors at once. Without any target, to an error of 1 % or for a minute. The result depends
/// on scene, sensors, method, bounces and seed, and on the samples done: not on threads or time (a time limit
/// decides how many samples are done). `interrupt` ends the run early, in good order. A deterministic method
/// ends by itself; its errors are NaN. Throws InputError where an option is wrong, Cancelled where user or
/// time limit end it before there is a result, std::runtime_error where the numbers are wrong (too many are
/// not finite).
RunResult measure(const Scene& scene, std::span<const Sensor> sensors, const RunOptions& options,
                  ProgressSink* progress = nullptr, const std::atomic<bool>* interrupt = nullptr);

// Pictures, pass by pass, with standard errors.

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

namespace stilb {
using run::PictureSink;
using run::ProgressSink;
}  // namespace stilb
