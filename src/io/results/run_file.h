// State files of runs (.run): what a run was asked for, and its sums so far. docs/runs.md describes the
// format.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "io/scene/scene_file.h"
#include "run/options.h"
#include "run/plan.h"
#include "run/result.h"
#include "sensors/sensor.h"

namespace stilb::io {

/// What the samples of a run depend on: "scene" and its hash, "seed" and its number.
struct RunTrait {
    std::string name, value;

    bool operator==(const RunTrait&) const = default;
};
using RunTraits = std::vector<RunTrait>;

/// Those of runs of readings and pictures of a scene. Limits, threads and requirements are none of them.
RunTraits traits_of(const SceneFile& scene, std::span<const Sensor> sensors, const RunOptions& options);

/// Sets the hashes of a result, by which two results are known to be of the same scene and sensors.
void add_hashes(const SceneFile& scene, RunResult& result);

/// What a state file says of its run.
struct RunOrigin {
    std::string version;                 ///< of Stilb
    std::string command;                 ///< "measure", "render" ...
    std::vector<std::string> arguments;  ///< of the command, without those of the state file
    std::string folder;                  ///< where it was given, relative to that of the state file
    RunTraits traits;
    double elapsed_s = 0;  ///< of all that have added samples
    std::string ending;    ///< why it ended (run::StopReason); empty while it runs
};

/// The name of the sums of readings.
inline constexpr std::string_view kReadingSums = "readings";
/// That of the sums of a camera's picture.
std::string sums_of_picture(const Sensor& camera);

/// The sums of one result of a run.
struct StoredSums {
    std::string name;  ///< kReadingSums, "solution", or that of a picture's camera
    std::string bytes;
};

/// Gives the result of stored sums the time and the ending of their run; one that goes on counts as
/// interrupted.
void set_ending(const RunOrigin& origin, run::RunSummary& result);
/// Whether the run has ended with nothing left to do at its limits.
bool is_finished(const RunOrigin& origin);

struct StoredRun {
    RunOrigin origin;
    std::vector<StoredSums> sums;
};

/// Throws InputError, which names the file, where a run of these traits cannot continue the stored one: the
/// message names what differs.
void require_same_run(const RunOrigin& stored, const RunTraits& traits, const std::string& name);

/// The same where the samples of a run are to be added to those of the stored one, which may have another
/// seed.
void require_mergeable(const RunOrigin& stored, const RunTraits& traits, const std::string& name);

/// The folder in which the run of a state file was begun; and as the state file of this name states it.
std::filesystem::path folder_of(const RunOrigin& origin, const std::filesystem::path& state_file);
std::string relative_folder(const std::filesystem::path& folder, const std::filesystem::path& state_file);

/// The bytes of sums: of RunState, PictureSums or SolutionState.
template <typename Sums>
std::string sums_of(const Sums& sums) {
    ByteWriter bytes;
    sums.write(bytes);
    return bytes.take();
}
/// The sums of this name. Throws InputError where the file has none, or they are damaged.
template <typename Sums>
Sums read_sums(const StoredRun& stored, std::string_view name, const std::string& file);

std::string to_bytes(const StoredRun& stored);
/// Throw InputError, with the name, where the bytes are not a state file, of another version, truncated or
/// damaged.
StoredRun read_run(std::string_view bytes, const std::string& name);
RunOrigin read_run_origin(std::string_view bytes, const std::string& name);

StoredRun read_run_file(const std::filesystem::path& path);
/// The file is replaced in one step. Throws InputError where it cannot be written.
void write_run_file(const StoredRun& stored, const std::filesystem::path& path);

}  // namespace stilb::io
