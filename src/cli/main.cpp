#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "base/error.h"
#include "cli/commands.h"

int main(int argument_count, char** arguments) {
    CLI::App app{"Stilb: illuminance with an error bar on every number"};
    app.name("stilb");
    app.set_version_flag("--version", STILB_VERSION);
    app.require_subcommand(1);
    int exit_code = stilb::kExitDone;
    try {
        stilb::add_measure(app, exit_code);
        stilb::add_falsecolor(app, exit_code);
        app.parse(argument_count, arguments);
        return exit_code;
    } catch (const CLI::ParseError& error) {
        const int code = app.exit(error);
        return code == 0 ? stilb::kExitDone : stilb::kExitWrongInput;
    } catch (const stilb::InputError& error) {
        fmt::print(stderr, "stilb: {}\n", error.what());
        return stilb::kExitWrongInput;
    } catch (const std::exception& error) {
        fmt::print(stderr, "stilb: {}\n", error.what());
        return stilb::kExitCheckFailed;
    }
}
