// The results of a run as CSV, a file per sensor.
#pragma once

#include <filesystem>

#include "run/result.h"

namespace stilb::io {

/// Writes DIR/<sensor>.csv, a line per reading; makes the folder where it is missing. Throws InputError where
/// a file cannot be written.
void write_results_csv(const RunResult& result, const std::filesystem::path& directory);

}  // namespace stilb::io
