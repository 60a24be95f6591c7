// The results of a run as a JSON document (docs/json.md) and as CSV.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "run/result.h"

namespace stilb::io {

/// Whether each reading is written with its values in all replicates.
enum class ReplicateValues { left_out, written };

/// The document in parts that follow each other: that of half a million readings has 100 megabytes. `scene`
/// is the scene file as the user named it. Two runs with the same results give the same text except for
/// elapsed_s and first_shot_set_up_s.
std::vector<std::string> json_parts(const RunResult& result, const std::string& scene,
                                    ReplicateValues replicates);

/// The same as a whole, without the replicates.
std::string to_json(const RunResult& result, const std::string& scene);

// The results of a run as CSV, a file per sensor.

/// Creates the folder where it is missing. Throws InputError where write_results_csv could not write there.
/// For a check before a long computation.
void prepare_results_csv(std::span<const Sensor> sensors, const std::filesystem::path& directory);

/// Writes DIR/<sensor>.csv, a line per reading; creates the folder where it is missing. Throws InputError
/// where a file cannot be written.
void write_results_csv(const RunResult& result, const std::filesystem::path& directory);

}  // namespace stilb::io
