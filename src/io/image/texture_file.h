// Textures of surfaces: JPEG, PNG, TGA, BMP and GIF. Only this implementation includes stb_image.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stilb::io {

/// Eight bits for each of red, green, blue and alpha, as the file stores them.
struct Texture {
    int width = 0, height = 0;
    std::vector<std::array<std::uint8_t, 4>> texels;  ///< row by row from the top, from left to right

    /// The texel at a position in the picture, both from 0 to 1, v from the top.
    const std::array<std::uint8_t, 4>& at(double u, double v) const;
};

/// Whether the alpha of nearly all texels is nearly 0 or 1, and of some nearly 0: it cuts holes, as of leaves
/// and grilles.
bool has_holes(const Texture& texture);

/// `name` is used in messages. Throws InputError for other formats, and damaged or too large files.
Texture read_texture(std::string_view content, const std::string& name);

/// A stored value as a share of light: the inverse of the tone curve of sRGB (IEC 61966-2-1).
double linear_of_srgb(std::uint8_t value);

}  // namespace stilb::io
