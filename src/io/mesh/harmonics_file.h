// Files with surfaces by spherical harmonics: JSON with the keys of docs/fit.md.
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
    /// The coefficients of R, by harmonic_number(); as many as a degree up to kMostHarmonicDegree has.
    std::vector<double> coefficients;
    Vec3 center;
    /// The file name of the fitted mesh, and the root mean square error as a share of the mesh's size;
    /// both optional.
    std::string mesh{};
    std::optional<double> rms_error{};
};

/// Throw InputError with the file's name where it cannot be read or has wrong contents. HarmonicSurface
/// checks whether R is above 0.
HarmonicsFile read_harmonics(const std::filesystem::path& path);
HarmonicsFile parse_harmonics(std::string_view content, const std::string& name);

/// The text of the file: coefficients rounded to single precision, in the fewest digits that identify the
/// number.
std::string to_text(const HarmonicsFile& file);
/// Returns the size of the file, which is replaced in one step. Throws InputError where it cannot be written.
std::size_t write_harmonics(const HarmonicsFile& file, const std::filesystem::path& path);

}  // namespace stilb::io
