// The report of a lighting calculation: one page of HTML that needs nothing else, and prints on A4.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/warning.h"
#include "io/scene/scene_file.h"
#include "run/options.h"
#include "run/result.h"
#include "scene/whites.h"

namespace stilb::report {

/// The picture of a camera.
struct View {
    std::string sensor;
    int width = 0, height = 0;
    double exposure = 0, white_k = 0;
    std::string png;
    double mean_luminance_cd_m2 = 0, mean_standard_error_cd_m2 = 0;
    RunSummary run;
};
/// As `stilb render` makes a .png, with automatic exposure.
View make_view(const RenderResult& result, const Sensor& camera, const Scene& scene,
               const scene::WhiteRange& whites);

struct Report {
    const io::SceneFile& file;
    std::string scene;    ///< the scene file as the user named it
    std::string command;  ///< the command line
    std::string date;
    RunOptions options;  ///< of the readings
    std::optional<RunResult> readings;
    std::vector<View> views;
    std::vector<Warning> warnings;  ///< of the file and of all runs
    bool lists_readings = false;    ///< all of them, at the end
};

/// The same report gives the same page. What differs between runs with the same seed and the same number of
/// samples, as durations do, is in elements <time>.
std::string to_html(const Report& report);

}  // namespace stilb::report
