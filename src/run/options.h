// The options of a run: plain values.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "estimators/patch_light/patch_options.h"

namespace stilb::run {

/// What the error of a run of readings is that of: single readings, or means and minima of the sensors.
enum class Target { readings, mean };
/// In the order of the enumeration.
inline constexpr std::array<std::string_view, 2> kTargetNames{"readings", "mean"};

/// Whether a run makes all checks, or only those that refuse scenes: for who shows no warnings.
enum class Checks { all, refusals };

struct RunOptions {
    std::string method = "auto";
    /// The run stops at this relative half-width of the 95 % interval, met by 95 % of each sensor's readings
    /// (of a picture's pixels, of a solution's light), or as `target` says.
    std::optional<double> error;
    Target target = Target::readings;
    std::optional<double> time_s;
    /// The part of time_s that the caller needs after the run, for example to write files.
    double reserved_s = 0;
    /// The total number of samples, as RunSummary's.
    std::optional<std::uint64_t> paths;
    /// The largest number of reflections; unlimited where absent (Russian roulette then ends paths without
    /// bias).
    std::optional<int> bounces;
    std::uint64_t seed = 1;
    /// The number of threads; 0: all that the machine has.
    int threads = 0;
    Checks checks = Checks::all;
    /// The number of independent repetitions, from which standard errors of readings are estimated (theory
    /// 6). Absent: 8 where readings lie side by side in large grids, else 32.
    std::optional<int> replicates;
    estimators::PatchOptions patches;
};

/// Whether a run of readings ends as soon as all requirements are decided: unless an error is asked for, or a
/// number of samples alone, of which it then does neither more nor less.
inline bool ends_when_decided(const RunOptions& options) {
    return !options.error && (!options.paths || options.time_s);
}

/// Throws InputError where an option is out of its range.
void require_valid(const RunOptions& options);

/// "0.01" or "1%" as 0.01; nothing for other texts and for values outside of 0 to 1.
std::optional<double> parse_relative_error(std::string_view text);

}  // namespace stilb::run

namespace stilb {
using run::RunOptions;
using run::Target;
}  // namespace stilb
