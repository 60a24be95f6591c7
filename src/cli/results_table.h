// Results as text for people.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "estimators/patch_light/patch_options.h"
#include "run/result.h"
#include "sensors/measurand.h"

namespace stilb::cli {

/// A table with every sensor's summary, small grids' values, and how the run ended.
std::string to_table(const RunResult& result);

/// A value with its interval's half-width, both with the digits that the interval leaves: "498.2 +- 1.1".
std::string with_error(const statistics::Estimate& estimate);

// Places and directions in words.

std::string place_text(const Vec3& position);
std::string direction_text(const Vec3& direction);

/// Where a reading is made and which way it looks: "at ... facing ...".
std::string place_text(const Place& place);
/// "theta 30°  phi 0°"; empty where a place has no angles.
std::string angles_text(const Place& place);

// Which objects were given fewer harmonics than they have, as text for people.

/// A line for each.
std::string detail_text(std::span<const run::LevelOfDetail> levels);

// How a run ended, for people.

/// `all`: what was done where a number of it was asked for, such as "passes".
std::string ending(StopReason reason, std::string_view all);

// What became of surfaces and lights where patches stand for them, as text for people.

/// A line on patches and first shot, and one on the lights that are not replaced, if there are any.
std::string patch_text(const estimators::PatchReport& report);

}  // namespace stilb::cli
