// stilb merge: the result of the states of several runs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands/measure.h"
#include "cli/state_file.h"
#include "io/results/run_file.h"
#include "io/text/file_kind.h"
#include "io/text/text.h"
#include "run/plan.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

struct MergeRequest {
    std::vector<std::string> files;
    std::string state;
    ShowFlags show;
};

/// The seed of a run; parts of a run have the same one.
std::string seed_of(const io::RunOrigin& origin) {
    const auto seed = std::ranges::find(origin.traits, "seed", &io::RunTrait::name);
    return seed == origin.traits.end() ? "" : seed->value;
}

/// The sums of the files: first those of the parts of each seed, then of all seeds. Only two are in memory at
/// a time.
class Merging {
  public:
    explicit Merging(const std::string& first)
        : first_(first), origin_(io::read_run_origin(io::read_whole_file(first), first)) {
        origin_.elapsed_s = 0;
    }

    void add(const std::string& file) {
        const io::StoredRun stored = io::read_run_file(file);
        require_mergeable(origin_, stored.origin.traits, file);
        auto sums = io::read_sums<run::RunState>(stored, io::kReadingSums, file);
        if (of_seed_ && sums.seeds() != of_seed_->seeds()) end_seed(file);
        merge(file, std::move(sums), of_seed_);
        origin_.elapsed_s += stored.origin.elapsed_s;
    }
    /// `name`: of the file that the sums are for.
    io::StoredRun merged(const std::string& name) && {
        end_seed(first_);
        const std::filesystem::path folder = folder_of(origin_, first_);
        origin_.folder = io::relative_folder(folder, name);
        origin_.arguments =
            without_flags(std::move(origin_.arguments), std::array<std::string_view, 1>{"--part"});
        origin_.ending = run::name_of(StopReason::paths_done);
        return {std::move(origin_), {{std::string(io::kReadingSums), io::sums_of(*all_)}}};
    }

  private:
    void end_seed(const std::string& file) { merge(file, *std::exchange(of_seed_, std::nullopt), all_); }
    void merge(const std::string& file, run::RunState sums, std::optional<run::RunState>& into) const {
        if (!into) {
            into = std::move(sums);
            return;
        }
        try {
            into->merge(std::move(sums));
        } catch (const std::invalid_argument& error) {
            throw InputError(fmt::format("cannot be merged with {}: {}.", first_, error.what()), {file});
        }
    }

    const std::string& first_;
    io::RunOrigin origin_;
    std::optional<run::RunState> of_seed_, all_;
};

/// The files, those of one seed beside each other, otherwise in their order.
std::vector<std::string> by_seed(const std::vector<std::string>& files) {
    std::vector<std::pair<std::string, std::string>> all;
    for (const std::string& file : files)
        all.emplace_back(seed_of(io::read_run_origin(io::read_whole_file(file), file)), file);
    std::ranges::stable_sort(all, {}, &std::pair<std::string, std::string>::first);
    std::vector<std::string> sorted;
    for (const auto& [seed, file] : all) sorted.push_back(file);
    return sorted;
}

int run_merge(const MergeRequest& request) {
    const std::vector<std::string> files = by_seed(request.files);
    const std::string& name = request.state.empty() ? files.front() : request.state;
    if (!request.state.empty()) {
        const std::vector<std::filesystem::path> inputs(files.begin(), files.end());
        io::require_output(request.state, io::FileKind::run, inputs);
    }
    Merging merging(files.front());
    for (const std::string& file : files) merging.add(file);
    const io::StoredRun all = std::move(merging).merged(name);
    if (!request.state.empty()) write_run_file(all, request.state);
    return show_stored(all, name, request.show);
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
