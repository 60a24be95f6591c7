// A picture: deals passes of an estimator to threads, asks when to stop, makes pixels with standard errors.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "estimators/patch_light/patch_solution.h"
#include "run/options.h"
#include "run/run.h"
#include "scene/scene.h"
#include "sensors/sensor.h"

namespace stilb::run {

/// Pixels row by row from the top, NaN where the camera shows nothing.
struct Pixels {
    std::vector<std::array<float, 3>> rgb_cd_m2;  ///< linear Rec. 709
    std::vector<float> standard_error_cd_m2;      ///< of the luminance; empty with one replicate
};

struct RenderResult {
    Pixels pixels;
    std::vector<std::array<float, 3>> normals;  ///< of the surface in the pixel's middle; NaN where none is
    std::vector<float> depth_m;                 ///< its distance; NaN likewise
    std::string method;
    std::uint64_t seed = 0;
    std::uint64_t passes = 0;  ///< samples of each pixel
    int replicates = 0;        ///< 1 after a single pass and without chance: errors are infinite, not known
    double elapsed_s = 0;
    StopReason stop_reason = StopReason::paths_done;
    bool converged = true;      ///< false where an error was asked for and is not met
    double attained_error = 0;  ///< relative half-width that 95 % of the pixels keep
    double mean_luminance_cd_m2 = 0;
    double mean_standard_error_cd_m2 = 0;            ///< of single pixels
    std::optional<estimators::PatchReport> patches;  ///< where the method lights patches
    std::vector<LevelOfDetail> levels_of_detail;
    std::vector<std::string> warnings;
};

/// Where a picture tells how far it is; called from the run's own thread after each pass.
class PictureSink {
  public:
    virtual ~PictureSink() = default;
    struct Progress {
        double elapsed_s = 0;
        double remaining_s = 0;     ///< estimated; infinite where nothing says when to stop
        double attained_error = 0;  ///< at the last look; infinite before it
        std::uint64_t passes = 0;
    };
    virtual void report(const Progress& progress) = 0;
    /// Whether the picture so far is wanted now; then show() is called with it.
    virtual bool wants_picture() = 0;
    virtual void show(const Pixels& pixels) = 0;
};

/// Renders one camera. Without any target, for a minute. The result depends on scene, camera, method, bounces
/// and seed, and on the passes done: not on threads. `interrupt` ends the run early, in good order. Throws as
/// run() does.
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
using run::Pixels;
using run::RenderResult;
}  // namespace stilb
