// The state file of a command (--state): its run goes on from it, and is written into it.
#pragma once

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command_line.h"
#include "io/results/run_file.h"
#include "run/run.h"
#include "run/solve.h"

namespace stilb::cli {

/// The flags --state and --state-every.
struct StateFlags {
    std::string path;
    double every_s = 30;

    void add_to(Command& command);
};

/// Without --state, it keeps nothing.
class StateFile {
  public:
    /// Reads the file where there is one already. `command`: its name; `line`: it as typed; `sources`: the
    /// files of the scene; `traits`: called where a state is kept. Throws InputError where the file is not
    /// the state of this run, or could not be written.
    StateFile(const StateFlags& flags, std::string_view command, const CommandLine& line,
              std::span<const std::filesystem::path> sources, const std::function<io::RunTraits()>& traits);

    /// Sets sums that the file has under this name; they are written from now on. Keeps a reference.
    template <typename Sums>
    void keep(const std::string& name, Sums& sums) {
        if (path_.empty()) return;
        if (std::ranges::find(stored_.sums, name, &io::StoredSums::name) != stored_.sums.end())
            sums = io::read_sums<Sums>(stored_, name, path_);
        std::erase_if(stored_.sums, [&](const io::StoredSums& stored) { return stored.name == name; });
        kept_.push_back({name, [&sums] { return has_begun(sums) ? io::sums_of(sums) : std::string(); }});
    }

    /// Writes where the time for it has come. A failure is a warning: the next attempt may succeed.
    void write_if_due();
    /// Throws InputError where it cannot be written, or another run has written it meanwhile. `ending`: why
    /// the run has ended.
    void write(std::optional<StopReason> ending);

    /// Runs an action. The state is written, too, where an exception ends it.
    template <typename Action>
    auto keeping_state(const Action& action) {
        try {
            return action();
        } catch (...) {
            write_or_warn();
            throw;
        }
    }

    /// What other processes have spent on the run.
    double elapsed_before_s() const { return stored_.origin.elapsed_s; }

  private:
    struct Kept {
        std::string name;
        std::function<std::string()> bytes;
    };

    void write_or_warn();
    static bool has_begun(const run::RunState& state) { return !state.plan.technique.empty(); }
    static bool has_begun(const run::PictureSums& sums);
    static bool has_begun(const run::SolutionState& state) { return state.has_begun(); }
    double elapsed_s() const;
    void require_own_file() const;

    std::string path_;
    double every_s_;
    io::StoredRun stored_;  ///< as it was read, or begun; without the sums that are kept
    std::vector<Kept> kept_;
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
    std::chrono::steady_clock::time_point written_ = begun_;
    double writing_s_ = 0;                                  ///< the last time
    std::optional<std::filesystem::file_time_type> stamp_;  ///< of the file as this run has left it
    bool has_failed_ = false;
};

/// Progress that also keeps the state. `shown` may be null.
class KeepingState final : public PictureSink {
  public:
    KeepingState(PictureSink* shown, StateFile& file) : shown_(shown), file_(file) {}
    void report_set_up(const SetUp& set_up) override {
        if (shown_) shown_->report_set_up(set_up);
    }
    void report(const Progress& progress) override {
        if (shown_) shown_->report(progress);
        file_.write_if_due();
    }
    bool wants_picture() override { return shown_ && shown_->wants_picture(); }
    void show(const Pixels& pixels) override { shown_->show(pixels); }

  private:
    PictureSink* shown_;
    StateFile& file_;
};

/// Adds the flag --part.
void add_part(Command& command, std::optional<std::string>& part);
/// "3/16" as the third part, which has number 2. Throws InputError for other texts, and where no state is
/// kept.
run::RunPart part_of(const std::string& text, const StateFlags& state);

/// Reads the arguments of a stored run into the request of its command, which the line has.
void read_arguments(const io::RunOrigin& origin, CommandLine& line);
/// A path of a stored run, which was given in its folder. `name`: of the state file.
std::string path_from(const std::string& path, const io::RunOrigin& origin, const std::string& name);

/// The arguments of a command without these flags and their values.
std::vector<std::string> without_flags(std::vector<std::string> arguments,
                                       std::span<const std::string_view> flags);

}  // namespace stilb::cli
