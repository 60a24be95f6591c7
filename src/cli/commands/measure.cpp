// stilb measure: readings of all sensors of a scene.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <utility>

#include "cli/command_line.h"
#include "cli/commands/measure_flags.h"
#include "cli/commands/results_table.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/scene_argument.h"
#include "estimators/estimator_list.h"
#include "io/import/rtrace.h"
#include "io/import/scene_formats.h"
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
    /// Where JSON goes: "-" is standard output, which then gets no table.
    std::optional<std::string> json;
    std::string output, csv_directory, picture, points;
    std::optional<std::string> format;
    bool has_replicates = false;
    MeasureFlags flags;
};

/// In `stilb measure --json office.toml`, --json has taken the scene for its own value: gives it back.
void take_scene_back(MeasureRequest& request) {
    if (request.scene.empty() && request.json && !io::is_standard_output(*request.json))
        request.scene = std::exchange(*request.json, "-");
    if (!request.scene.empty()) return;
    throw InputError(
        "SCENE is missing. It gives the scene file (TOML), or - for standard input. See stilb measure "
        "--help.");
}

/// Where the JSON document is written, "-" for standard output.
std::vector<std::string> json_files(const MeasureRequest& request) {
    std::vector<std::string> files;
    if (!request.output.empty()) files.push_back(request.output);
    if (request.json && *request.json != request.output) files.push_back(*request.json);
    return files;
}

/// Writes the files that the request names.
void write_files(const RunResult& result, const MeasureRequest& request, Outputs& outputs) {
    const auto replicates =
        request.has_replicates ? io::ReplicateValues::written : io::ReplicateValues::left_out;
    for (const std::string& file : json_files(request))
        outputs.write([&] { io::replace_file(file, io::json_parts(result, request.scene, replicates)); });
    if (!request.csv_directory.empty())
        outputs.write([&] { io::write_results_csv(result, request.csv_directory); });
    if (!request.picture.empty()) {
        plot::FalseColourOptions options;
        options.isolines = true;
        outputs.write([&] {
            draw_false_colour(plot::picture_of(result, request.scene, options), options, request.picture);
        });
    }
}

/// Throws InputError where there is no such format, or the flag contradicts others.
bool is_radiance_format(const MeasureRequest& request) {
    if (!request.format) return false;
    constexpr std::array<std::string_view, 1> formats{"radiance"};
    if (*request.format != formats[0]) {
        throw InputError(fmt::format("--format {}: there is no such format.{} Allowed: radiance.",
                                     *request.format, did_you_mean(*request.format, formats)));
    }
    if (std::ranges::any_of(json_files(request), io::is_standard_output))
        throw InputError("--format radiance: standard output is for the JSON document already.");
    return true;
}

/// Adds the points of --points to the sensors of the scene.
void add_points(const MeasureRequest& request, io::SceneFile& file, std::vector<std::string>& names) {
    if (request.points.empty()) return;
    if (sensors::find_sensor(file.sensors, io::kPointsSensor)) {
        throw InputError("--points: the scene has a sensor \"points\" already. Give that another name.",
                         {request.scene});
    }
    file.sensors.push_back(io::read_points(request.points));
    names.emplace_back(io::kPointsSensor);
    const geometry::Transform placement = io::placement_beside(request.scene, request.flags.overrides);
    if (placement == geometry::Transform{}) return;
    auto& points = std::get<IlluminancePoints>(file.sensors.back().kind).points;
    for (auto& [position, normal] : points) {
        position = placement.point(position);
        normal = normalized(placement.direction(normal));
    }
}

/// The sensors that are measured. Those of --points and --grid are more sensors of the scene, and the only
/// ones where none is chosen.
std::vector<Sensor> chosen_sensors(const MeasureRequest& request, io::SceneFile& file) {
    std::vector<std::string> added;
    add_points(request, file, added);
    request.flags.add_planes(file, request.scene, added);
    const std::vector<std::string>& names = request.flags.sensors;
    return sensors::choose_meters(file.sensors, names.empty() ? added : names, request.scene);
}

