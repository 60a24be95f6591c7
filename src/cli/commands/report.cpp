// stilb report: the results of a scene as a page to hand on.
#include "report/report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <list>
#include <memory>
#include <optional>
#include <utility>

#include "cli/browser.h"
#include "cli/command_line.h"
#include "cli/commands/measure.h"
#include "cli/commands/measure_flags.h"
#include "cli/commands/results_table.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/scene_argument.h"
#include "cli/state_file.h"
#include "estimators/estimator_list.h"
#include "io/text/file_kind.h"
#include "io/text/table.h"
#include "run/pictures/picture_sums.h"
#include "run/run.h"
#include "scene/whites.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

constexpr double kUsualViewTime_s = 60;

struct ReportRequest {
    std::string scene, output, command;
    std::vector<std::string> views;
    std::optional<double> view_time_s;
    std::optional<std::uint64_t> view_passes;
    bool lists_readings = false;
    StateFlags state;
    MeasureFlags flags;
};

struct ChosenSensors {
    std::vector<Sensor> meters, cameras;
};

/// The sensors of these names, or all.
ChosenSensors choose_sensors(const std::vector<Sensor>& all, const std::vector<std::string>& names,
                             const std::string& scene) {
    ChosenSensors chosen;
    const auto is_named = [&](const Sensor& sensor) {
        return names.empty() || std::ranges::find(names, sensor.name) != names.end();
    };
    std::vector<std::string> meters = names;
    for (const Sensor& sensor : all) {
        if (!sensor.camera() || !is_named(sensor)) continue;
        chosen.cameras.push_back(sensor);
        std::erase(meters, sensor.name);
    }
    const bool has_meters = std::ranges::any_of(all, [](const Sensor& s) { return !s.camera(); });
    if (names.empty() ? has_meters : !meters.empty())
        chosen.meters = sensors::choose_meters(all, meters, scene);
    if (chosen.meters.empty() && chosen.cameras.empty())
        throw InputError("there is nothing to report: the scene needs a sensor under [sensors].", {scene});
    return chosen;
}

void require_page(const std::string& output, std::span<const std::filesystem::path> inputs) {
    if (!io::is_standard_output(output) && !is_page(output)) {
        throw InputError(fmt::format(
            "-o {}: a report is a page. End the name in .html; a browser prints the page as PDF.", output));
    }
    io::require_output(output, io::FileKind::report, inputs);
}

/// Those of the readings, with the limits of pictures.
RunOptions view_options(const ReportRequest& request, const RunOptions& of_readings, const Camera& camera) {
    RunOptions options = of_readings;
    options.error.reset();
    options.by = "none";  // the views have no layers
    options.paths = request.view_passes;
    options.time_s = request.view_time_s;
    if (!options.paths && !options.time_s) options.time_s = kUsualViewTime_s;
    return with_picture_reserve(std::move(options), camera.resolution);
}

