// Radiance pictures (.hdr): four bytes a pixel, three mantissas and a common exponent.
//
// The unit: Radiance's pixels are radiances in W/(sr m2), and its programs take 179 lm/W times
// 0.265 R + 0.670 G + 0.065 B (divided by EXPOSURE) for the luminance in cd/m2. pvalue, pcomb and evalglare
// do so whatever a line PRIMARIES says. Pixels are therefore written in Radiance's own primaries, with Rec.
// 709 white as its white: luminances come out right in all of them, and grey is grey. EXPOSURE is 1.
#pragma once

#include <string>
#include <string_view>

#include "io/image/picture.h"

namespace stilb::io {

/// The file's content: run-length encoded scanlines from the top, with header_fields() (names in capitals).
/// A component is exact to 1/256 of its pixel's largest one. Colours beyond Radiance's primaries keep their
/// luminance. Pixels of a luminance that is negative or NaN are black. Optional channels are left out.
std::string to_hdr(const Picture& picture);

/// Reads run-length encoded scanlines of both kinds and flat ones, of rows from the top and from left to
/// right; honours EXPOSURE (all lines multiply) and PRIMARIES. `name` is used in messages. Throws InputError
/// for whatever else, and for what is truncated.
Picture read_hdr(std::string_view content, const std::string& name);

}  // namespace stilb::io