int run_measure(const MeasureRequest& request) {
    const MeasureFlags& flags = request.flags;
    if (request.has_replicates && json_files(request).empty())
        throw InputError("--replicates writes into the JSON document: give --json or -o as well.");
    const bool is_for_radiance = is_radiance_format(request);
    if (request.scene == "-" && request.points == "-")
        throw InputError("--points and the scene cannot both be read from standard input.");
    io::SceneFile file = read_scene(request.scene, flags.overrides, flags.run.show_progress());
    const std::vector<Sensor> sensors = chosen_sensors(request, file);
    if (is_for_radiance) io::require_irradiances(sensors);
    const RunOptions options = flags.options_for(sensors, file.run, request.scene);
    for (const std::string& output : json_files(request))
        io::require_output(output, io::FileKind::results, file.sources);
    if (!request.picture.empty()) {
        plot::require_picture_path(request.picture, file.sources);
        plot::require_grids(sensors);
    }
    if (!request.csv_directory.empty()) io::prepare_results_csv(sensors, request.csv_directory);
    RunResult result;
    {
        TerminalProgress progress(std::string(estimators::find_estimator(options.method).samples),
                                  flags.run.off_terminal());
        result = run::measure(file.scene, sensors, options, flags.run.quiet ? nullptr : &progress,
                              &watch_for_interrupt());
    }
    put_first(file.warnings, result);
    Outputs outputs;
    write_files(result, request, outputs);  // before all messages: the terminal may be closed by now
    if (!flags.run.quiet) print_warnings(result.warnings);
    if (is_for_radiance) {
        fmt::print("{}", io::to_irradiance_lines(result));
    } else if (std::ranges::none_of(json_files(request), io::is_standard_output))
        fmt::print("{}", to_table(result) + shortfall_text(result, ""));
    return outputs.conclude(flags.exit_code_of(result));
}

}  // namespace

void add_measure(CommandLine& line) {
    Command command = line.add_command(
        "measure", "Measure illuminance and luminance at all sensors of a scene, with error bars");
    command.set_examples(
        "  stilb measure office.toml\n"
        "  stilb measure office.toml --error 0.5% --sensor desk\n"
        "  stilb measure office.toml -o office.json\n"
        "  stilb measure office.toml --csv results --falsecolor office.png\n"
        "  stilb measure office.toml --check --time 60\n"
        "  stilb measure room.rad --points grid.pts --format radiance\n");
    auto request = std::make_shared<MeasureRequest>();
    command.add("SCENE", request->scene,
                "Scene (TOML, glTF, OBJ, Radiance), or - for standard input (required)");
    command
        .add("--json", request->json,
             "One JSON document on stdout instead of the table, or beside it into this file")
        .optional_value("-")
        .value_name("[FILE]");
    command
        .add("-o,--output", request->output,
             "Write also the JSON document into this file, in one step; - is stdout, instead of the table")
        .value_name("FILE");
    command.add("--csv", request->csv_directory, "Write also a CSV file per sensor into this folder")
        .value_name("DIR");
    command
        .add("--falsecolor", request->picture,
             "Write also a false-colour picture of grids and areas (.png, .svg)")
        .value_name("FILE");
    command.add("--replicates", request->has_replicates,
                "Write also the values of all replicates into the JSON document");
    command
        .add("--points", request->points,
             "Measure the illuminance at the points of this file instead of the scene's sensors: lines "
             "\"x y z nx ny nz\", as rtrace takes them; - is standard input")
        .value_name("FILE");
    command
        .add("--format", request->format,
             "radiance: print irradiances [W/m2] instead of the table, a line \"R G B\" for each point, as "
             "rtrace -I -h does (docs/radiance.md)")
        .value_name("NAME");
    request->flags.add_to(command);
    command.run([request] {
        take_scene_back(*request);
        return run_measure(*request);
    });
}

}  // namespace stilb::cli
