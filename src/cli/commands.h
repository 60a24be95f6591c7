// The commands. Each add_... declares its command with flags and examples; once the line is parsed, the
// chosen command runs and sets `exit_code`. Errors in the input are thrown (InputError); main prints them and
// exits with 2.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace stilb::cli {

inline constexpr int kExitDone = 0;
inline constexpr int kExitCheckFailed = 1;
inline constexpr int kExitWrongInput = 2;
inline constexpr int kExitStoppedEarly = 3;  ///< also before there was any result

/// Puts examples, one a line, before everything else that the command's --help says.
void set_examples(CLI::App& command, const std::string& examples);

void add_measure(CLI::App& app, int& exit_code);
void add_solve(CLI::App& app, int& exit_code);
/// `command_line`: as typed, for the picture's header.
void add_render(CLI::App& app, const std::string& command_line, int& exit_code);
void add_fit(CLI::App& app, int& exit_code);
void add_info(CLI::App& app, int& exit_code);
void add_falsecolor(CLI::App& app, int& exit_code);
void add_verify(CLI::App& app, int& exit_code);

}  // namespace stilb::cli
