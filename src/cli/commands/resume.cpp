// stilb resume: goes on with a run whose state was kept.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <utility>

#include "cli/command_line.h"
#include "cli/state_file.h"
#include "io/results/run_file.h"
#include "io/text/table.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

struct ResumeRequest {
    std::string file;
    // As texts: the command of the run reads them.
    std::optional<std::string> error, time, paths, output, json, csv, picture, threads, state_every;
    bool quiet = false, progress = false, has_replicates = false;
};

constexpr std::array<std::string_view, 3> kLimits{"--error", "--time", "--paths"};

bool has_limit(const ResumeRequest& request) { return request.error || request.time || request.paths; }

std::string absolute(const std::string& path) {
    return io::is_standard_output(path) ? path : std::filesystem::absolute(path).string();
}

/// The command of the run, with what is typed in place of the same flags.
std::vector<std::string> arguments_of(const ResumeRequest& request, const io::RunOrigin& origin) {
    std::vector<std::string> all = origin.arguments;
    if (has_limit(request)) all = without_flags(std::move(all), kLimits);
    const auto add = [&](std::string_view flag, const std::optional<std::string>& value) {
        if (!value) return;
        all = without_flags(std::move(all), {&flag, 1});
        all.insert(all.end(), {std::string(flag), *value});
    };
    const auto add_file = [&](std::string_view flag, const std::optional<std::string>& path) {
        add(flag, path ? std::optional(absolute(*path)) : std::nullopt);
    };
    if (request.output) all = without_flags(std::move(all), std::array<std::string_view, 1>{"-o"});
    add_file("--output", request.output);
    add_file("--json", request.json);
    add_file("--csv", request.csv);
    add_file("--falsecolor", request.picture);
    add("--error", request.error);
    add("--time", request.time);
    add("--paths", request.paths);
    add("--threads", request.threads);
    add("--state-every", request.state_every);
    add("--state", absolute(request.file));
    const auto add_switch = [&](const std::string& flag, bool is_on) {
        if (is_on && std::ranges::find(all, flag) == all.end()) all.push_back(flag);
    };
    add_switch("--replicates", request.has_replicates);
    add_switch("--quiet", request.quiet);
    add_switch("--progress", request.progress);
    all.insert(all.begin(), {"stilb", origin.command});
    return all;
}

int run_resume(const ResumeRequest& request, const RunCommands& run_commands) {
    const io::RunOrigin origin = io::read_run_origin(io::read_whole_file(request.file), request.file);
    if (is_finished(origin) && !has_limit(request)) {
        fmt::print("{}: the run has ended: {}. A closer limit (--error, --paths) makes it go on.\n",
                   request.file, origin.ending);
        return kExitDone;
    }
    const std::vector<std::string> arguments = arguments_of(request, origin);
    const std::filesystem::path folder = folder_of(origin, request.file);
    std::error_code error;
    std::filesystem::current_path(folder, error);
    if (error) {
        throw InputError(fmt::format("the run was begun in '{}', which cannot be entered now. Move the state "
                                     "file and its scene together.",
                                     folder.string()),
                         {request.file});
    }
    return run_commands(arguments);
}

}  // namespace

void add_resume(CommandLine& line, RunCommands run_commands) {
    Command command = line.add_command("resume", "Go on with a run whose state was kept (--state)");
    command.set_examples(
        "  stilb measure hall.toml --error 0.1% --state hall.run\n"
        "  stilb resume hall.run\n"
        "  stilb resume hall.run --error 0.05% -o hall.json\n");
    auto request = std::make_shared<ResumeRequest>();
    command.add("FILE", request->file, "State of a run of measure, render, report or solve").required();
    const auto add = [&](const char* names, std::optional<std::string>& value, const char* text,
                         const char* name) { command.add(names, value, text).value_name(name); };
    add("--error", request->error, "Another limit, in place of those that the run had: its error", "SHARE");
    add("--time", request->time, "Another limit: so many seconds more", "S");
    add("--paths", request->paths, "Another limit: so many samples in all", "N");
    add("-o,--output", request->output, "Another file for the result", "FILE");
    command
        .add("--json", request->json,
             "One JSON document on stdout instead of the table, or into this file (measure)")
        .optional_value("-")
        .value_name("[FILE]");
    add("--csv", request->csv, "Write also a CSV file per sensor into this folder (measure)", "DIR");
    add("--falsecolor", request->picture, "Write also a false-colour picture of grids and areas (measure)",
        "FILE");
    command.add("--replicates", request->has_replicates,
                "Write also the values of all replicates into the JSON document (measure)");
    add("--threads", request->threads, "Processor threads", "N");
    add("--state-every", request->state_every, "Write the state every so many seconds", "S");
    command.add("--quiet", request->quiet, "Print no progress and no warnings");
    command.add("--progress", request->progress,
                "Print progress on stderr as plain lines, also where that is not a terminal");
    command.run(
        [request, run_commands = std::move(run_commands)] { return run_resume(*request, run_commands); });
}

}  // namespace stilb::cli
