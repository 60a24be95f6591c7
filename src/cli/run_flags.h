// The flags that all computing commands share.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command_line.h"
#include "cli/progress.h"
#include "run/options.h"

namespace stilb::cli {

/// Adds the flag of an option, with its limits and meaning. Its value goes to `options`.
Flag add_option(Command& command, api::Options& options, std::string_view key);

/// The flags as typed; those of api::Options replace the same key of the scene's [run].
class RunFlags {
  public:
    bool quiet = false, progress = false;

    ShowProgress show_progress() const {
        if (quiet) return ShowProgress::never;
        return progress ? ShowProgress::everywhere : ShowProgress::on_terminal;
    }
    OffTerminal off_terminal() const { return progress ? OffTerminal::plain_lines : OffTerminal::nothing; }

    // Commands keep a reference to the flags.

    /// `left_out`: keys of api::Options without a flag.
    void add_to(Command& command, const std::vector<std::string_view>& left_out = {});
    /// Adds those of solutions, and --degree.
    void add_those_of_solutions(Command& command, std::optional<int>& degree);
    /// Adds those of patches and first shot, which add_to() leaves to `stilb help patches`.
    void add_those_of_patches(Command& command);
    bool is_given(std::string_view flag) const;
    /// The names of the typed flags, except --threads and --quiet.
    std::vector<std::string> given() const;
    /// The options with the typed flags applied. --paths alone drops the file's error and time: exactly so
    /// many paths are done. Throws InputError where a flag has no effect with the method.
    RunOptions over(RunOptions options) const;

  private:
    void add_all_but(const std::vector<std::string_view>& left_out, Command& command);

    api::Options typed_;
    std::vector<Flag> flags_;
};

/// Keeps `time_s` seconds of a time limit, but half of it at most, for statistics and files.
RunOptions with_reserve(RunOptions options, double time_s);
/// The same for the statistics and the file of a picture of so many pixels.
RunOptions with_picture_reserve(RunOptions options, const std::array<int, 2>& resolution);

}  // namespace stilb::cli
