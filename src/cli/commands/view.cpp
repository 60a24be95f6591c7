// stilb view: a walk through a lit scene in the browser, while its light is computed.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "cli/browser.h"
#include "cli/command_line.h"
#include "cli/commands/results_table.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/run_flags.h"
#include "cli/scene_argument.h"
#include "io/results/results_text.h"
#include "io/results/solution_file.h"
#include "io/text/compression.h"
#include "io/text/file_kind.h"
#include "io/text/table.h"
#include "io/text/text.h"
#include "rays/ray_caster.h"
#include "run/solve.h"
#include "sensors/first_look.h"
#include "stilb/error.h"
#include "walk/live_walk.h"
#include "walk/service/placed_sensors.h"
#include "walk/service/server.h"
#include "walk/service/spot_measurement.h"

namespace stilb::cli {
namespace {

/// How often the command looks for Ctrl-C and for the end of the computation.
constexpr std::chrono::milliseconds kGlance{20};

struct ViewRequest {
    std::string input, output;
    std::vector<std::string> overrides;
    std::optional<int> port, degree;
    bool no_browser = false;
    RunFlags flags;
};

/// The input as read: the scene, and its light where it is solved already.
struct Input {
    io::SceneFile file;
    std::optional<io::StoredSolution> stored;
    bool is_first_look = false;  ///< lit by lamps that are no part of the scene
};

/// The scene of a solution, which lies where it lay when it was solved.
std::string scene_of(const io::StoredSolution& stored, const std::string& solution) {
    const auto scene = std::filesystem::path(solution).parent_path() / stored.scene;
    if (std::filesystem::exists(scene)) return scene.string();
    throw InputError(fmt::format("scene '{}' of this solution was not found. Move it back there, or solve it "
                                 "again where it is.",
                                 scene.string()),
                     {solution});
}

/// Refuses flags that a solution, which has its light, cannot follow.
void require_no_solving(const ViewRequest& request) {
    std::vector<std::string> given = request.flags.given();
    if (request.degree) given.emplace_back("--degree");
    if (given.empty()) return;
    throw InputError(
        fmt::format("{} has no effect on a solution, whose light is computed. Give it to `stilb "
                    "solve`, or view the scene instead.",
                    given.front()));
}

Input read_input(const ViewRequest& request) {
    Input input;
    if (io::kind_of_file(request.input) != io::FileKind::solution) {
        input.file = read_scene(request.input, request.overrides, request.flags.show_progress());
        input.file.run.method = "ray-bundle";
        return input;
    }
    require_no_solving(request);
    input.stored = io::read_solution_file(request.input);
    input.file =
        read_scene(scene_of(*input.stored, request.input), request.overrides, request.flags.show_progress());
    require_same_light(*input.stored, input.file, request.input);
    estimators::require_consistency(input.stored->solution, input.file.scene);
    input.file.sources.emplace_back(request.input);
    return input;
}

/// Lights a scene that has no lamps yet, and adds a camera where there is none.
void take_first_look(const ViewRequest& request, Input& input) {
    io::SceneFile& file = input.file;
    if (input.stored || !file.scene.lights.empty()) return;
    if (!request.output.empty() && !is_page(request.output)) {
        throw InputError(
            "the scene has no light, so there is no solution to keep. Give it a lamp; or leave -o out, or "
            "name a "
            "page (.html), for a first look.",
            {request.input});
    }
    const rays::RayCaster caster(file.scene);
    if (std::ranges::none_of(file.sensors, [](const Sensor& sensor) { return sensor.camera() != nullptr; }))
        file.sensors.push_back(sensors::camera_for_first_look(file.scene, caster));
    file.scene.lights = sensors::lights_for_first_look(file.scene, caster);
    std::erase_if(file.warnings, is_of(WarningKind::no_light));
    file.warnings.emplace_back(
        WarningKind::first_look,
        "the scene has no light: for a first look, a bulb in each room, one outside and an even sky light "
        "it. "
        "Its illuminances and luminances are not those of any lamps.");
    input.is_first_look = true;
}

/// Refuses outputs before anything is computed.
void require_output(const ViewRequest& request, const Input& input) {
    if (request.output.empty()) return;
    if (io::is_standard_output(request.output))
        throw InputError("-o - is not possible. Name a file that ends in .html or .solution.");
    if (!is_page(request.output)) {
        if (input.stored)
            throw InputError(fmt::format(
                "-o {}: the solution is a file already. -o writes a page (.html) of it.", request.output));
        return io::require_output(request.output, io::FileKind::solution, input.file.sources);
    }
    if (request.port || request.no_browser)
        throw InputError(fmt::format("{} has no effect with -o {}: a page in a file needs no server.",
                                     request.port ? "--port" : "--no-browser", request.output));
    io::require_output(request.output, io::FileKind::walk, input.file.sources);
}

/// The computation, with its progress on the terminal.
class Viewing {
  public:
    Viewing(const ViewRequest& request, Input& input)
        : progress_(std::in_place, "steps", request.flags.off_terminal()) {
        if (!input.stored) {
            walk_.emplace(input.file, request.flags.over(input.file.run),
                          request.degree.value_or(run::kDefaultDegree),
                          request.flags.quiet ? nullptr : &*progress_);
            return;
        }
        SolveResult solved;
        solved.samples = input.stored->steps;
        solved.seed = input.stored->seed;
        solved.attained_error = input.stored->attained_error;
        solved.solution = std::move(input.stored->solution);
        walk_.emplace(input.file, std::move(solved));
    }

