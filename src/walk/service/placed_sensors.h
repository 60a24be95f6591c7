// Sensors that were placed in the page: as text for a scene file, and as a file beside it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sensors/sensor.h"

namespace stilb::walk {

/// {"sensors": [{"name", "type": "illuminance", "position", "normal"}, {"name", "type": "luminance",
/// "position", "direction"}]}. Names that are taken, by one another or by `present`, get a number. Throws
/// InputError with a sentence that the page can show.
std::vector<Sensor> read_placed_sensors(std::string_view json, const std::vector<Sensor>& present);

/// The sections [sensors.NAME] of a scene file; micrometres are rounded.
std::string to_toml(const std::vector<Sensor>& sensors);

/// Writes the text into a new file beside the scene: SCENE-sensors.toml, or SCENE-sensors-2.toml ..., never
/// over another file. Returns its path; nothing where no file can be written there, or where the scene comes
/// from standard input.
std::optional<std::filesystem::path> save_beside(const std::filesystem::path& scene, std::string_view text);

/// The answer to a request: {"toml": "...", "saved": "room-sensors.toml"}. `present`: the sensors of the
/// scene file `scene`. Throws as read_placed_sensors(), and InputError where no file can be written.
std::string keep_placed_sensors(std::string_view json, const std::vector<Sensor>& present,
                                const std::filesystem::path& scene);

}  // namespace stilb::walk
