// The commands, one file each. Each add_... declares its command with flags and examples; once the line is
// parsed, the chosen command runs and returns the exit code. Errors in the input are thrown (InputError);
// main prints them and exits with kExitWrongInput.
#pragma once

#include "cli/command_line.h"

namespace stilb::cli {

void add_measure(CommandLine& line);
void add_solve(CommandLine& line);
void add_render(CommandLine& line);
void add_fit(CommandLine& line);
void add_info(CommandLine& line);
void add_falsecolor(CommandLine& line);
void add_verify(CommandLine& line);

}  // namespace stilb::cli
