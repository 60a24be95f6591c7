#include "cli/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
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
        return app_->exit(error) == 0 ? kExitDone : kExitWrongInput;
    }
    if (app_->get_subcommands().empty()) throw no_command(*app_);
    return exit_code_;
}

}  // namespace stilb::cli
