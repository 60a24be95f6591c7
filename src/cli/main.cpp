#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "base/monitor.h"
#include "cli/command_line.h"
#include "cli/progress.h"
#include "papers/reproduce.h"
#include "stilb/error.h"

namespace {

using namespace stilb;

int run_commands(const std::vector<std::string>& arguments) {
    cli::CommandLine line;
    cli::add_measure(line);
    cli::add_resume(line, run_commands);
    cli::add_merge(line);
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
    cli::add_patch_topic(line);
    line.add_help();
    std::vector<const char*> texts;
    for (const std::string& argument : arguments) texts.push_back(argument.c_str());
    return line.run(static_cast<int>(texts.size()), texts.data());
}

/// Whether all that was printed has arrived. Short output is written only now, so that nothing before can
/// tell.
bool is_stdout_written() { return std::fflush(stdout) == 0 && std::ferror(stdout) == 0; }

/// Whether stdout is a pipe whose reader has gone, as `head` does after its lines.
bool has_stdout_no_reader() {
    pollfd output{STDOUT_FILENO, POLLOUT, 0};
    return poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

int complain_of_stdout() {
    if (has_stdout_no_reader()) {
        std::signal(SIGPIPE, SIG_DFL);
        std::raise(SIGPIPE);  // the usual end, without a message: the reader has what it wanted
    }
    cli::print_failure(
        "standard output cannot be written, so what was printed is incomplete. Check that its disk has space "
        "left and that it is open.");
    return cli::kExitCheckFailed;
}

/// Without stdin, stdout or stderr, the next file that is opened would take its number, and what is printed
/// would go into that file. Messages are lost where stderr is closed; what goes to a closed stdout fails when
/// it is written.
void occupy_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        const bool is_closed = fcntl(stream, F_GETFD) == -1 && errno == EBADF;
        // The lowest free number is the stream's own, because those below it are taken.
        if (is_closed) open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
    }
}

/// A run goes on, and writes its files, where the reader of its messages or of its first lines has gone.
void outlive_readers() {
    std::signal(SIGPIPE, [](int) {});  // not SIG_IGN, which a browser that is started would inherit
}

}  // namespace

int main(int argument_count, char** arguments) {
    occupy_closed_streams();
    outlive_readers();
    cli::leave_no_unfinished_files();
    try {
        const int exit_code = run_commands({arguments, arguments + argument_count});
        return is_stdout_written() ? exit_code : complain_of_stdout();
    } catch (const Cancelled& cancelled) {
        cli::print_failure(cancelled.what());
        return cli::kExitStoppedEarly;
    } catch (const InputError& error) {
        cli::print_failure(error.what());
        return cli::kExitWrongInput;
    } catch (const std::exception& error) {
        // A failure to print long output arrives here, with a message that does not name stdout.
        if (!is_stdout_written()) return complain_of_stdout();
        cli::print_failure(error.what());
        return cli::kExitCheckFailed;
    }
}
