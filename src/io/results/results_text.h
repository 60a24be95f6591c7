// Results as text, for the table of `stilb measure` and for reports.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "estimators/patch_light/patch_options.h"
#include "run/result.h"
#include "sensors/sensor.h"

namespace stilb::io {

// Values as text.

/// "498.2 +- 1.1": a value with the half-width of its interval, both with the digits that the interval
/// leaves.
std::string with_error(const statistics::Estimate& estimate);
/// A number with so many decimals; never "-0".
std::string fixed(double value, int decimals);
/// "lx", "cd/m²"; empty for a ratio or a rating.
std::string unit_of(const Sensor& sensor);
/// With the unit after a space, if there is one.
std::string with_unit(const statistics::Estimate& estimate, const Sensor& sensor);
/// "0.65 %": a share with two digits, or all of those before the point.
std::string percent(double share);
/// "mean at least 500 lx".
std::string requirement_text(const Requirement& requirement, const Sensor& sensor);
/// The number of requirements with each verdict: "2 pass, 1 not sure yet"; empty where there are none.
std::string verdicts_text(const RunResult& result);

// Positions and directions as text.

std::string location_text(const Vec3& position);
std::string direction_text(const Vec3& direction);
/// Position and direction of a reading: "at ... facing ...".
std::string location_text(const Location& location);
/// "theta 30°  phi 0°"; empty where a location has no angles.
std::string angles_text(const Location& location);
/// ", meets (2, 3, 1.2)": the end of line of sight `j`; empty where it is not known.
std::string line_end_text(const SensorResult& result, std::size_t j);
/// "16 x 8 grid", "63 points 0.689 m x 0.714 m apart", "2 views".
std::string size_text(const Sensor& sensor);
/// " (3 hidden ones left out)": points of an area that are not measured; empty for none.
std::string left_out_text(std::size_t points);

// The run as text.

/// `all`: what is complete where a number was requested, such as "passes".
std::string ending(StopReason reason, std::string_view all);

/// "path", or "auto (light-paths)" where the method has chosen a technique.
std::string method_text(const RunSummary& run);
/// "maintenance factor 0.8", or "maintenance factors 0.7 to 0.8", where lamps have different ones.
std::string maintenance_text(const std::array<double, 2>& factors);
/// "243 W, without lamps of unknown power: spot, globe", or that it is not known.
std::string power_text(std::optional<double> installed_w, std::span<const std::string> unknown);
/// "; 7.2 W/m² of the floor (20 m²)", or of the floors of several rooms; empty where there are none.
std::string room_power_text(std::span<const run::RoomPower> rooms);
/// The power with the densities of the rooms and of the task areas; empty where nothing is known and nothing
/// asks for it.
std::string installed_power_text(const RunResult& result);
/// One line for each object by harmonics whose series was truncated.
std::string detail_text(std::span<const run::LevelOfDetail> levels);
/// A line on patches and first shot, and one on the lights that are not replaced, if there are any.
std::string patch_text(const estimators::PatchReport& report);

}  // namespace stilb::io
