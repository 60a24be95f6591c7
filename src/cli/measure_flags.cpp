#include "cli/measure_flags.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/scene_argument.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

/// Seconds a reading that statistics and files take after the last sample. Two threads were measured.
constexpr double kFinishing_s = 3e-6;

run::Target target_of(const std::string& name) {
    const auto found = std::ranges::find(run::kTargetNames, name);
    if (found == run::kTargetNames.end()) {
        throw InputError(fmt::format("--target {}: there is no such value.{} Allowed: {}.", name,
                                     did_you_mean(name, run::kTargetNames),
                                     fmt::join(run::kTargetNames, ", ")));
    }
    return static_cast<run::Target>(found - run::kTargetNames.begin());
}

}  // namespace

void MeasureFlags::add_to(Command& command) {
    command.add("--sensor", sensors, "Measure only this sensor (may be repeated)")
        .value_name("NAME")
        .repeatable();
    command.add(
        "--check", checks,
        "Exit with code 1 where a requirement of a sensor (require = ...) is not met, with code 3 where "
        "it is not sure yet, else with 0");
    command
        .add("--target", target,
             "Readings (default: 95 % of each sensor's) or mean (means and minima of the sensors) have the "
             "error of --error")
        .value_name("NAME");
    add_overrides(command, overrides);
    run.add_to(command);
}

RunOptions MeasureFlags::options_for(std::span<const Sensor> measured, const RunOptions& of_file,
                                     const std::string& scene) const {
    if (checks && !sensors::has_requirements(measured)) {
        throw InputError(
            "--check: no measured sensor has a key \"require\", such as require = { mean = 500 }.", {scene});
    }
    std::size_t readings = 0;
    for (const Sensor& sensor : measured) readings += sensor.size();
    RunOptions options = with_reserve(run.over(of_file), kFinishing_s * static_cast<double>(readings));
    if (target) options.target = target_of(*target);
    return options;
}

int MeasureFlags::exit_code_of(const RunResult& result) const {
    if (!checks) return result.converged ? kExitDone : kExitStoppedEarly;
    const Verdict verdict = run::verdict_of(result).value_or(Verdict::undecided);
    if (verdict == Verdict::fail) return kExitCheckFailed;
    return verdict == Verdict::pass ? kExitDone : kExitStoppedEarly;
}

}  // namespace stilb::cli
