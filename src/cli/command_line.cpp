#include "cli/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <utility>

#include "stilb/error.h"

namespace stilb::cli {
namespace {

/// The message where a command is missing or unknown.
InputError no_command(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    const std::string all = fmt::format("Commands: {}. See stilb --help.", fmt::join(names, ", "));
    const std::vector<std::string> extras = app.remaining();
    if (extras.empty()) return InputError("a command is missing. " + all);
    const std::string question =
        did_you_mean(extras[0], std::vector<std::string_view>(names.begin(), names.end()));
    return InputError(fmt::format("there is no command \"{}\".{} {}", extras[0], question, all));
}

/// The first argument that no flag or position takes; empty where there is none.
std::string first_extra(const CLI::App& app) {
    const std::vector<std::string> extras = app.remaining();
    const auto flag = std::ranges::find_if(extras, [](const std::string& e) { return e.starts_with('-'); });
    if (flag != extras.end()) return *flag;
    return extras.empty() ? "" : extras.front();
}

/// The message where the arguments of a command cannot be used.
InputError wrong_arguments(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<CLI::App*> commands = app.get_subcommands();
    const CLI::App& command = commands.empty() ? app : *commands.front();
    const std::string name = commands.empty() ? "stilb" : "stilb " + command.get_name();
    std::string problem = error.what();
    if (const std::string extra = first_extra(command); extra.starts_with('-')) {
        std::vector<std::string> flags;
        for (const CLI::Option* option : command.get_options()) flags.push_back(option->get_name());
        problem = fmt::format("there is no flag {}.{}", extra,
                              did_you_mean(extra, std::vector<std::string_view>(flags.begin(), flags.end())));
    } else if (!extra.empty()) {
        problem = fmt::format("\"{}\" is one argument too many.", extra);
    } else if (!problem.ends_with('.')) {
        problem += '.';
    }
    return InputError(fmt::format("{} See {} --help.", problem, name));
}

}  // namespace

Flag& Flag::required() {
    option_->required();
    return *this;
}
Flag& Flag::value_name(const std::string& name) {
    option_->type_name(name);
    return *this;
}
Flag& Flag::heading(const std::string& text) {
    option_->group(text);
    return *this;
}
Flag& Flag::description(const std::string& text) {
    option_->description(text);
    return *this;
}
Flag& Flag::from_to(std::int64_t least, std::int64_t greatest) {
    option_->check(CLI::Range(least, greatest));
    return *this;
}
Flag& Flag::above_zero() {
    option_->check(CLI::PositiveNumber);
    return *this;
}
Flag& Flag::repeatable() {
    option_->allow_extra_args(false);
    return *this;
}
Flag& Flag::show_default() {
    option_->capture_default_str();
    return *this;
}

void Command::set_examples(const std::string& examples) {
    app_->formatter_fn([examples](const CLI::App* app, std::string name, CLI::AppFormatMode mode) {
        return "Examples:\n" + examples + "\n" + CLI::Formatter().make_help(app, std::move(name), mode);
    });
}

template <typename T>
Flag Command::add(const std::string& names, T& value, const std::string& description) {
    if constexpr (std::is_same_v<T, bool>) {
        return Flag(*app_->add_flag(names, value, description));
    } else {
        return Flag(*app_->add_option(names, value, description));
    }
}
template Flag Command::add(const std::string&, bool&, const std::string&);
template Flag Command::add(const std::string&, int&, const std::string&);
template Flag Command::add(const std::string&, double&, const std::string&);
template Flag Command::add(const std::string&, std::uint64_t&, const std::string&);
template Flag Command::add(const std::string&, std::string&, const std::string&);
template Flag Command::add(const std::string&, std::vector<std::string>&, const std::string&);
template Flag Command::add(const std::string&, std::optional<int>&, const std::string&);
template Flag Command::add(const std::string&, std::optional<double>&, const std::string&);
template Flag Command::add(const std::string&, std::optional<std::uint64_t>&, const std::string&);
template Flag Command::add(const std::string&, std::optional<std::string>&, const std::string&);

void Command::add_switch(const std::string& names, std::function<void()> set,
                         const std::string& description) {
    app_->add_flag_callback(names, std::move(set), description);
}

Flag Command::find(const std::string& name) { return Flag(*app_->get_option(name)); }

void Command::run(std::function<int()> command) {
    app_->callback([command = std::move(command), exit_code = exit_code_] { *exit_code = command(); });
}

CommandLine::CommandLine()
    : app_(std::make_unique<CLI::App>("Stilb: illuminance and luminance, each value with its error bar")) {
    app_->name("stilb");
    app_->set_version_flag("--version", STILB_VERSION);
    app_->require_subcommand(0, 1);
    app_->allow_extras();  // so that an unknown command gets a message of its own; no command takes extras
}

CommandLine::~CommandLine() = default;

Command CommandLine::add_command(const std::string& name, const std::string& summary) {
    CLI::App* const command = app_->add_subcommand(name, summary);
    command->allow_extras(false);
    return Command(*command, exit_code_);
}

int CommandLine::run(int argument_count, const char* const* arguments) {
    text_ = fmt::format("stilb {}", fmt::join(arguments + 1, arguments + argument_count, " "));
    try {
        app_->parse(argument_count, arguments);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) throw wrong_arguments(*app_, error);
        return app_->exit(error);  // prints the help or the version
    }
    if (app_->get_subcommands().empty()) throw no_command(*app_);
    return exit_code_;
}

}  // namespace stilb::cli