void add_new(std::span<const Warning> more, std::vector<Warning>& warnings) {
    for (const Warning& warning : more) {
        if (std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(warning);
    }
}

class Reporting {
  public:
    Reporting(const ReportRequest& request, const io::SceneFile& file, const RunOptions& options,
              StateFile& state_file)
        : request_(request), state_file_(state_file), report_{file, request.scene, request.command,
                                                              {},   options,       {},
                                                              {},   file.warnings, request.lists_readings} {}

    void measure(const std::vector<Sensor>& meters) {
        const std::string_view samples = estimators::find_estimator(report_.options.method).samples;
        TerminalProgress progress(std::string(samples), request_.flags.run.off_terminal());
        KeepingState keeping(shown(progress), state_file_);
        state_file_.keep(std::string(io::kReadingSums), readings_);
        report_.readings = state_file_.keeping_state([&] {
            return run::measure(report_.file.scene, meters, report_.options, &keeping, &watch_for_interrupt(),
                                &readings_);
        });
        add_new(report_.readings->warnings, report_.warnings);
    }

    /// Where there is no time for a picture, the report does without it.
    void render(const Sensor& camera) {
        const Scene& scene = report_.file.scene;
        TerminalProgress progress("passes", request_.flags.run.off_terminal());
        KeepingState keeping(shown(progress), state_file_);
        run::PictureSums& sums = pictures_.emplace_back();
        state_file_.keep(io::sums_of_picture(camera), sums);
        try {
            const RenderResult result =
                run::render(scene, camera, view_options(request_, report_.options, *camera.camera()),
                            &keeping, &watch_for_interrupt(), &sums);
            report_.views.push_back(report::make_view(result, camera, scene, whites_of_lights(scene)));
            add_new(result.warnings, report_.warnings);
        } catch (const Cancelled& cancelled) {
            lacks_views_ = true;
            report_.warnings.emplace_back(
                WarningKind::missing_view,
                fmt::format("camera \"{}\": no picture: {}", camera.name, cancelled.what()));
        }
    }

    report::Report& report() { return report_; }
    /// Of the readings, or of pictures alone.
    StopReason stop_reason() const {
        if (lacks_views_) return StopReason::interrupted;
        return report_.readings ? report_.readings->stop_reason : StopReason::paths_done;
    }
    int exit_code() const {
        const int of_readings =
            report_.readings ? request_.flags.exit_code_of(*report_.readings, report_.options) : kExitDone;
        return of_readings == kExitDone && lacks_views_ ? kExitStoppedEarly : of_readings;
    }

  private:
    PictureSink* shown(TerminalProgress& progress) const {
        return request_.flags.run.quiet ? nullptr : &progress;
    }

    const ReportRequest& request_;
    StateFile& state_file_;
    report::Report report_;
    run::RunState readings_;
    std::list<run::PictureSums> pictures_;
    bool lacks_views_ = false;
};

/// `bytes`: of the page, where it could be written.
void print_summary(const report::Report& report, const std::string& output,
                   std::optional<std::size_t> bytes) {
    std::FILE* const stream = messages_beside(output);
    if (report.readings) {
        fmt::print(stream, "{}{}", end_of_table(*report.readings), shortfall_text(*report.readings, output));
    }
    if (bytes) {
        fmt::print(stream, "{}: {:.1f} MB, opens in any browser and prints on A4\n", output,
                   1e-6 * static_cast<double>(*bytes));
    }
}

int run_report(const ReportRequest& request, const CommandLine& line) {
    io::SceneFile file =
        read_scene(request.scene, request.flags.overrides, request.views, request.flags.run.show_progress());
    std::vector<std::string> planes;
    request.flags.add_planes(file, request.scene, planes);
    const auto [meters, cameras] = choose_sensors(file.sensors, request.flags.sensors, request.scene);
    const RunOptions options = request.flags.options_for(meters, file.run, request.scene);
    require_page(request.output, file.sources);
    std::vector<Sensor> sensors = meters;
    sensors.insert(sensors.end(), cameras.begin(), cameras.end());
    StateFile state_file(request.state, "report", line, file.sources,
                         [&] { return io::traits_of(file, sensors, options); });
    Reporting reporting(request, file, options, state_file);
    if (!meters.empty()) reporting.measure(meters);
    for (const Sensor& camera : cameras) reporting.render(camera);
    report::Report& report = reporting.report();
    report.date = fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr)));
    const std::string page = to_html(report);
    Outputs outputs;  // before all messages: the terminal may be closed by now
    outputs.write([&] { state_file.write(reporting.stop_reason()); });
    const bool is_written = outputs.write([&] { io::replace_file(request.output, page); });
    if (!request.flags.run.quiet) print_warnings(report.warnings);
    print_summary(report, request.output, is_written ? std::optional(page.size()) : std::nullopt);
    return outputs.conclude(reporting.exit_code());
}

}  // namespace

void add_report(CommandLine& line) {
    Command command = line.add_command(
        "report", "Write a report of a scene for clients: plan, results, glare, luminaires, views");
    command.set_examples(
        "  stilb report office.toml -o office.html\n"
        "  stilb report office.toml -o office.html --error 0.5% --time 120 --view-time 60\n"
        "  stilb report office.toml -o desks.html --sensor desk_a --sensor desk_b --check --readings\n");
    auto request = std::make_shared<ReportRequest>();
    command.add("SCENE", request->scene, "Scene (TOML, glTF, OBJ, Radiance), or - for standard input")
        .required();
    command.add("-o,--output", request->output, "Page to write (.html); - is stdout")
        .required()
        .value_name("FILE");
    command
        .add("--view-time", request->view_time_s,
             fmt::format("Render each camera for so many seconds (default: {:g})", kUsualViewTime_s))
        .above_zero()
        .value_name("S");
    command
        .add("--view-passes", request->view_passes,
             "Render each camera with so many passes, at least 2; the picture then does not depend on the "
             "time")
        .from_to(2, 1'000'000)
        .value_name("N");
    command.add("--readings", request->lists_readings, "Also list all readings, with their intervals");
    add_views(command, request->views);
    request->state.add_to(command);
    request->flags.add_to(command);
    command.find("--sensor").description("Report only this sensor or camera (may be repeated)");
    command.run([request, &line] {
        request->command = line.text();
        return run_report(*request, line);
    });
}

}  // namespace stilb::cli
