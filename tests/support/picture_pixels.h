// PngPixels of a PNG file, for tests of what was drawn.
#pragma once

#include <cairo/cairo.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "io/image/tone_curve.h"

namespace stilb {

struct PngPixels {
    int width = 0, height = 0;
    std::vector<std::uint32_t> rgb;  // row by row from the top, 0xRRGGBB

    std::uint32_t at(int x, int y) const {
        return rgb[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                   static_cast<std::size_t>(x)];
    }
};

inline PngPixels read_png(const std::filesystem::path& path) {
    cairo_surface_t* surface = cairo_image_surface_create_from_png(path.c_str());
    EXPECT_EQ(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS) << path;
    PngPixels pixels{cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), {}};
    for (int y = 0; y < pixels.height; ++y) {
        const unsigned char* row = cairo_image_surface_get_data(surface) +
                                   std::ptrdiff_t{y} * cairo_image_surface_get_stride(surface);
        for (int x = 0; x < pixels.width; ++x) {
            std::uint32_t value;
            std::memcpy(&value, row + 4 * x, 4);
            pixels.rgb.push_back(value & 0xffffff);
        }
    }
    cairo_surface_destroy(surface);
    return pixels;
}

/// How many pixels have this colour to within the rounding of its components, and their centre of mass.
struct Spot {
    int count = 0;
    double x = 0, y = 0;
    int left = 1 << 30, right = -1;
};

inline Spot find_colour(const PngPixels& pixels, const io::Colour& colour, int x_end = 1 << 30) {
    const auto close = [](std::uint32_t byte, double component) {
        return std::abs(double(byte & 0xff) - 255 * component) <= 1;
    };
    Spot spot;
    for (int y = 0; y < pixels.height; ++y) {
        for (int x = 0; x < std::min(pixels.width, x_end); ++x) {
            const std::uint32_t rgb = pixels.at(x, y);
            if (!close(rgb >> 16, colour.red) || !close(rgb >> 8, colour.green) || !close(rgb, colour.blue))
                continue;
            ++spot.count;
            spot.x += x;
            spot.y += y;
            spot.left = std::min(spot.left, x);
            spot.right = std::max(spot.right, x);
        }
    }
    if (spot.count > 0) {
        spot.x /= spot.count;
        spot.y /= spot.count;
    }
    return spot;
}

inline std::string read_text(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace stilb
