// stilb merge: the result of the states of several runs.
#include <fmt/format.h>

#include <array>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands/measure.h"
#include "cli/state_file.h"
#include "io/results/run_file.h"
#include "io/text/file_kind.h"
#include "run/plan.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

struct MergeRequest {
    std::vector<std::string> files;
    std::string state;
    ShowFlags show;
};

/// A run, in place of its part or another seed.
io::RunTraits without_seed(io::RunTraits traits) {
    std::erase_if(traits, [](const io::RunTrait& trait) { return trait.name == "seed"; });
    return traits;
}

/// Adds the sums of a file to those of others. Messages name both.
void add(const std::string& file, const std::string& first, const io::StoredRun& merged, run::RunState& sums,
         io::StoredRun& stored) {
    io::RunOrigin own = merged.origin;
    own.traits = without_seed(own.traits);
    require_same_run(own, without_seed(stored.origin.traits), file);
    try {
        sums.merge(io::read_sums<run::RunState>(stored, kReadingSums, file));
    } catch (const std::invalid_argument& error) {
        throw InputError(fmt::format("cannot be merged with {}: {}.", first, error.what()), {file});
    }
}

io::StoredRun merged(const std::vector<std::string>& files) {
    io::StoredRun all = io::read_run_file(files.front());
    auto sums = io::read_sums<run::RunState>(all, kReadingSums, files.front());
    for (std::size_t i = 1; i < files.size(); ++i) {
        io::StoredRun stored = io::read_run_file(files[i]);
        add(files[i], files.front(), all, sums, stored);
        all.origin.elapsed_s += stored.origin.elapsed_s;
    }
    all.origin.arguments =
        without_flags(std::move(all.origin.arguments), std::array<std::string_view, 1>{"--part"});
    all.origin.ending = run::name_of(StopReason::paths_done);
    all.sums = {{std::string(kReadingSums), io::sums_of(sums)}};
    return all;
}

int run_merge(const MergeRequest& request) {
    io::StoredRun all = merged(request.files);
    if (!request.state.empty()) {
        const std::vector<std::filesystem::path> inputs(request.files.begin(), request.files.end());
        io::require_output(request.state, io::FileKind::run, inputs);
        write_run_file(all, request.state);
    }
    return show_stored(all, request.state.empty() ? request.files.front() : request.state, request.show);
}

}  // namespace

void add_merge(CommandLine& line) {
    Command command = line.add_command("merge", "Put the parts of a run, or runs of several seeds, together");
    command.set_examples(
        "  stilb measure hall.toml --paths 1e7 --part 1/16 --state part1.run    # on each machine another "
        "part\n"
        "  stilb merge part*.run -o hall.json\n"
        "  stilb merge seed1.run seed2.run --state both.run --csv results\n");
    auto request = std::make_shared<MergeRequest>();
    command.add("FILE", request->files, "States of runs of measure (two or more)").required();
    command.add("--state", request->state, "Write the sums of all into this file").value_name("FILE");
    request->show.files.add_to(command);
    command.add(
        "--check", request->show.checks,
        "Exit with code 1 where a requirement of a sensor is not met, with code 3 where it is not sure, "
        "else with 0");
    command.add("--quiet", request->show.quiet, "Print no warnings");
    command.run([request] { return run_merge(*request); });
}

}  // namespace stilb::cli
