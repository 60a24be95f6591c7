// What the commands `measure` and `merge` have in common.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/outputs.h"
#include "io/results/run_file.h"
#include "run/result.h"

namespace stilb::cli {

/// The flags of the files with readings.
struct ReadingFiles {
    /// Where JSON goes: "-" is standard output, which then gets no table.
    std::optional<std::string> json;
    std::string output, csv_directory, picture;
    bool has_replicates = false;

    void add_to(Command& command);
    /// Where the JSON document is written, "-" for standard output.
    std::vector<std::string> json_files() const;
    /// Throws InputError where one of them cannot be written.
    void check(std::span<const Sensor> sensors, std::span<const std::filesystem::path> inputs) const;
    /// `scene`: its name in the files.
    void write(const RunResult& result, const std::string& scene, Outputs& outputs) const;
};

/// The flags by which the result of stored sums is shown.
struct ShowFlags {
    ReadingFiles files;
    bool checks = false, quiet = false;
    LightScene dimmed = {};  ///< by its factors, if there are any
};
/// Shows the result of the sums of a state file, without more samples. `name`: of the file, which messages
/// name. Returns the exit code.
int show_stored(const io::StoredRun& stored, const std::string& name, const ShowFlags& flags);

}  // namespace stilb::cli
