// Solution files. docs/solution.md describes the format byte by byte.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "estimators/patch_light/solution/patch_solution.h"
#include "io/scene/scene_file.h"
#include "run/result.h"

namespace stilb::io {

struct StoredSolution {
    std::string version;     ///< of Stilb
    std::string scene;       ///< the scene's file, relative to the folder of the solution file
    std::string light_hash;  ///< of the scene (io/text/text.h)
    std::uint64_t seed = 0;
    std::uint64_t steps = 0;    ///< of all walks together
    double attained_error = 0;  ///< as SolveResult has it
    estimators::PatchSolution solution;
};

/// The content of a file at `path` with the solution of a scene.
StoredSolution stored_solution(const RunSummary& run, estimators::PatchSolution solution,
                               const SceneFile& scene, const std::filesystem::path& path);

/// Throws InputError, which names the solution's file, where the scene's light is not the one that was
/// solved.
void require_same_light(const StoredSolution& stored, const SceneFile& scene,
                        const std::string& solution_file);

std::string to_bytes(const StoredSolution& stored);
/// Throws InputError, with the name, where the bytes are not a solution, of another version, truncated or
/// damaged. require_consistency() checks whether the parts fit a scene.
StoredSolution read_solution(std::string_view bytes, const std::string& name);

/// Throw InputError as above, and where the file cannot be read or written. The file is replaced in one step;
/// its size is returned.
StoredSolution read_solution_file(const std::filesystem::path& path);
std::size_t write_solution_file(const StoredSolution& stored, const std::filesystem::path& path);

/// A file with these contents, before compression: for the fuzz target, whose contents are arbitrary.
std::string solution_file_of(std::string_view contents);

}  // namespace stilb::io
