// Commands and their flags. Only this module's source includes CLI11, because each file that does takes
// seconds to compile.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/field.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the name of the library
class App;
class Option;
}  // namespace CLI

namespace stilb::cli {

inline constexpr int kExitDone = 0;
inline constexpr int kExitCheckFailed = 1;
inline constexpr int kExitWrongInput = 2;
inline constexpr int kExitStoppedEarly = 3;  ///< also where the run ended before its first result

/// A flag or argument of a command. Its members add to the declaration.
class Flag {
  public:
    explicit Flag(CLI::Option& option) : option_(&option) {}

    Flag& required();
    /// The placeholder of the value in --help, such as "FILE".
    Flag& value_name(const std::string& name);
    /// The heading of the flag in --help.
    Flag& heading(const std::string& text);
    Flag& description(const std::string& text);
    Flag& from_to(std::int64_t least, std::int64_t greatest);
    Flag& within(const Range& range);
    /// A number within the range, also in per cent: 0.01 or 1%.
    Flag& share(const Range& range);
    /// The names must outlive the parsing.
    Flag& one_of(std::span<const std::string_view> names);
    Flag& above_zero();
    /// The flag takes one value each time it is given, and may be repeated.
    Flag& repeatable();
    /// The flag may be given without a value: its value then is `otherwise`. An argument that follows it is
    /// taken for its value.
    Flag& optional_value(const std::string& otherwise);
    /// --help does not show the flag: a topic does (CommandLine::add_topic()).
    Flag& hidden();

    /// Once the line is parsed.
    bool is_given() const;
    /// "--error".
    std::string name() const;

  private:
    CLI::Option* option_;
};

/// One command. The bound variables must outlive the parsing of the command line.
class Command {
  public:
    explicit Command(CLI::App& app, int& exit_code) : app_(&app), exit_code_(&exit_code) {}

    /// Sets examples, one a line, which --help prints first.
    void set_examples(const std::string& examples);
    /// An argument ("SCENE") or a flag with a value ("-o,--output"). T: bool for a flag without a value,
    /// std::string, int, double, std::uint64_t, std::optional of these, std::vector<std::string>.
    template <typename T>
    Flag add(const std::string& names, T& value, const std::string& description);
    /// The last line of --help.
    void set_footer(const std::string& text);
    /// A flag without a value that calls `set`.
    void add_switch(const std::string& names, std::function<void()> set, const std::string& description);
    /// Finds a flag that was added before.
    Flag find(const std::string& name);
    /// Sets the function that runs when the command is chosen. It returns the exit code.
    void run(std::function<int()> command);

  private:
    CLI::App* app_;
    int* exit_code_;
};

/// All commands of the program.
class CommandLine {
  public:
    CommandLine();
    ~CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    Command add_command(const std::string& name, const std::string& summary);
    /// Adds the command `help`, after the commands that precede it in the list of commands.
    void add_help();
    /// Adds a page of `help` on flags that several commands have: `text`, and what is added to the command
    /// returned. It cannot be run. Its variables must outlive the parsing.
    Command add_topic(const std::string& name, const std::string& text);
    /// Parses the arguments and runs the chosen command; returns the program's exit code. Throws InputError
    /// where there is no such command, and passes on the command's exceptions.
    int run(int argument_count, const char* const* arguments);
    /// The command line as typed, for the headers of files.
    const std::string& text() const { return text_; }
    /// What was typed behind the command's name.
    const std::vector<std::string>& arguments() const { return arguments_; }

  private:
    /// Prints the help of a command, or of the program where the name is empty.
    void print_help(const std::string& command) const;

    std::unique_ptr<CLI::App> app_;
    std::vector<std::unique_ptr<CLI::App>> topics_;
    std::string text_;
    std::vector<std::string> arguments_;
    int exit_code_ = kExitDone;
};

// The commands, one file each. Each add_... declares its command with flags and examples; once the line is
// parsed, the chosen command runs and returns the exit code. Errors in the input are thrown (InputError);
// main prints them and exits with kExitWrongInput.

void add_measure(CommandLine& line);
void add_solve(CommandLine& line);
void add_render(CommandLine& line);
void add_view(CommandLine& line);
void add_fit(CommandLine& line);
void add_info(CommandLine& line);
void add_falsecolor(CommandLine& line);
void add_report(CommandLine& line);
void add_export(CommandLine& line);
void add_import(CommandLine& line);
void add_verify(CommandLine& line);
void add_merge(CommandLine& line);
/// Runs a whole command line, with the program's name.
using RunCommands = std::function<int(const std::vector<std::string>&)>;
void add_resume(CommandLine& line, RunCommands run_commands);
/// A topic of `help`.
void add_patch_topic(CommandLine& line);

}  // namespace stilb::cli
