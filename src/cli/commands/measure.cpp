// stilb measure: readings of all sensors of a scene.
#include "cli/commands/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <utility>

#include "cli/command_line.h"
#include "cli/commands/measure_flags.h"
#include "cli/commands/results_table.h"
#include "cli/commands/sweep.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/scene_argument.h"
#include "cli/state_file.h"
#include "estimators/estimator_list.h"
#include "io/import/rtrace.h"
#include "io/import/scene_formats.h"
#include "io/results/results_writer.h"
#include "io/scene/overrides.h"
#include "io/text/file_kind.h"
#include "io/text/table.h"
#include "io/text/text.h"
#include "plot/canvas.h"
#include "plot/false_colour_picture.h"
#include "run/run.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

struct MeasureRequest {
    std::string scene, points, from;
    std::optional<std::string> format, part;
    ReadingFiles files;
    SweepFlags sweep;
    StateFlags state;
    MeasureFlags flags;
};

/// In `stilb measure --json office.toml`, --json has taken the scene for its own value: gives it back.
void take_scene_back(MeasureRequest& request) {
    if (request.scene.empty() && request.files.json && !io::is_standard_output(*request.files.json))
        request.scene = std::exchange(*request.files.json, "-");
    if (!request.scene.empty()) return;
    throw InputError(
        "SCENE is missing. It gives the scene file (TOML), or - for standard input. See stilb measure "
        "--help.");
}

/// Throws InputError where there is no such format, or the flag contradicts others.
bool is_radiance_format(const MeasureRequest& request) {
    if (!request.format) return false;
    constexpr std::array<std::string_view, 1> formats{"radiance"};
    if (*request.format != formats[0]) {
        throw InputError(fmt::format("--format {}: there is no such format.{} Allowed: radiance.",
                                     *request.format, did_you_mean(*request.format, formats)));
    }
    if (std::ranges::any_of(request.files.json_files(), io::is_standard_output))
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

Measurement prepared(const MeasureRequest& request) {
    const MeasureFlags& flags = request.flags;
    const bool is_for_radiance = is_radiance_format(request);
    if (request.scene == "-" && request.points == "-")
        throw InputError("--points and the scene cannot both be read from standard input.");
    io::SceneFile file = read_scene(request.scene, flags.overrides, flags.run.show_progress());
    std::vector<Sensor> sensors = chosen_sensors(request, file);
    if (is_for_radiance) io::require_irradiances(sensors);
    RunOptions options = flags.options_for(sensors, file.run, request.scene);
    request.files.check(sensors, file.sources);
    return {std::move(file), std::move(sensors), std::move(options)};
}

/// Writes the files, and prints the table or what the request has in its place. Returns the exit code.
int show(RunResult result, const Measurement& measurement, const MeasureRequest& request, Outputs& outputs) {
    put_first(measurement.file.warnings, result);
    add_hashes(measurement.file, result);
    request.files.write(result, request.scene,
                        outputs);  // before all messages: the terminal may be closed by now
    if (!request.flags.run.quiet) print_warnings(result.warnings);
    if (request.format) {
        fmt::print("{}", io::to_irradiance_lines(result));
    } else if (std::ranges::none_of(request.files.json_files(), io::is_standard_output))
        fmt::print("{}", to_table(result) + shortfall_text(result, ""));
    return outputs.conclude(request.flags.exit_code_of(result, measurement.options));
}

/// Measures, or makes a part of the samples, with progress on the terminal.
template <typename Measure>
auto with_progress(const MeasureRequest& request, const RunOptions& options, StateFile& state_file,
                   const Measure& measure) {
    const RunFlags& flags = request.flags.run;
    TerminalProgress progress(std::string(estimators::find_estimator(options.method).samples),
                              flags.off_terminal());
    KeepingState keeping(flags.quiet ? nullptr : &progress, state_file);
    return state_file.keeping_state([&] { return measure(&keeping, &watch_for_interrupt()); });
}

int make_part(const MeasureRequest& request, const Measurement& measurement, StateFile& state_file,
              run::RunState& state) {
    const auto& [file, sensors, options] = measurement;
    const run::RunPart part = part_of(*request.part, request.state);
    const RunSummary summary =
        with_progress(request, options, state_file, [&](auto* progress, const auto* interrupt) {
            return run::measure_part(file.scene, sensors, options, part, state, progress, interrupt);
        });
    Outputs outputs;
    const bool is_written = outputs.write([&] { state_file.write(summary.stop_reason); });
    if (is_written && !request.flags.run.quiet) {
        fmt::print(
            "{}: part {} of the samples, {} in {:.1f} s. All parts give the result: stilb merge FILE FILE "
            "...\n",
            request.state.path, *request.part, state.samples(), summary.elapsed_s);
    }
    return outputs.conclude(summary.stop_reason == StopReason::paths_done ? kExitDone : kExitStoppedEarly);
}

int run_measure(const MeasureRequest& request, const CommandLine& line) {
    const Measurement measurement = prepared(request);
    const auto& [file, sensors, options] = measurement;
    StateFile state_file(request.state, "measure", line, file.sources, [&] {
        return io::traits_of(measurement.file, measurement.sensors, measurement.options);
    });
    run::RunState state;
    state_file.keep(std::string(io::kReadingSums), state);
    if (!state.more_seeds.empty()) {
        throw InputError(
            "the state is merged from runs of several seeds, and cannot go on. Make a run with another "
            "--seed, and "
            "merge it.",
            {request.state.path});
    }
    if (request.part) return make_part(request, measurement, state_file, state);
    const std::uint64_t samples_before = state.samples();
    RunResult result =
        with_progress(request, options, state_file, [&](auto* progress, const auto* interrupt) {
            return run::measure(file.scene, sensors, options, progress, interrupt, &state);
        });
    result.elapsed_s += state_file.elapsed_before_s();
    Outputs outputs;
    outputs.write([&] { state_file.write(result.stop_reason); });
    const bool has_more = result.samples > samples_before;
    const StopReason reason = result.stop_reason;
    const int exit_code = show(std::move(result), measurement, request, outputs);
    if (samples_before > 0 && !has_more)
        fmt::print(stderr, "{}: the run had ended before: {}. No samples were added.\n", request.state.path,
                   run::name_of(reason));
    return exit_code;
}

/// --csv names the file of the table.
int sweep(const MeasureRequest& request) {
    if (!request.files.json_files().empty() || !request.files.picture.empty() ||
        request.files.has_replicates || request.part || !request.state.path.empty() || request.format ||
        request.flags.checks)
        throw InputError(
            "--vary writes one table, with --csv FILE: it takes no --json, -o, --falsecolor, --replicates, "
            "--format, --check, --state or --part.");
    return run_sweep(request.sweep, request.files.csv_directory, request.flags.run.quiet,
                     [&](const std::vector<std::string>& overrides) {
                         MeasureRequest variant = request;
                         variant.files = {};
                         variant.flags.overrides.insert(variant.flags.overrides.end(), overrides.begin(),
                                                        overrides.end());
                         return prepared(variant);
                     });
}

}  // namespace

