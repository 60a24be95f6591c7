// Luminance pictures as files; the extension of the name selects the format.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/image/picture.h"
#include "io/image/tone_curve.h"

namespace stilb::io {

/// Throws InputError where no luminance picture can be written to `path`: for an extension other than .exr,
/// .hdr or .png (any case), and as require_output() does. `inputs`: the files that are read for the picture.
void require_luminance_picture_path(const std::filesystem::path& path,
                                    std::span<const std::filesystem::path> inputs);

/// Writes .exr, .hdr or .png. The file is replaced in one step, so
/// that a viewer never reads half of it. Returns the tone curve of a .png, whose exposure and white may have
/// been chosen automatically; the other formats keep the picture's values. Throws InputError as above and
/// where the file cannot be written.
std::optional<ToneCurve> write_picture(const Picture& picture, const std::filesystem::path& path,
                                       const ToneOptions& tone = {});

/// Whether the file begins as an OpenEXR or Radiance picture does. Throws InputError where it cannot be read.
bool is_picture_file(const std::filesystem::path& path);

/// Reads an OpenEXR or Radiance picture with any file name. Throws InputError where it is neither, damaged or
/// too large.
Picture read_picture(const std::filesystem::path& path);

// OpenEXR pictures. Only this implementation includes OpenEXR.

/// The content of a file with 32-bit floats, without loss: channels R, G, B and Y (luminance) in cd/m2, and
/// as far as the picture has them SE.Y (standard error of Y), N.X, N.Y, N.Z (normals) and Z (depth [m],
/// OpenEXR's name). The header has whiteLuminance 1 (so values are cd/m2), Rec. 709 chromaticities, and
/// header_fields() as texts.
std::string to_exr(const Picture& picture);

/// Reads R, G, B, or Y alone as grey, of any type, and the optional channels that are there. Values are
/// multiplied by whiteLuminance and converted from other chromaticities where the header has them. `name` is
/// used in messages. Throws InputError for other, damaged or truncated files.
Picture read_exr(std::string_view content, const std::string& name);

// Radiance pictures (.hdr): four bytes a pixel, three mantissas and a common exponent.
//
// The unit: Radiance's pixels are radiances in W/(sr m2), and its programs take 179 lm/W times
// 0.265 R + 0.670 G + 0.065 B (divided by EXPOSURE) for the luminance in cd/m2. pvalue, pcomb and evalglare
// do so whatever a line PRIMARIES says. Pixels are therefore written in Radiance's own primaries, with Rec.
// 709 white as its white: luminances come out right in all of them, and grey is grey. EXPOSURE is 1.

/// The content of a file: run-length encoded scanlines from the top, with header_fields() (names in
/// capitals). A component is exact to 1/256 of its pixel's largest one. Colours beyond Radiance's primaries
/// keep their luminance. Pixels of a luminance that is negative or NaN are black. Optional channels are left
/// out.
///
/// With HdrBands::as_they_are pixels stay in linear Rec. 709: for scenes of Radiance whose other colours do.
enum class HdrBands { radiance, as_they_are };
std::string to_hdr(const Picture& picture, HdrBands bands = HdrBands::radiance);

/// Reads run-length encoded scanlines of both kinds and flat ones, of rows from the top and from left to
/// right; applies EXPOSURE (all lines multiply) and PRIMARIES. `name` is used in messages. Throws InputError
/// for other formats and for truncated files.
Picture read_hdr(std::string_view content, const std::string& name);

// Tone-mapped pictures as PNG. Only this implementation includes libpng: Cairo, which draws everything else,
// cannot write text fields into a PNG.

/// The content of a file: 8-bit sRGB. Its texts are "Exposure" (per cd/m2), "Tone curve", "White" and
/// header_fields().
std::string to_png(const Picture& picture, const ToneCurve& curve);

}  // namespace stilb::io
