// The figures of the papers. Each function computes one anew and writes its files into the folder, which
// exists. docs/reproduce.md says what they show and what was chosen.
#pragma once

#include <filesystem>
#include <string>

#include "cli/command_line.h"

namespace stilb::papers {

/// [LocalEstimation], figure 4.
void reproduce_sobolev(const std::filesystem::path& directory);
/// [LocalEstimation], figure 5.
void reproduce_room(const std::filesystem::path& directory);
/// [LocalEstimation], figure 6.
void reproduce_polar(const std::filesystem::path& directory);
/// [LocalEstimation], figure 5, with the head as series of spherical harmonics, and what they cost. `mesh` is
/// an OBJ or PLY file of another head; empty: the program's own.
void reproduce_harmonics(const std::filesystem::path& directory, const std::string& mesh);
/// [FirstShot], figure 6.
void reproduce_first_shot(const std::filesystem::path& directory);
/// No figure of a paper: why three directions make a step.
void reproduce_directions(const std::filesystem::path& directory);

/// Declares the command `reproduce`.
void add_reproduce(cli::CommandLine& line);

}  // namespace stilb::papers
