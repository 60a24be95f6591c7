// stilb measure: readings of all sensors of a scene.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>

#include "cli/command_line.h"
#include "cli/progress.h"
#include "cli/results_table.h"
#include "cli/run_flags.h"
#include "cli/scene_argument.h"
#include "estimators/estimator_list.h"
#include "io/results/results_writer.h"
#include "io/text/file_kind.h"
#include "io/text/table.h"
#include "plot/canvas.h"
#include "plot/false_colour_picture.h"
#include "run/run.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

struct MeasureRequest {
    std::string scene;
    std::vector<std::string> sensors;
    bool json = false;
    std::string output, csv_directory, picture;
    RunFlags flags;
};

/// Seconds a reading that statistics and files take after the last sample. Two threads were measured.
constexpr double kFinishing_s = 3e-6;

/// Writes the files that the request names.
void write_files(const RunResult& result, const MeasureRequest& request) {
    if (!request.output.empty()) io::replace_file(request.output, io::to_json(result, request.scene));
    if (!request.csv_directory.empty()) io::write_results_csv(result, request.csv_directory);
    if (!request.picture.empty()) {
        plot::FalseColourOptions options;
        options.isolines = true;
        draw_false_colour(plot::picture_of(result, request.scene), options, request.picture);
    }
}

int run_measure(const MeasureRequest& request) {
    const io::SceneFile file = read_scene(request.scene);
    const std::vector<Sensor> sensors = sensors::choose_meters(file.sensors, request.sensors, request.scene);
    std::size_t readings = 0;
    for (const Sensor& sensor : sensors) readings += sensor.size();
    const RunOptions options =
        with_reserve(request.flags.over(file.run), kFinishing_s * static_cast<double>(readings));
    if (!request.output.empty()) io::require_output(request.output, io::FileKind::results, file.sources);
    if (!request.picture.empty()) plot::require_picture_path(request.picture, file.sources);
    if (!request.csv_directory.empty()) io::prepare_results_csv(sensors, request.csv_directory);
    RunResult result;
    {
        TerminalProgress progress(std::string(estimators::find_estimator(options.method).samples));
        result = run::measure(file.scene, sensors, options, request.flags.quiet ? nullptr : &progress,
                              &watch_for_interrupt());
    }
    add_warnings(result, file.warnings);
    write_files(result, request);  // before all messages: the terminal may be closed by now
    if (!request.flags.quiet) print_warnings(result.warnings);
    fmt::print("{}", request.json ? io::to_json(result, request.scene)
                                  : to_table(result) + shortfall_text(result, ""));
    return result.converged ? kExitDone : kExitStoppedEarly;
}

}  // namespace

void add_measure(CommandLine& line) {
    Command command = line.add_command(
        "measure", "Measure illuminance and luminance at all sensors of a scene, with error bars");
    command.set_examples(
        "  stilb measure office.toml\n"
        "  stilb measure office.toml --error 0.5% --sensor desk\n"
        "  stilb measure office.toml -o office.json\n"
        "  stilb measure office.toml --csv results --falsecolor office.png\n");
    auto request = std::make_shared<MeasureRequest>();
    command.add("SCENE", request->scene, "Scene file (TOML), or - for standard input").required();
    command.add("--sensor", request->sensors, "Measure only this sensor (may be repeated)")
        .value_name("NAME")
        .repeatable();
    command.add("--json", request->json, "One JSON document on stdout instead of the table");
    command.add("-o,--output", request->output, "Write also the JSON document into this file")
        .value_name("FILE");
    command.add("--csv", request->csv_directory, "Write also a CSV file per sensor into this folder")
        .value_name("DIR");
    command
        .add("--falsecolor", request->picture, "Write also a false-colour picture of the grids (.png, .svg)")
        .value_name("FILE");
    request->flags.add_to(command);
    command.run([request] { return run_measure(*request); });
}

}  // namespace stilb::cli
