// Points and results in the form of Radiance's program rtrace, with the options -I -h.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "run/result.h"
#include "sensors/sensor.h"

namespace stilb::io {

inline constexpr std::string_view kPointsSensor = "points";

/// An illuminance sensor of this name from lines "x y z nx ny nz"; "-" is standard input. Normals may have
/// any length above 0. Empty lines, and comments after "#", are left out. Throws InputError with file and
/// line.
Sensor read_points(const std::filesystem::path& path);
/// The reader for content in memory; `name` is used in messages.
Sensor read_points(std::string_view content, const std::string& name);

/// Throws InputError where a sensor does not measure the illuminance at points, which rtrace does.
void require_irradiances(const std::vector<Sensor>& sensors);
/// A line "R G B" for each reading, irradiances in W/m2: io/text/radiance_units.h.
std::string to_irradiance_lines(const RunResult& result);

}  // namespace stilb::io
