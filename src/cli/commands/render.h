// What the commands `render` and `merge` have in common.
#pragma once

#include <string>

#include "io/results/run_file.h"

namespace stilb::cli {

/// Writes the picture of the sums of a state file, without more passes. `name`: of the file, which messages
/// name; `output`: of the picture. Returns the exit code.
int show_stored_picture(const io::StoredRun& stored, const std::string& name, const std::string& output,
                        bool is_quiet);

}  // namespace stilb::cli
