#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "base/monitor.h"
#include "cli/command_line.h"
#include "cli/progress.h"
#include "papers/reproduce.h"
#include "stilb/error.h"

int main(int argument_count, char** arguments) {
    using namespace stilb;
    cli::leave_no_unfinished_files();
    try {
        cli::CommandLine line;
        cli::add_measure(line);
        cli::add_solve(line);
        cli::add_render(line);
        cli::add_fit(line);
        cli::add_info(line);
        cli::add_falsecolor(line);
        cli::add_verify(line);
        papers::add_reproduce(line);
        return line.run(argument_count, arguments);
    } catch (const Cancelled& cancelled) {
        fmt::print(stderr, "stilb: {}\n", cancelled.what());
        return cli::kExitStoppedEarly;
    } catch (const InputError& error) {
        fmt::print(stderr, "stilb: {}\n", error.what());
        return cli::kExitWrongInput;
    } catch (const std::exception& error) {
        fmt::print(stderr, "stilb: {}\n", error.what());
        return cli::kExitCheckFailed;
    }
}
