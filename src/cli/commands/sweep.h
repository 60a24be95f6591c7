// Variants of a scene in one command: measure --vary KEY=VALUE,VALUE.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/commands/measure.h"
#include "io/scene/scene_file.h"

namespace stilb::cli {

/// What a measurement begins with.
struct Measurement {
    io::SceneFile file;
    std::vector<Sensor> sensors;
    RunOptions options;
};

struct SweepFlags {
    std::vector<std::string> vary;
    bool zips = false;

    void add_to(Command& command);
};

/// Measures all variants, and writes a table of their values, with the differences from the first variant: as
/// CSV into the file `csv`, or on stdout where it is empty. `prepare`: the measurement with these overrides.
/// Returns the exit code.
int run_sweep(const SweepFlags& flags, const std::string& csv, bool quiet,
              const std::function<Measurement(const std::vector<std::string>& overrides)>& prepare);

}  // namespace stilb::cli