    walk::LiveWalk& walk() { return *walk_; }
    /// Waits for the end of the computation; where the user interrupts, ends it.
    void wait(const std::atomic<bool>& interrupt) {
        while (!walk_->is_finished() && !interrupt) std::this_thread::sleep_for(kGlance);
        if (interrupt) walk_->interrupt();
    }
    SolveResult finish() {
        SolveResult result = walk_->finish();
        progress_.reset();  // messages follow
        return result;
    }

  private:
    std::optional<TerminalProgress> progress_;
    std::optional<walk::LiveWalk> walk_;
};

/// For the way to a browser on this machine: what takes long to compress is no faster there.
walk::Bytes compressed(const walk::Bytes& container) {
    if (!container) return nullptr;
    return std::make_shared<const std::string>(io::gzip(*container, io::Compression::fast));
}

walk::Handlers handlers_of(const io::SceneFile& file, const walk::LiveWalk& walk, walk::SpotMeter& meter) {
    return {
        .page = walk::page_files(),
        .scene = [&walk] { return compressed(walk.scene()); },
        .light = [&walk] { return compressed(walk.light()); },
        .state = [&walk] { return walk.state(); },
        .measure =
            [&meter](std::string_view json) { return to_json(meter.measure(walk::read_spot_request(json))); },
        .sensors =
            [&file](std::string_view json) {
                return walk::keep_placed_sensors(json, file.sensors, file.sources.front());
            }};
}

/// Prints how the computation ended, and keeps the solution where the user wants it. Returns the exit code.
int conclude(const ViewRequest& request, const Input& input, SolveResult& result) {
    const int exit_code = result.converged ? kExitDone : kExitStoppedEarly;
    if (input.stored) return exit_code;
    if (input.is_first_look) result.warnings.clear();  // of lamps that are no part of the scene
    const SolveResult& summary = result;
    Outputs outputs;
    std::optional<std::size_t> bytes;
    const bool is_kept = !request.output.empty() && !is_page(request.output);
    if (is_kept) {
        const io::StoredSolution solution =
            io::stored_solution(result, std::move(result.solution), input.file, request.output);
        outputs.write([&] { bytes = write_solution_file(solution, request.output); });
    }
    if (!request.flags.quiet) print_warnings(summary.warnings);
    fmt::print("95 % of the light is exact within {}\n", io::percent(summary.attained_error));
    fmt::print("ray-bundle, {} steps in {:.1f} s: {}\n", summary.samples, summary.elapsed_s,
               io::ending(summary.stop_reason, "steps"));
    fmt::print("{}{}", shortfall_text(summary, is_kept ? request.output : ""), maintenance_line(summary));
    if (bytes)
        fmt::print("{}: the solution, {:.1f} MB\n", request.output, 1e-6 * static_cast<double>(*bytes));
    std::fflush(stdout);
    return outputs.conclude(exit_code);
}

/// The page with its origin in its head, and with the rule that it loads nothing.
std::string marked(std::string page) {
    constexpr std::string_view head = "<head>";
    constexpr std::string_view policy =
        R"(<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; )"
        R"(style-src 'unsafe-inline'; img-src data: blob:; connect-src data: blob:; worker-src blob:">)";
    const std::size_t found = page.find(head);
    if (found == page.npos) throw std::runtime_error("the page lacks <head>");
    return page.insert(found + head.size(), fmt::format("\n{}\n{}", io::kWalkMark, policy));
}

/// Writes the walk as one file.
int write_page(const ViewRequest& request, const Input& input, Viewing& viewing) {
    viewing.walk().start();
    viewing.wait(watch_for_interrupt());
    SolveResult result = viewing.finish();
    const std::string page = marked(
        walk::self_contained_page(*viewing.walk().scene(), *viewing.walk().light(), walk::page_files()));
    Outputs outputs;
    const bool is_written = outputs.write([&] { io::replace_file(request.output, page); });
    const int exit_code = conclude(request, input, result);
    if (is_written) {
        fmt::print("{}: {:.1f} MB, opens in any browser\n", request.output,
                   1e-6 * static_cast<double>(page.size()));
    }
    return outputs.conclude(exit_code);
}

/// Serves the walk until the user interrupts.
int serve(const ViewRequest& request, const Input& input, Viewing& viewing) {
    const std::atomic<bool>& interrupt = watch_for_interrupt();
    walk::SpotMeter meter(input.file.scene, request.flags.over(input.file.run));
    std::optional<walk::Server> server(std::in_place, handlers_of(input.file, viewing.walk(), meter),
                                       request.port.value_or(0));
    fmt::print("{}\n", server->address());
    fmt::print("Ctrl-C ends the walk{}\n",
               request.output.empty() && !input.stored
                   ? " and forgets its light; with -o FILE.solution it would be kept."
                   : ".");
    std::fflush(stdout);
    viewing.walk().start();
    if (!request.no_browser) open_browser(server->address());

    viewing.wait(interrupt);
    if (interrupt) {
        meter.cancel();
        server.reset();
    }
    SolveResult result = viewing.finish();
    const int exit_code = conclude(request, input, result);
    while (!interrupt) std::this_thread::sleep_for(kGlance);
    meter.cancel();
    return exit_code;
}

int run_view(const ViewRequest& request) {
    Input input = read_input(request);
    require_output(request, input);
    take_first_look(request, input);
    if (!request.flags.quiet) print_warnings(input.file.warnings);
    Viewing viewing(request, input);
    return is_page(request.output) ? write_page(request, input, viewing) : serve(request, input, viewing);
}

}  // namespace

void add_view(CommandLine& line) {
    Command command =
        line.add_command("view", "Walk through a lit scene in the browser, while its light is computed");
    command.set_examples(
        "  stilb view office.toml\n"
        "  stilb view office.toml -o office.solution --error 1%\n"
        "  stilb view office.solution --port 8000 --no-browser\n"
        "  stilb view office.solution -o office.html\n");
    auto request = std::make_shared<ViewRequest>();
    command
        .add("SCENE", request->input,
             "Scene (TOML, glTF, OBJ, Radiance), - for standard input, or a solution")
        .required();
    command
        .add("-o,--output", request->output,
             "A page (.html) that needs neither Stilb nor network, instead of a server; or the solution to "
             "keep (any other name)")
        .value_name("FILE");
    command
        .add("--port", request->port,
             "Port of this machine to serve the page at (default: 0, any that is free)")
        .from_to(0, 65535)
        .value_name("N");
    command.add("--no-browser", request->no_browser, "Print the address only, and open no browser");
    add_overrides(command, request->overrides);
    request->flags.add_those_of_solutions(command, request->degree);
    command.run([request] { return run_view(*request); });
}

}  // namespace stilb::cli
