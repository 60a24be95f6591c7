// Surfaces by spherical harmonics on disk: JSON, docs/fit.md has its keys.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"

namespace stilb::io {

/// The surface |x - center| = R((x - center) / |x - center|).
struct HarmonicsFile {
    /// Of R, by harmonic_number(); as many as a degree up to kMostHarmonicDegree has.
    std::vector<double> coefficients;
    Vec3 center;
    /// What it was made of, and its root mean square error as a share of the mesh's size;
    /// not needed.
    std::string mesh{};
    std::optional<double> rms_error{};
};

/// Throw InputError naming the file, and what is wrong with it or that it cannot be read. Whether R is above
/// 0 is for HarmonicSurface to say.
HarmonicsFile read_harmonics(const std::filesystem::path& path);
HarmonicsFile parse_harmonics(std::string_view content, const std::string& name);

/// The file's text: coefficients rounded to single precision, in the fewest digits that tell it.
std::string to_text(const HarmonicsFile& file);
/// Throws InputError where the file cannot be written; it changes in one step.
void write_harmonics(const HarmonicsFile& file, const std::filesystem::path& path);

}  // namespace stilb::io
