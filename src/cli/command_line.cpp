#include "cli/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>

#include "base/version.h"
#include "io/text/text.h"
#include "run/options.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

bool is_flag(std::string_view argument) { return argument.starts_with('-'); }

/// The message where a command is missing (`typed` is empty) or unknown.
/// `topics`: other names that may be meant.
InputError no_command(const CLI::App& app, const std::string& typed,
                      const std::vector<std::string>& topics = {}) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    const std::string all = fmt::format("Commands: {}. See stilb --help.", fmt::join(names, ", "));
    if (typed.empty()) return InputError("a command is missing. " + all);
    names.insert(names.end(), topics.begin(), topics.end());
    const std::string question =
        did_you_mean(typed, std::vector<std::string_view>(names.begin(), names.end()));
    return InputError(fmt::format("there is no command \"{}\".{} {}", typed, question, all));
}

/// The first argument in the order typed that no flag or position takes, a flag without its "=VALUE"; empty
/// where there is none.
std::string first_extra(const CLI::App& app) {
    const std::vector<std::string> extras = app.remaining();
    const auto first = std::ranges::find_if(extras, [](const std::string& e) { return e != "--"; });
    if (first == extras.end()) return "";
    return is_flag(*first) ? first->substr(0, first->find('=')) : *first;
}

/// "there is no flag --eror. Did you mean "--error"?"
std::string no_flag(const std::string& typed, const CLI::App& app) {
    std::vector<std::string> flags;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) flags.push_back("--" + name);
    }
    return fmt::format("there is no flag {}.{}", typed,
                       did_you_mean(typed, std::vector<std::string_view>(flags.begin(), flags.end())));
}

/// The message for an argument before the command.
std::string refusal_outside(const std::string& extra, const CLI::App& command) {
    if (!is_flag(extra)) {
        return fmt::format("\"{}\" is one argument too many. Arguments follow the name of the command, {}.",
                           extra, command.get_name());
    }
    if (command.get_option_no_throw(extra) == nullptr) return no_flag(extra, command);
    return fmt::format("{0} stands before the command. Write it after the command: stilb {1} ... {0}", extra,
                       command.get_name());
}

/// "--degree N", or "SCENE" for an argument.
std::string with_value_name(const CLI::Option& option) {
    const std::string name = option.get_name();
    const std::string value = option.get_type_name();  // followed by ":" and the range
    return is_flag(name) ? fmt::format("{} {}", name, value.substr(0, value.find(':'))) : name;
}

/// The text with a small first letter, unless its second one is large, too.
std::string in_mid_sentence(std::string text) {
    if (text.size() > 1 && std::islower(static_cast<unsigned char>(text[1])) != 0)
        text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
    return text;
}

/// The message where a flag that takes one value has none or several, or where a required one is missing.
std::string wrong_count(const CLI::App& command, const CLI::ParseError& error) {
    std::string message = error.what();
    for (const CLI::Option* option : command.get_options()) {
        const std::string name = option->get_name();
        const std::size_t values = option->results().size();
        if (option->get_required() && option->count() == 0 && message.starts_with(name + " ")) {
            return fmt::format("{} is missing. It gives the {}.", with_value_name(*option),
                               in_mid_sentence(option->get_description()));
        }
        if (option->get_items_expected_max() == 0 && message.find(name + " = ") != std::string::npos)
            return fmt::format("{} takes no value. Leave out \"={}\".", name, option->results().front());
        if (!message.starts_with(name + ":")) continue;
        if (values > 1) return fmt::format("{} is given {} times. Give it once.", name, values);
        return fmt::format("{} needs a value: {}.", name, with_value_name(*option));
    }
    return message;
}

/// The beginning of a message about a value: CLI11 does not name hidden flags.
std::string missing_name(const CLI::Option& option) {
    return option.get_group().empty() ? fmt::format("--{}: ", option.get_lnames().front()) : "";
}

