// A run: deals batches of an estimator to threads, asks the stopping rule, makes readings with intervals.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/rgb.h"
#include "estimators/patch_light/patch_report.h"
#include "run/level_of_detail.h"
#include "run/options.h"
#include "scene/scene.h"
#include "sensors/sensor.h"
#include "statistics/grid_summary.h"
#include "statistics/interval.h"

namespace stilb::run {

struct Reading {
    statistics::Estimate estimate;  ///< [lx] or [cd/m2]
    Rgb rgb;
};

struct SensorResult {
    std::vector<Reading> readings;  ///< in the order of the sensor's measurands
    /// Luminance sensors: where each line of sight ends; nothing where it leaves the scene. Empty: not known.
    std::vector<std::optional<Vec3>> sub_points;
    statistics::GridSummary summary;
    double attained_error = 0;  ///< relative half-width that 95 % of the readings keep
};

/// `solved`: there is nothing more to do, as a method without chance is done.
enum class StopReason { target_reached, paths_done, time_over, interrupted, solved };

struct RunResult {
    std::string method;
    std::uint64_t seed = 0;
    std::uint64_t paths = 0;
    std::uint64_t rays = 0;  ///< of the fans
    int replicates = 0;      ///< 1 where there are no errors: they are NaN
    double elapsed_s = 0;
    StopReason stop_reason = StopReason::paths_done;
    /// False where an error was asked for and is not met.
    bool converged = true;
    double attained_error = 0;                       ///< the worst sensor's
    std::vector<SensorResult> sensors;               ///< in the order asked for
    std::optional<estimators::PatchReport> patches;  ///< where the method lights patches
    std::vector<LevelOfDetail> levels_of_detail;
    std::vector<std::string> warnings;
};

/// Where a run tells how far it is; called from the run's own thread, a few times a second at most.
class ProgressSink {
  public:
    virtual ~ProgressSink() = default;
    struct Progress {
        double elapsed_s = 0;
        double remaining_s = 0;  ///< estimated
        double attained_error = 0;
        std::uint64_t paths = 0;
    };
    virtual void report(const Progress& progress) = 0;
};

/// Measures all sensors at once. The result depends on scene, sensors, method, bounces and seed, and on the
/// paths done: not on threads or time (a time limit decides how many paths are done). `interrupt` ends the
/// run early, in good order. A deterministic method ends by itself only; its errors are NaN. Throws
/// InputError where an option is wrong, std::runtime_error where the numbers are (too many are not finite).
RunResult measure(const Scene& scene, std::span<const Sensor> sensors, const RunOptions& options,
                  ProgressSink* progress = nullptr, const std::atomic<bool>* interrupt = nullptr);

}  // namespace stilb::run

namespace stilb {
using run::ProgressSink;
using run::Reading;
using run::RunResult;
using run::SensorResult;
using run::StopReason;
}  // namespace stilb