void ReadingFiles::add_to(Command& command) {
    command
        .add("--json", json, "One JSON document on stdout instead of the table, or beside it into this file")
        .optional_value("-")
        .value_name("[FILE]");
    command
        .add("-o,--output", output,
             "Write also the JSON document into this file, in one step; - is stdout, instead of the table")
        .value_name("FILE");
    command
        .add("--csv", csv_directory,
             "Write also a CSV file per sensor into this folder; with --vary: the table into this file")
        .value_name("DIR");
    command.add("--falsecolor", picture, "Write also a false-colour picture of grids and areas (.png, .svg)")
        .value_name("FILE");
    command.add("--replicates", has_replicates,
                "Write also the values of all replicates into the JSON document");
}

std::vector<std::string> ReadingFiles::json_files() const {
    std::vector<std::string> all;
    if (!output.empty()) all.push_back(output);
    if (json && *json != output) all.push_back(*json);
    return all;
}

void ReadingFiles::check(std::span<const Sensor> sensors,
                         std::span<const std::filesystem::path> inputs) const {
    if (has_replicates && json_files().empty())
        throw InputError("--replicates writes into the JSON document: give --json or -o as well.");
    for (const std::string& file : json_files()) io::require_output(file, io::FileKind::results, inputs);
    if (!picture.empty()) {
        plot::require_picture_path(picture, inputs);
        plot::require_grids(sensors);
    }
    if (!csv_directory.empty()) io::prepare_results_csv(sensors, csv_directory);
}

void ReadingFiles::write(const RunResult& result, const std::string& scene, Outputs& outputs) const {
    const auto replicates = has_replicates ? io::ReplicateValues::written : io::ReplicateValues::left_out;
    for (const std::string& file : json_files())
        outputs.write([&] { io::replace_file(file, io::json_parts(result, scene, replicates)); });
    if (!csv_directory.empty()) outputs.write([&] { io::write_results_csv(result, csv_directory); });
    if (picture.empty()) return;
    plot::FalseColourOptions options;
    options.isolines = true;
    outputs.write([&] { draw_false_colour(plot::picture_of(result, scene, options), options, picture); });
}

