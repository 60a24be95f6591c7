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

/// "498.2 +- 1.1": a value with the half-width of its interval, both with the digits that the interval
/// leaves.
std::string with_error(const statistics::Estimate& estimate);

// Positions and directions as text.

std::string location_text(const Vec3& position);
std::string direction_text(const Vec3& direction);

/// Position and direction of a reading: "at ... facing ...".
std::string location_text(const Location& location);
/// "theta 30°  phi 0°"; empty where a location has no angles.
std::string angles_text(const Location& location);

/// " (3 hidden ones left out)": points of an area that are not measured; empty for none.
std::string left_out_text(std::size_t points);

// The objects by harmonics whose series were truncated, as text.

/// One line per object.
std::string detail_text(std::span<const run::LevelOfDetail> levels);

// Maintenance factors as text.

/// "maintenance factor 0.8", or "maintenance factors 0.7 to 0.8", where lamps have different ones.
std::string maintenance_text(const std::array<double, 2>& factors);
/// A line that says so; empty where no lamp has one below 1.
/// "243 W, without 2 lamps of unknown power (spot, globe)", or "not known".
std::string power_text(std::optional<double> installed_w, std::span<const std::string> unknown);
std::string maintenance_line(const RunSummary& result);

// The end of a run as text.

/// `all`: what is complete where a number was requested, such as "passes".
std::string ending(StopReason reason, std::string_view all);
/// Where the run ended before its goal: a line that says so, and that `output`, the file, has the result so
/// far. Empty otherwise. `output` may be empty.
std::string shortfall_text(const RunSummary& result, std::string_view output);
/// "0.65 %": a share with two digits, or all of those before the point.
std::string percent(double share);

// Patches and first shot as text.

/// A line on patches and first shot, and one on the lights that are not replaced, if there are any.
std::string patch_text(const estimators::PatchReport& report);

}  // namespace stilb::cli
