// Results of runs: plain values, which can be kept, written and combined without the scene.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/rgb.h"
#include "base/vec.h"
#include "base/warning.h"
#include "estimators/patch_light/patch_options.h"
#include "scene/installed_power.h"
#include "sensors/sensor.h"
#include "statistics/grid_summary.h"
#include "statistics/interval.h"

namespace stilb::run {

/// `patches_too_coarse`: no number of samples reaches the requested error.
enum class StopReason {
    target_reached,
    requirements_decided,
    paths_done,
    time_over,
    interrupted,
    patches_too_coarse
};
/// As JSON has them, in the order of the enumeration.
inline constexpr std::array<std::string_view, 6> kStopReasonNames{
    "target reached", "requirements decided", "paths done", "time over", "interrupted", "patches too coarse"};
constexpr std::string_view name_of(StopReason reason) {
    return kStopReasonNames[static_cast<std::size_t>(reason)];
}

/// The truncation of the series of an object (level_of_detail.h).
struct LevelOfDetail {
    std::string object;
    int degree = 0, full_degree = 0;
    double error_m = 0;    ///< bound of the distance between both surfaces, along rays from the centre
    double allowed_m = 0;  ///< half the footprint
};

/// The common part of all results.
struct RunSummary {
    std::string method;
    /// The method that gives the same result with the same seed and number of samples: what `auto` has
    /// chosen, or the method itself.
    std::string technique;
    std::uint64_t seed = 0;
    /// The total number of samples of the technique (estimator_list()); for pictures passes (samples of a
    /// pixel; some pixels take fewer); for solutions steps of all walks, without the first ones of each.
    std::uint64_t samples = 0;
    /// Independent repetitions that the errors come from; fewer than asked for where the run ended before all
    /// of them had begun. 1 where there are no errors: after a single pass.
    int replicates = 0;
    double elapsed_s = 0;
    StopReason stop_reason = StopReason::paths_done;
    /// False where a requested error is not met, and after an interruption.
    bool converged = true;
    std::optional<double> requested_error;  ///< relative half-width, where there was a limit on it
    /// Relative half-width that 95 % meet: of the readings of the worst sensor, of the pixels, or of the
    /// light on the sides of patches. With the target "mean" the worst one of means and minima.
    double attained_error = 0;
    std::optional<estimators::PatchReport> patches;  ///< for methods on patches
    std::vector<LevelOfDetail> levels_of_detail;
    /// The lowest and the highest maintenance factor of the lamps; nothing where none is below 1.
    std::optional<std::array<double, 2>> maintenance;
    std::vector<Warning> warnings;
};

struct Reading {
    statistics::Estimate estimate;  ///< [lx] or [cd/m2]; the errors are NaN where they are unknown
    Rgb rgb;
    /// Methods on patches: the part of the interval on each side that stands for their error.
    std::optional<double> patch_error{};
};

/// Whether a requirement is met, for certain at 95 %. Undecided: more samples may tell. Unsure: they cannot,
/// because something that the value leaves out could change the verdict.
enum class Verdict { pass, fail, undecided, unsure };

/// "pass", "fail", "not sure yet", "not sure".
std::string_view name_of(Verdict verdict);

struct RatedRequirement {
    Requirement requirement;
    Verdict verdict = Verdict::undecided;
    std::string reason{};  ///< where it is unsure: a text such as "light "d" is ..."