/// The message for the arguments of a command. It names an unknown argument first, if there is one.
std::string refusal(const CLI::App& app, const CLI::App& command, const CLI::ParseError& error) {
    if (const std::string extra = first_extra(app); !extra.empty()) return refusal_outside(extra, command);
    const std::string extra = first_extra(command);
    if (extra.empty()) {
        const bool is_of_value = dynamic_cast<const CLI::ValidationError*>(&error) != nullptr;
        if (!is_of_value) return wrong_count(command, error);
        const std::string_view message = error.what();
        return std::string(message.substr(message.starts_with(": ") ? 2 : 0));
    }
    return is_flag(extra) ? no_flag(extra, command) : fmt::format("\"{}\" is one argument too many", extra);
}

/// The message where the arguments cannot be used.
InputError wrong_arguments(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<CLI::App*> commands = app.get_subcommands();
    std::string problem, program = "stilb";
    if (!commands.empty()) {
        problem = refusal(app, *commands.front(), error);
        program += " " + commands.front()->get_name();
    } else if (const std::string extra = first_extra(app); is_flag(extra)) {
        problem = no_flag(extra, app);
    } else if (!extra.empty()) {
        return no_command(app, extra);
    } else {
        problem = error.what();
    }
    const bool is_sentence = problem.ends_with('.') || problem.ends_with('?');
    return InputError(fmt::format("{}{} See {} --help.", problem, is_sentence ? "" : ".", program));
}

/// Rewrites a whole number such as "1e4", which scene files take too, in digits. Returns a message where it
/// is not whole, or else an empty text.
std::string write_in_digits(std::string& typed) {
    if (const auto integer = io::parse_integer(typed)) {
        typed = fmt::format("{}", *integer);
        return "";
    }
    const auto number = io::parse_number(typed);
    if (!number || *number != std::floor(*number)) {
        return fmt::format("{} is not a whole number. Write it as 20000 or 2e4, for example.",
                           io::in_quotes(typed));
    }
    constexpr double kLargestExact = 9007199254740992.0;  // 2^53
    if (std::abs(*number) > kLargestExact) {
        return fmt::format("{} is not exact, because it is larger than 2^53. Write all of its digits.",
                           io::in_quotes(typed));
    }
    typed = fmt::format("{:.0f}", *number);
    return "";
}

/// Returns a message where the text is not a number, or else an empty text.
std::string require_number(std::string& typed) {
    if (io::parse_number(typed)) return "";
    return fmt::format("{} is not a number. Write it as 20 or 0.25, for example.", io::in_quotes(typed));
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
    // Ranges without a meaning for the user are not in --help.
    constexpr std::int64_t greatest_shown = 10'000;
    option_->check(CLI::Validator(
        [least, greatest, option = option_](const std::string& typed) -> std::string {
            const auto number = io::parse_integer(typed);
            if (number && *number >= least && *number <= greatest) return "";
            return fmt::format("{}{} is out of range. Give a whole number from {} to {}.",
                               missing_name(*option), typed, least, greatest);
        },
        greatest <= greatest_shown ? fmt::format("{} to {}", least, greatest) : ""));
    return *this;
}
Flag& Flag::within(const Range& range) {
    option_->check(CLI::Validator(
        [range](const std::string& typed) -> std::string {
            const double number = io::parse_number(typed).value_or(std::numeric_limits<double>::quiet_NaN());
            return range.contains(number) ? "" : refusal(number, range);
        },
        ""));
    return *this;
}
Flag& Flag::share(const Range& range) {
    option_->transform(CLI::Validator(
        [range](std::string& typed) -> std::string {
            const auto share = run::parse_relative_error(typed);
            if (!share) return fmt::format("{} is not allowed. Allowed: {}.", typed, range.allowed);
            typed = fmt::format("{}", *share);
            return "";
        },
        ""));
    return within(range);
}
Flag& Flag::one_of(std::span<const std::string_view> names) {
    option_->check(CLI::Validator(
        [names, option = option_](const std::string& typed) -> std::string {
            if (std::ranges::find(names, typed) != names.end()) return "";
            return fmt::format("{}{} is not allowed.{} Allowed: {}.", missing_name(*option),
                               io::in_quotes(typed), did_you_mean(typed, names), fmt::join(names, ", "));
        },
        ""));
    return *this;
}
Flag& Flag::above_zero() {
    option_->check(CLI::Validator(
        [](const std::string& typed) -> std::string {
            const auto number = io::parse_number(typed);
            if (number && *number > 0) return "";
            return fmt::format("{} is out of range. Give a number above 0.", typed);
        },
        ""));
    return *this;
}
Flag& Flag::repeatable() {
    option_->expected(1)->take_all()->allow_extra_args(false);
    return *this;
}
Flag& Flag::optional_value(const std::string& otherwise) {
    option_->expected(0, 1)->default_str(otherwise);
    return *this;
}
Flag& Flag::hidden() { return heading(""); }

