// The options of a run: those that users set (stilb/options.h), and those of the program.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "estimators/patch_light/patch_options.h"
#include "scene/light_groups.h"
#include "stilb/options.h"

namespace stilb::run {

/// Whether a run makes all checks, or only those that refuse scenes: for who shows no warnings.
enum class Checks { all, refusals };

struct RunOptions : api::Options {
    /// The part of time_s that the caller needs after the run, for example to write files.
    double reserved_s = 0;
    Checks checks = Checks::all;
    /// Readings: the run also ends at its next error estimate, as one that is interrupted.
    bool stops_at_check = false;
    /// The number of independent repetitions, from which standard errors of readings are estimated (theory
    /// 6). Absent: 8 where readings lie side by side in large grids, else 32.
    std::optional<int> replicates;
    estimators::PatchMethodOptions patches;
    /// States of the lamps for which readings are stated, too.
    std::vector<LightScene> light_scenes;
};

/// Whether a run of readings ends as soon as all requirements are decided: unless an error is asked for, or a
/// number of samples alone, of which it then does neither more nor less.
inline bool ends_when_decided(const RunOptions& options) {
    return !options.error && (!options.paths || options.time_s);
}

/// Whether the error is that of means and minima of the sensors instead of single readings.
inline bool is_error_of_means(const RunOptions& options) { return options.target == "mean"; }

/// Calls `visit(option, value)` for each of api::Options that has a value.
template <typename Visit>
void for_each_value(const api::Options& options, const Visit& visit) {
    for_each_field<api::Options>([&](const auto& option) {
        const auto& value = options.*option.member;
        if constexpr (requires { value.has_value(); }) {
            if (value) visit(option, *value);
        } else {
            visit(option, value);
        }
    });
}

/// The options of methods on patches that these stand for.
estimators::PatchMethodOptions patch_options(const api::Options& options);
/// Why an option of patches, by its flag without dashes, has no effect with the method of the options;
/// nothing where it has one, and for all other options. `first_shot`: the name of that option for the
/// caller's user.
std::optional<std::string> lack_of_effect(const api::Options& options, std::string_view flag,
                                          std::string_view first_shot);
/// "first-shot" of "first_shot": as flags and lists of options are named.
std::string flag_of(std::string_view key);

/// Throws InputError where an option is outside of its limits.
void require_valid(const RunOptions& options);

/// "0.01" or "1%" as 0.01; nothing for other texts and for values outside of 0 to 1.
std::optional<double> parse_relative_error(std::string_view text);

}  // namespace stilb::run

namespace stilb {
using run::RunOptions;
}  // namespace stilb