    bool is_undecided() const { return verdict == Verdict::undecided; }
};

/// Whether a rating of glare counts a lamp. Large: it does, but was not made for it. Dim: below the threshold
/// of DGP.
enum class GlareStanding { counted, large, small, outside, point, dim };
constexpr bool is_counted(GlareStanding standing) { return standing <= GlareStanding::large; }
/// Such as "less than 0.0003 sr"; empty of those that are counted without a remark.
std::string_view text_of(GlareStanding standing);

/// A lamp that a view sees, as a source of glare.
struct GlareSource {
    std::string light;
    double luminance_cd_m2 = 0, solid_angle_sr = 0;  ///< 0 of points
    double position_index = 0;                       ///< Guth's
    GlareStanding standing = GlareStanding::counted;
};
/// What the eye of a sensor that rates glare sees.
struct GlareView {
    std::optional<double> background_cd_m2;  ///< of UGR
    std::optional<double> threshold_cd_m2;   ///< of DGP
    std::vector<GlareSource> sources;
};

/// The part of the readings that comes from one light, one group of lights, or one number of reflections.
struct Share {
    std::string name;
    std::vector<statistics::Estimate> readings;  ///< in the order of the sensor's
    statistics::GridSummary summary;
    std::vector<double> replicate_means{};  ///< as those of the sensor
};

struct SensorResult {
    Sensor sensor;
    /// In the order of the sensor's measurands; one of a derived value, whose colour is unknown.
    std::vector<Reading> readings;
    /// Luminance sensors: the end of each line of sight; nothing where it leaves the scene. Empty: not
    /// recorded.
    std::vector<std::optional<Vec3>> sub_points;
    statistics::GridSummary summary;  ///< uniformity and diversity of a derived value are NaN
    double attained_error = 0;        ///< relative half-width that 95 % of the readings meet
    /// Methods on patches: the root mean square of the patches' errors, relative to the readings, at most.
    std::optional<double> patch_error{};
    /// Replicates x readings, luminance-weighted [lx or cd/m2]: the basis of the estimates. Means of
    /// runs with other seeds can be combined with them.
    std::vector<double> replicate_means{};
    std::vector<RatedRequirement> requirements{};
    std::vector<GlareView> glare{};  ///< of each reading of a sensor that rates glare
    std::vector<Share> shares{};     ///< they add up to the readings; of ratings of glare, none
};

/// The installed power over the task areas together (sensors::task_area_m2()).
struct PowerDensity {
    double area_m2 = 0;
    double w_m2 = 0;
    statistics::Estimate w_m2_per_100_lx;  ///< of the areas' mean illuminance
};

/// The installed power of a room with lamps, per square metre of its floor.
struct RoomPower {
    Bounds extent;  ///< [m]
    double floor_m2 = 0;
    double power_w = 0;       ///< of the lamps whose power is known
    std::size_t unknown = 0;  ///< the number of the other lamps

    double w_m2() const { return power_w / floor_m2; }
};

struct RunResult : RunSummary {
    std::string scene_name;  ///< may be empty
    /// Of all files of the scene, and of what is measured (io::add_hashes()); empty where nobody has set
    /// them.
    std::string scene_hash, sensors_hash;
    std::vector<std::uint64_t> seeds;  ///< of runs of several seeds together: all of them; else empty
    std::uint64_t rays = 0;            ///< of the connections to receivers
    /// Nominal, of the intervals: more than 95 % where the run stopped by its own estimates, so that they
    /// hold in 95 % of the runs.
    double confidence = 0.95;
    std::vector<SensorResult> sensors;  ///< in the order requested
    scene::InstalledPower power;
    std::optional<PowerDensity> power_density;
    std::vector<RoomPower> rooms;  ///< those that have lamps, where the power of some is known
    /// For each state of the lamps (RunOptions::light_scenes) its name, sensors, glare and power; nothing
    /// else.
    std::vector<RunResult> light_scenes{};
};

/// On all requirements together: a fail where one fails; nothing where there are none.
std::optional<Verdict> verdict_of(const RunResult& result);

/// Pixels row by row from the top, NaN outside of the camera's field.
struct Pixels {
    std::vector<std::array<float, 3>> rgb_cd_m2;  ///< linear Rec. 709
    std::vector<float> standard_error_cd_m2;      ///< of the luminance; empty with one replicate
    /// The parts of the light that are kept apart; they add up to the whole.
    std::vector<std::vector<std::array<float, 3>>> layers_cd_m2{};
};

struct RenderResult : RunSummary {
    Pixels pixels;
    std::vector<std::string> layers;            ///< the names of those of the pixels
    std::vector<std::array<float, 3>> normals;  ///< of the surface in the pixel's middle; NaN where none is
    std::vector<float> depth_m;                 ///< its distance; NaN likewise
    /// The mean over the pixels: fewer than `samples` where some of them take fewer.
    double samples_per_pixel = 0;
    double mean_luminance_cd_m2 = 0;
    double mean_standard_error_cd_m2 = 0;  ///< of single pixels
    /// Methods on patches: the root mean square of the patches' errors in the pixels, relative, at most. Part
    /// of attained_error, but not of the pixels' standard errors.
    std::optional<double> patch_error{};
};

}  // namespace stilb::run

namespace stilb {
using run::Pixels;
using run::RatedRequirement;
using run::Reading;
using run::RenderResult;
using run::RunResult;
using run::RunSummary;
using run::SensorResult;
using run::StopReason;
using run::Verdict;
}  // namespace stilb