namespace {

/// Adds the command with its flags.
Command declare(CommandLine& line, MeasureRequest& request) {
    Command command = line.add_command(
        "measure", "Measure illuminance and luminance at all sensors of a scene, with error bars");
    command.set_examples(
        "  stilb measure office.toml\n"
        "  stilb measure office.toml --error 0.5% --sensor desk\n"
        "  stilb measure office.toml -o office.json\n"
        "  stilb measure office.toml --csv results --falsecolor office.png\n"
        "  stilb measure office.toml --check --time 60\n"
        "  stilb measure room.rad --points grid.pts --format radiance\n");
    command.add("SCENE", request.scene,
                "Scene (TOML, glTF, OBJ, Radiance), or - for standard input (required)");
    request.files.add_to(command);
    command
        .add("--points", request.points,
             "Measure the illuminance at the points of this file instead of the scene's sensors: lines "
             "\"x y z nx ny nz\", as rtrace takes them; - is standard input")
        .value_name("FILE");
    command
        .add("--format", request.format,
             "radiance: print irradiances [W/m2] instead of the table, a line \"R G B\" for each point, as "
             "rtrace -I -h does (docs/radiance.md)")
        .value_name("NAME");
    add_part(command, request.part);
    request.sweep.add_to(command);
    request.state.add_to(command);
    command
        .add("--from", request.from,
             "Show the readings of this state file, without more samples; the scene is that of its run")
        .value_name("FILE");
    request.flags.add_to(command);
    return command;
}

/// Reads the request that a run was begun with. It refers to the line.
void read_request(const io::RunOrigin& origin, const std::string& file, CommandLine& line,
                  MeasureRequest& request) {
    declare(line, request).run([] { return kExitDone; });
    read_arguments(origin, line);
    take_scene_back(request);
    request.scene = path_from(request.scene, origin, file);
    request.points = path_from(request.points, origin, file);
}

/// Throws InputError where other flags than those of the files are given with --from.
int show_from(const MeasureRequest& request) {
    if (!request.scene.empty() || !request.state.path.empty() || request.part)
        throw InputError("--from shows the sums of a state file: it takes no scene, --state or --part.");
    if (const std::vector<std::string> given = request.flags.run.given(); !given.empty()) {
        throw InputError(fmt::format(
            "{} has no effect with --from, which adds no samples. Go on with the run: stilb resume {}.",
            given.front(), request.from));
    }
    if (!request.flags.sensors.empty() || request.flags.grid || !request.points.empty() || request.format ||
        !request.sweep.vary.empty())
        throw InputError(
            "--from shows the readings of its run as they are: it takes no --sensor, --grid, --points, "
            "--format "
            "or --vary.");
    std::vector<std::string> overrides = request.flags.overrides;
    ShowFlags flags{request.files, request.flags.checks, request.flags.run.quiet, {}};
    flags.dimmed.name = "dimmed";
    flags.dimmed.factors = io::take_light_factors(overrides);
    if (!overrides.empty()) {
        throw InputError(
            fmt::format("--set {}: with --from, --set takes factors of lights and groups, such as "
                        "panel=0.4: all else is that of the run.",
                        overrides.front()));
    }
    return show_stored(io::read_run_file(request.from), request.from, flags);
}

}  // namespace

int show_stored(const io::StoredRun& stored, const std::string& name, const ShowFlags& flags) {
    if (stored.origin.command != "measure") {
        throw InputError(
            fmt::format("this is the state of `stilb {}`, not of `stilb measure`.", stored.origin.command),
            {name});
    }
    CommandLine line;
    MeasureRequest request;
    read_request(stored.origin, name, line, request);
    request.files = flags.files;
    request.flags.checks = flags.checks;
    request.flags.run.quiet = flags.quiet;
    const Measurement measurement = prepared(request);
    const auto& [file, sensors, options] = measurement;
    require_same_run(stored.origin, io::traits_of(file, sensors, options), name);
    auto state = io::read_sums<run::RunState>(stored, io::kReadingSums, name);
    RunResult result = run::result_of(file.scene, sensors, options, state,
                                      flags.dimmed.factors.empty() ? nullptr : &flags.dimmed, nullptr,
                                      &watch_for_interrupt());
    io::set_ending(stored.origin, result);
    Outputs outputs;
    return show(std::move(result), measurement, request, outputs);
}

void add_measure(CommandLine& line) {
    auto request = std::make_shared<MeasureRequest>();
    declare(line, *request).run([request, &line] {
        if (!request->from.empty()) return show_from(*request);
        take_scene_back(*request);
        return request->sweep.vary.empty() ? run_measure(*request, line) : sweep(*request);
    });
}

}  // namespace stilb::cli
