// Luminance pictures as files, by the ending of their names.
#pragma once

#include <filesystem>
#include <optional>

#include "io/image/picture.h"
#include "io/image/tone_curve.h"

namespace stilb::io {

/// Throws InputError where no luminance picture can be written to `path`: another extension than .exr, .hdr
/// or .png (any case), or a folder that does not exist. For a look before a long computation.
void require_luminance_picture_path(const std::filesystem::path& path);

/// Writes .exr (exr_file.h), .hdr (hdr_file.h) or .png (png_picture.h); the file changes in one step, so that
/// a viewer never sees half of it. Returns the curve of a .png, whose exposure may have been chosen. Throws
/// InputError as above and where the file cannot be written.
std::optional<ToneCurve> write_picture(const Picture& picture, const std::filesystem::path& path,
                                       const ToneOptions& tone = {});

/// Whether the file begins as an OpenEXR or Radiance picture does. Throws InputError where it cannot be read.
bool is_picture_file(const std::filesystem::path& path);

/// Reads an OpenEXR or Radiance picture, whatever its name. Throws InputError where it is neither, damaged or
/// too large.
Picture read_picture(const std::filesystem::path& path);

}  // namespace stilb::io
