// Results as text.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "estimators/patch_light/patch_options.h"
#include "run/result.h"
#include "sensors/measurand.h"

namespace stilb::cli {

/// A table with the summary of every sensor, the values of small grids, and the end of the run.
std::string to_table(const RunResult& result);
/// Its last lines: how the run ended, and with how many verdicts on requirements.
std::string end_of_table(const RunResult& result);

/// A line that says so; empty where no lamp has one below 1.
std::string maintenance_line(const RunSummary& result);

/// Where the run ended before its goal: a line that says so, and that `output`, the file, has the result so
/// far. Empty otherwise. `output` may be empty.
std::string shortfall_text(const RunSummary& result, std::string_view output);
}  // namespace stilb::cli
