// Readings of sensors, with an error on every number.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "stilb/options.h"
#include "stilb/scene.h"

#pragma GCC visibility push(default)

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

/// The part of a sensor's readings that comes from one light, one group of lights, or one number of
/// reflections.
struct LightShare {
    std::string name;
    std::vector<Estimate> readings;
    Estimate mean, minimum, maximum, uniformity, diversity;
    std::vector<double> replicates;  ///< as those of the sensor
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
    std::vector<LightShare> shares;  ///< with Options::by: they add up to the readings
};

/// The readings in a state of the lamps ([scenes.NAME]).
struct LightSceneResult {
    std::string name;
    std::vector<SensorResult> sensors;
    std::optional<double> power_w;  ///< of the lamps so, where it is known
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
    /// Why the run ended: "target reached", "requirements decided", "paths done", "time over", "interrupted"
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
    std::shared_ptr<const Data> data{};
    std::vector<LightSceneResult> light_scenes{};
};

/// A run of measure() between two of its batches: a value that other calls continue, here or elsewhere. It
/// knows the scene, the sensors and the options that its samples depend on.
class RunState {
  public:
    /// The state of a run that has not begun.
    RunState();
    RunState(const RunState& other);
    RunState& operator=(const RunState& other);
    RunState(RunState&&) noexcept = default;
    RunState& operator=(RunState&&) noexcept = default;
    /// As bytes() has made them, or the contents of a state file (docs/runs.md). Throws InputError where they
    /// are damaged, or of another command than `stilb measure`. `name`: of the file, for messages.
    explicit RunState(std::string_view bytes, const std::string& name = "state of a run");
    std::string bytes() const;
    /// Writes a state file in one step, from which `stilb resume` goes on. Throws InputError where it cannot
    /// be written.
    void save(const std::filesystem::path& path) const;

    /// The words of `stilb measure` that begin this run, and the folder where they hold, relative to that of
    /// the state file. Runs of the library have none, unless they are set.
    const std::vector<std::string>& arguments() const;
    const std::string& folder() const;
    void set_command(std::vector<std::string> arguments, std::string folder);

    bool has_begun() const;         ///< what comes before samples is decided
    std::uint64_t samples() const;  ///< as in Options
    std::vector<std::uint64_t> seeds() const;
    double elapsed_s() const;  ///< of all calls that have added samples
    /// The number of samples at the next error estimate of a run that has begun, after those that it has, or
    /// after so many: a run that stops there goes on with the bits of a run in one go.
    std::uint64_t samples_at_next_check() const { return samples_at_next_check(samples()); }
    std::uint64_t samples_at_next_check(std::uint64_t after) const;

    /// Adds the samples of another part of the run, or of a run with another seed. Throws InputError where it
    /// is of another scene, of other sensors or options, and where both have the same samples.
    void merge(const RunState& other);

    struct Data;
    Data& data() { return *data_; }
    const Data& data() const { return *data_; }

  private:
    std::shared_ptr<Data> data_;
};

/// Measures the sensors of a scene that are no cameras, or those of these names. Without options, by the
/// scene file's section [run]. The result depends on the scene, the sensors, the method, the limits, the seed
/// and the number of samples, and not on the number of threads. Throws InputError where an option is wrong or
/// the scene has no such sensor, and Cancelled where the run ends before there is a result. `state`: may be
/// null; it is begun, or continued to the limits of the options, which count all samples; the time of the
/// result is that of all calls. Throws InputError where it is of another run.
Result measure(const Scene& scene, const std::optional<Options>& options = {}, const Control& control = {},
               const std::vector<std::string>& sensors = {}, RunState* state = nullptr);

/// The same up to the next error estimate at most. Where the limits are not met there, the result so far is
/// "interrupted", and the next call goes on with the bits of a run in one go.
Result measure_to_next_check(const Scene& scene, const std::optional<Options>& options,
                             const Control& control, const std::vector<std::string>& sensors,
                             RunState& state);

/// Decides what all parts of a run have in common, such as the technique, without samples that count: copies
/// of this state spare the parts to do so. Throws as measure_part().
void plan_parts(const Scene& scene, const Options& options, RunState& state, const Control& control = {},
                const std::vector<std::string>& sensors = {});

/// Makes part number `part` (from 0) of `parts` of the samples that `options.paths` asks of the whole run.
/// All parts together, merged, are the bits of the whole. Returns the effort of the part.
Summary measure_part(const Scene& scene, const Options& options, std::size_t part, std::size_t parts,
                     RunState& state, const Control& control = {},
                     const std::vector<std::string>& sensors = {});

/// The result of the samples in a state, without more of them, with the lights or groups of lights dimmed by
/// these factors. Throws InputError where the state is of another run, or has not kept these lights apart
/// (Options::by = "light").
Result result_of(const Scene& scene, const RunState& state, const std::optional<Options>& options = {},
                 const std::vector<std::string>& sensors = {},
                 const std::map<std::string, Triple>& factors = {});

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

#pragma GCC visibility pop
