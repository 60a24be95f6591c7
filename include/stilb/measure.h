// Readings of sensors, with an error on every number.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "stilb/options.h"
#include "stilb/scene.h"

namespace stilb::api {

/// A value with its standard error and its 95 % interval. The interval also contains the error of patches,
/// for methods that store light on them.
struct Estimate {
    double value = 0;
    double standard_error = 0;
    double lower = 0, upper = 0;
};

struct Reading : Estimate {
    Triple rgb{};       ///< linear Rec. 709, in the sensor's unit; its luminance is the value
    Triple position{};  ///< [m]
    /// The unit normal of a measuring point, the axis of a body, or the viewing direction; NaN where there is
    /// none.
    Triple direction{};
};

enum class Verdict { pass, fail, undecided, unsure };

/// One entry of a sensor's `require`, and its verdict: pass and fail are certain at 95 %. More samples may
/// decide what is undecided, but not what is unsure, and why stands in `reason`.
struct Requirement {
    std::string key;  ///< "mean", "uniformity" ...
    double limit = 0;
    Verdict verdict = Verdict::undecided;
    std::string reason{};
};

/// The readings of one sensor; of a derived value a single one, without colour and position (NaN).
struct SensorResult {
    std::string name, type;
    std::string quantity, unit;     ///< such as "illuminance" and "lx"
    std::array<int, 2> count{};     ///< columns and rows of a grid; {0, 0} of other sensors
    std::vector<Reading> readings;  ///< of a grid row by row
    Estimate mean, minimum, maximum;
    Estimate uniformity;        ///< minimum over mean
    double attained_error = 0;  ///< relative half-width of the intervals of 95 % of the readings, at most
    Estimate diversity;         ///< minimum over maximum
    std::vector<Requirement> requirements;
    /// The readings in each independent replicate, replicates x readings: the basis of all errors, from which
    /// those of differences and other functions of readings follow. Rows of runs with the same seed belong
    /// together.
    std::vector<double> replicates;
};

/// A run of measure(), render() or solve(): its options, its effort and its success.
struct Summary {
    std::string method;
    /// The method that gives the same digits with the same seed and number of samples: what "auto" has chosen
    /// ("path", "light-paths", "guided"), or the method itself.
    std::string technique;
    std::uint64_t seed = 0;
    std::uint64_t samples = 0;  ///< as in Options
    int replicates = 0;         ///< independent repetitions that the errors come from
    double elapsed_s = 0;
    /// What ended the run: "target reached", "requirements decided", "paths done", "time over", "interrupted"
    /// or "patches too coarse".
    std::string stopped;
    /// False where the error asked for was not reached, or the run was interrupted.
    bool converged = true;
    std::optional<double> requested_error;
    double attained_error = 0;
    std::vector<std::string> warnings;
    std::vector<std::string> warning_kinds;  ///< of each: "holes", "rare-light" ... (docs/warnings.md)
};

struct Result : Summary {
    std::vector<SensorResult> sensors;
    /// The nominal confidence of the intervals: more than 0.95 where the run stopped by its own estimates, so
    /// that they hold in 95 % of the runs.
    double confidence = 0.95;

    /// The document that `stilb measure --json` prints: docs/json.md.
    std::string json() const;
    /// Throws InputError where there is no such sensor.
    const SensorResult& operator[](std::string_view sensor) const;

    struct Data;
    std::shared_ptr<const Data> data;
};

/// Measures the sensors of a scene that are no cameras, or those of these names. Without options, by the
/// scene file's section [run]. The result depends on the scene, the sensors, the method, the limits, the seed
/// and the number of samples, and not on the number of threads. Throws InputError where an option is wrong or
/// the scene has no such sensor, and Cancelled where the run ends before there is a result.
Result measure(const Scene& scene, const std::optional<Options>& options = {}, const Control& control = {},
               const std::vector<std::string>& sensors = {});

/// A position [m] with the unit normal of a surface element, or with a viewing direction.
struct Ray {
    Triple position{}, direction{};
};

/// The illuminance of surface elements in a scene, whatever its sensors are: a result with the one sensor
/// "illuminance". Directions may have any length but 0. Otherwise as measure().
Result illuminance(const Scene& scene, std::span<const Ray> elements,
                   const std::optional<Options>& options = {}, const Control& control = {});
/// The luminance along lines of sight: the sensor "luminance". Otherwise as illuminance().
Result luminance(const Scene& scene, std::span<const Ray> sights, const std::optional<Options>& options = {},
                 const Control& control = {});

}  // namespace stilb::api