bool Flag::is_given() const { return option_->count() > 0; }
std::string Flag::name() const { return "--" + option_->get_lnames().front(); }

void Command::set_footer(const std::string& text) { app_->footer(text); }

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
        using Value = typename decltype(std::optional{value})::value_type;
        CLI::Option* const option = app_->add_option(names, value, description);
        if constexpr (std::is_integral_v<Value>) option->transform(CLI::Validator(write_in_digits, ""));
        if constexpr (std::is_floating_point_v<Value>) option->transform(CLI::Validator(require_number, ""));
        return Flag(*option);
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
    app_->set_version_flag("-V,--version", program_version());
    app_->require_subcommand(0, 1);
}

CommandLine::~CommandLine() = default;

Command CommandLine::add_command(const std::string& name, const std::string& summary) {
    return Command(*app_->add_subcommand(name, summary), exit_code_);
}

void CommandLine::add_help() {
    Command command = add_command("help", "Print this help, that of a command, or of the flags of patches");
    command.set_examples(
        "  stilb help\n"
        "  stilb help measure\n"
        "  stilb help patches\n");
    auto name = std::make_shared<std::string>();
    command.add("COMMAND", *name, "Command or topic to explain (default: all in short)");
    command.run([this, name] {
        print_help(*name);
        return kExitDone;
    });
}

Command CommandLine::add_topic(const std::string& name, const std::string& text) {
    CLI::App& topic = *topics_.emplace_back(std::make_unique<CLI::App>("", name));
    topic.set_help_flag();
    topic.formatter_fn([text](const CLI::App* app, const std::string&, CLI::AppFormatMode mode) {
        return text + "\n" + CLI::Formatter().make_groups(app, mode);
    });
    return Command(topic, exit_code_);
}

void CommandLine::print_help(const std::string& command) const {
    const CLI::App* about = app_.get();
    std::string program = "stilb";
    const auto topic = std::ranges::find(topics_, command, [](const auto& t) { return t->get_name(); });
    if (topic != topics_.end()) {
        about = topic->get();
    } else if (!command.empty()) {
        const auto named = app_->get_subcommands([&](CLI::App* c) { return c->get_name() == command; });
        if (named.empty()) {
            std::vector<std::string> topics;
            for (const auto& own : topics_) topics.push_back(own->get_name());
            throw no_command(*app_, command, topics);
        }
        about = named.front();
        program += " " + command;
    }
    fmt::print("{}", about->get_formatter()->make_help(about, program, CLI::AppFormatMode::Normal));
}

int CommandLine::run(int argument_count, const char* const* arguments) {
    text_ = fmt::format("stilb {}", fmt::join(arguments + 1, arguments + argument_count, " "));
    if (argument_count > 2) arguments_.assign(arguments + 2, arguments + argument_count);
    try {
        app_->parse(argument_count, arguments);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) throw wrong_arguments(*app_, error);
        return app_->exit(error);  // prints the help or the version
    }
    if (app_->get_subcommands().empty()) throw no_command(*app_, "");
    return exit_code_;
}

}  // namespace stilb::cli
