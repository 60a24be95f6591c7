// The flags of the commands that measure sensors: `measure` and `report`.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/run_flags.h"
#include "io/scene/scene_file.h"
#include "run/result.h"
#include "sensors/sensor.h"

namespace stilb::cli {

struct MeasureFlags {
    std::vector<std::string> overrides, sensors;
    std::optional<std::string> grid;
    bool checks = false;
    RunFlags run;

    void add_to(Command& command);
    /// Adds the working planes of --grid to the sensors of the file at `path`, and their names to `added`.
    void add_planes(io::SceneFile& file, const std::string& path, std::vector<std::string>& added) const;
    /// The options with the typed flags applied, for these sensors. `scene`: the name of its file. Throws
    /// InputError where --check has nothing to act on.
    RunOptions options_for(std::span<const Sensor> measured, const RunOptions& of_file,
                           const std::string& scene) const;
    /// With --check, requirements decide: those with the lamps as they are, and in light scenes that name
    /// their sensors.
    int exit_code_of(const RunResult& result, const RunOptions& options) const;
};

}  // namespace stilb::cli
