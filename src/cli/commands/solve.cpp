// stilb solve: the view-independent light of a scene, as a file.
#include "run/solve.h"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "cli/command_line.h"
#include "cli/commands/results_table.h"
#include "cli/outputs.h"
#include "cli/progress.h"
#include "cli/run_flags.h"
#include "cli/scene_argument.h"
#include "cli/state_file.h"
#include "io/results/results_text.h"
#include "io/results/solution_file.h"
#include "io/text/file_kind.h"

namespace stilb::cli {
namespace {

struct SolveRequest {
    std::string scene, output;
    std::vector<std::string> overrides;
    std::optional<int> degree;
    StateFlags state;
    RunFlags flags;
};

/// `bytes`: of the file, where it could be written.
void print_summary(const SolveResult& result, const io::StoredSolution& stored,
                   std::optional<std::size_t> bytes, const std::string& output) {
    std::FILE* const stream = messages_beside(output);
    const estimators::PatchSolution& solution = stored.solution;
    if (bytes) {
        fmt::print(stream, "{}: light at {} vertices, {} {} of lights, {:.1f} MB\n", output,
                   solution.lit_vertices.size(), solution.groups.size(),
                   solution.groups.size() == 1 ? "group" : "groups", 1e-6 * static_cast<double>(*bytes));
    }
    fmt::print(stream,
               "95 % of the light falls on places with a 95 % interval within {} of their illuminance\n",
               io::percent(result.attained_error));
    fmt::print(stream, "ray-bundle, {} steps in {:.1f} s: {}\n", result.samples, result.elapsed_s,
               io::ending(result.stop_reason, "steps"));
    fmt::print(stream, "{}{}", shortfall_text(result, output), maintenance_line(result));
    fmt::print(stream, "{}", io::patch_text(*result.patches));
}

int run_solve(const SolveRequest& request, const CommandLine& line) {
    io::SceneFile file = read_scene(request.scene, request.overrides, request.flags.show_progress());
    file.run.method = "ray-bundle";
    const RunOptions options = request.flags.over(file.run);
    io::require_output(request.output, io::FileKind::solution, file.sources);
    const int degree = request.degree.value_or(run::kDefaultDegree);
    StateFile state_file(request.state, "solve", line, file.sources, [&] {
        io::RunTraits traits = io::traits_of(file, {}, options);
        traits.push_back({"degree", fmt::format("{}", degree)});
        return traits;
    });
    run::SolutionState state;
    state_file.keep("solution", state);
    SolveResult result;
    {
        TerminalProgress progress("steps", request.flags.off_terminal());
        KeepingState keeping(request.flags.quiet ? nullptr : &progress, state_file);
        result = state_file.keeping_state([&] {
            return solve(file.scene, options, degree, &keeping, &watch_for_interrupt(), nullptr, &state);
        });
    }
    result.elapsed_s += state_file.elapsed_before_s();
    put_first(file.warnings, result);
    const io::StoredSolution solution =
        io::stored_solution(result, std::move(result.solution), file, request.output);
    // Before all messages: the terminal may be closed by now.
    Outputs outputs;
    outputs.write([&] { state_file.write(result.stop_reason); });
    std::optional<std::size_t> bytes;
    outputs.write([&] { bytes = write_solution_file(solution, request.output); });
    if (!request.flags.quiet) print_warnings(result.warnings);
    print_summary(result, solution, bytes, request.output);
    return outputs.conclude(result.converged ? kExitDone : kExitStoppedEarly);
}

}  // namespace

void add_solve(CommandLine& line) {
    Command command = line.add_command(
        "solve", "Compute the light of a scene independently of the view, for pictures by render --from");
    command.set_examples(
        "  stilb solve office.toml -o office.solution\n"
        "  stilb solve office.toml -o office.solution --error 0.5% --patch 0.1\n"
        "  stilb render --from office.solution --sensor door -o door.png\n");
    auto request = std::make_shared<SolveRequest>();
    command.add("SCENE", request->scene, "Scene (TOML, glTF, OBJ, Radiance), or - for standard input")
        .required();
    command.add("-o,--output", request->output, "Solution to write (- is stdout)")
        .required()
        .value_name("FILE");
    add_overrides(command, request->overrides);
    request->state.add_to(command);
    request->flags.add_those_of_solutions(command, request->degree);
    command.run([request, &line] { return run_solve(*request, line); });
}

}  // namespace stilb::cli
