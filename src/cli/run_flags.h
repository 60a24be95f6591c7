// The flags that all computing commands share.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command_line.h"
#include "cli/progress.h"
#include "estimators/patch_light/patch_options.h"
#include "run/options.h"

namespace stilb::estimators {
struct EstimatorEntry;
}  // namespace stilb::estimators

namespace stilb::cli {

// The flags of patches and first shot.

struct PatchFlags {
    std::optional<double> patch_m;
    std::optional<std::string> first_shot, window, visibility, directions;
    std::optional<int> resolution;

    void add_to(Command& command);
    /// Leaves all but --patch to `stilb help patches`.
    static void hide_in(Command& command);
    /// Throws InputError where a given flag does not apply to the method, or has no such value.
    estimators::PatchOptions options_for(const std::string& method) const;
    /// The names of the flags that were typed.
    std::vector<std::string_view> given() const;

  private:
    void require_known_to(const estimators::EstimatorEntry& method) const;
};

/// The flags as typed; each replaces the same key of the scene's [run].
struct RunFlags {
    std::optional<std::string> method, error;
    std::optional<double> time_s;
    std::optional<std::uint64_t> paths, seed;
    std::optional<int> bounces, threads;
    bool quiet = false, progress = false;
    PatchFlags patches;

    ShowProgress show_progress() const {
        if (quiet) return ShowProgress::never;
        return progress ? ShowProgress::everywhere : ShowProgress::on_terminal;
    }
    OffTerminal off_terminal() const { return progress ? OffTerminal::plain_lines : OffTerminal::nothing; }

    void add_to(Command& command);
    /// Adds those of solutions: all flags except --method and --bounces, and --degree.
    void add_those_of_solutions(Command& command, std::optional<int>& degree);
    /// The names of the typed flags, except --threads and --quiet.
    std::vector<std::string_view> given() const;
    /// The options with the typed flags applied. --paths alone drops the file's error and time: exactly so
    /// many paths are done.
    RunOptions over(RunOptions options) const;

  private:
    /// All flags except --method and --bounces.
    void add_those_of_all(Command& command);
};

/// Keeps `time_s` seconds of a time limit, but half of it at most, for statistics and files.
RunOptions with_reserve(RunOptions options, double time_s);
/// The same for the statistics and the file of a picture of so many pixels.
RunOptions with_picture_reserve(RunOptions options, const std::array<int, 2>& resolution);

}  // namespace stilb::cli
