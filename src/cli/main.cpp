#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/monitor.h"
#include "cli/commands.h"
#include "papers/reproduce.h"

namespace {

stilb::InputError no_command(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    const std::string all = fmt::format("Commands: {}. stilb --help says more.", fmt::join(names, ", "));
    const std::vector<std::string> extras = app.remaining();
    if (extras.empty()) return stilb::InputError("a command is missing. " + all);
    const std::string nearest =
        stilb::nearest_name(extras[0], std::vector<std::string_view>(names.begin(), names.end()));
    const std::string question = nearest.empty() ? "" : fmt::format(" Did you mean \"{}\"?", nearest);
    return stilb::InputError(fmt::format("there is no command \"{}\".{} {}", extras[0], question, all));
}

std::string command_line(int argument_count, char** arguments) {
    const std::vector<std::string> words(arguments + 1, arguments + argument_count);
    return fmt::format("stilb {}", fmt::join(words, " "));
}

}  // namespace

int main(int argument_count, char** arguments) {
    CLI::App app{"Stilb: illuminance and luminance with an error bar on every number"};
    app.name("stilb");
    app.set_version_flag("--version", STILB_VERSION);
    app.require_subcommand(0, 1);
    int exit_code = stilb::cli::kExitDone;
    try {
        stilb::cli::add_measure(app, exit_code);
        stilb::cli::add_solve(app, exit_code);
        stilb::cli::add_render(app, command_line(argument_count, arguments), exit_code);
        stilb::cli::add_fit(app, exit_code);
        stilb::cli::add_info(app, exit_code);
        stilb::cli::add_falsecolor(app, exit_code);
        stilb::cli::add_verify(app, exit_code);
        stilb::papers::add_reproduce(app, exit_code);
        app.allow_extras();  // for an unknown command's own message; the commands take none
        app.parse(argument_count, arguments);
        if (app.get_subcommands().empty()) throw no_command(app);
        return exit_code;
    } catch (const CLI::ParseError& error) {
        const int code = app.exit(error);
        return code == 0 ? stilb::cli::kExitDone : stilb::cli::kExitWrongInput;
    } catch (const stilb::Cancelled& cancelled) {
        fmt::print(stderr, "stilb: {}\n", cancelled.what());
        return stilb::cli::kExitStoppedEarly;
    } catch (const stilb::InputError& error) {
        fmt::print(stderr, "stilb: {}\n", error.what());
        return stilb::cli::kExitWrongInput;
    } catch (const std::exception& error) {
        fmt::print(stderr, "stilb: {}\n", error.what());
        return stilb::cli::kExitCheckFailed;
    }
}
