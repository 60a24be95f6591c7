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
#include "cli/commands/render.h"
#include "cli/state_file.h"
#include "io/results/run_file.h"
#include "io/text/file_kind.h"
#include "io/text/text.h"
#include "run/pictures/picture_sums.h"
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

/// The sums of the files, of readings (RunState) or of one picture (PictureSums): first those of the parts of
/// each seed, then of all seeds. Only two are in memory at a time.
template <typename Sums>
class Merging {
  public:
    explicit Merging(const std::string& first) : first_(first) {}

    void add(const std::string& file) {
        const io::StoredRun stored = io::read_run_file(file);
        if (stored.sums.empty()) throw InputError("the run has no sums.", {file});
        if (name_.empty()) {
            name_ = stored.sums.front().name;
            origin_ = stored.origin;
            origin_.elapsed_s = 0;
        }
        require_mergeable(origin_, stored.origin.traits, file);
        auto sums = io::read_sums<Sums>(stored, name_, file);
        if (of_seed_ && sums.seeds() != of_seed_->seeds()) end_seed(file);
        merge(file, std::move(sums), of_seed_);
        origin_.elapsed_s += stored.origin.elapsed_s;
    }
    /// `file`: that the sums are for.
    io::StoredRun merged(const std::string& file) && {
        end_seed(first_);
        const std::filesystem::path folder = folder_of(origin_, first_);
        origin_.folder = io::relative_folder(folder, file);
        origin_.arguments =
            without_flags(std::move(origin_.arguments), std::array<std::string_view, 1>{"--part"});
        origin_.ending = run::name_of(StopReason::paths_done);
        return {std::move(origin_), {{name_, io::sums_of(*all_)}}};
    }

  private:
    void end_seed(const std::string& file) { merge(file, *std::exchange(of_seed_, std::nullopt), all_); }
    void merge(const std::string& file, Sums sums, std::optional<Sums>& into) const {
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
    std::string name_;  ///< of the sums
    io::RunOrigin origin_;
    std::optional<Sums> of_seed_, all_;
};

template <typename Sums>
io::StoredRun merged(const std::vector<std::string>& files, const std::string& name) {
    Merging<Sums> merging(files.front());
    for (const std::string& file : files) merging.add(file);
    return std::move(merging).merged(name);
}

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

/// Throws InputError for flags of readings alone.
void require_picture_flags(const MergeRequest& request) {
    const ReadingFiles& files = request.show.files;
    if (files.json || !files.csv_directory.empty() || !files.picture.empty() || files.has_replicates ||
        request.show.checks)
        throw InputError(
            "these are states of a picture: merge takes -o PICTURE, --state and --quiet for them, no --json, "
            "--csv, --falsecolor, --replicates or --check.");
    if (files.output.empty() && request.state.empty())
        throw InputError("-o is missing. It gives the picture to write: -o FILE.exr, .hdr or .png.");
}

int run_merge(const MergeRequest& request) {
    const std::vector<std::string> files = by_seed(request.files);
    const std::string& name = request.state.empty() ? files.front() : request.state;
    if (!request.state.empty()) {
        const std::vector<std::filesystem::path> inputs(files.begin(), files.end());
        io::require_output(request.state, io::FileKind::run, inputs);
    }
    const std::string command =
        io::read_run_origin(io::read_whole_file(files.front()), files.front()).command;
    if (command != "measure" && command != "render") {
        throw InputError(
            fmt::format("this is the state of `stilb {}`. States of measure and of render can be merged.",
                        command),
            {files.front()});
    }
    const bool is_picture = command == "render";
    if (is_picture) require_picture_flags(request);
    const io::StoredRun all =
        is_picture ? merged<run::PictureSums>(files, name) : merged<run::RunState>(files, name);
    if (!request.state.empty()) write_run_file(all, request.state);
    if (!is_picture) return show_stored(all, name, request.show);
    if (!request.show.files.output.empty())
        return show_stored_picture(all, name, request.show.files.output, request.show.quiet);
    if (!request.show.quiet)
        fmt::print("{}: the passes of {} files. Their picture: stilb render --from {} -o PICTURE\n", name,
                   files.size(), name);
    return kExitDone;
}

}  // namespace

void add_merge(CommandLine& line) {
    Command command = line.add_command("merge", "Put the parts of a run, or runs of several seeds, together");
    command.set_examples(
        "  stilb measure hall.toml --paths 1e7 --part 1/16 --state part1.run    # on each machine another "
        "part\n"
        "  stilb merge part*.run -o hall.json\n"
        "  stilb render hall.toml --paths 4096 --part 1/4 --state view1.run\n"
        "  stilb merge view*.run -o hall.exr\n"
        "  stilb merge seed1.run seed2.run --state both.run --csv results\n");
    auto request = std::make_shared<MergeRequest>();
    command.add("FILE", request->files, "States of runs of measure, or of render (two or more)").required();
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
