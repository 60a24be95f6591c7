#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "base/monitor.h"
#include "cli/command_line.h"
#include "cli/progress.h"
#include "papers/reproduce.h"
#include "stilb/error.h"

namespace {

using namespace stilb;

int run_commands(int argument_count, const char* const* arguments) {
    cli::CommandLine line;
    cli::add_measure(line);
    cli::add_solve(line);
    cli::add_render(line);
    cli::add_view(line);
    cli::add_fit(line);
    cli::add_info(line);
    cli::add_falsecolor(line);
    cli::add_report(line);
    cli::add_export(line);
    cli::add_import(line);
    cli::add_verify(line);
    papers::add_reproduce(line);
    line.add_help();
    return line.run(argument_count, arguments);
}

/// Whether all that was printed has arrived. Short output is written only now, so that nothing before can
/// tell.
bool is_stdout_written() { return std::fflush(stdout) == 0 && std::ferror(stdout) == 0; }

int complain_of_stdout() {
    fmt::print(stderr,
               "stilb: standard output cannot be written, so what was printed is incomplete. Check that "
               "its disk has space left and that it is open.\n");
    return cli::kExitCheckFailed;
}

}  // namespace

int main(int argument_count, char** arguments) {
    cli::leave_no_unfinished_files();
    try {
        const int exit_code = run_commands(argument_count, arguments);
        return is_stdout_written() ? exit_code : complain_of_stdout();
    } catch (const Cancelled& cancelled) {
        fmt::print(stderr, "stilb: {}\n", cancelled.what());
        return cli::kExitStoppedEarly;
    } catch (const InputError& error) {
        fmt::print(stderr, "stilb: {}\n", error.what());
        return cli::kExitWrongInput;
    } catch (const std::exception& error) {
        // A failure to print long output arrives here, with a message that does not name stdout.
        if (!is_stdout_written()) return complain_of_stdout();
        fmt::print(stderr, "stilb: {}\n", error.what());
        return cli::kExitCheckFailed;
    }
}
