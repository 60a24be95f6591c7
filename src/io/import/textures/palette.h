// Few colours in place of many.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/rgb.h"

namespace stilb::io {

struct WeightedColour {
    Rgb rgb;
    double weight = 1;  ///< above 0
};

struct Palette {
    std::vector<Rgb> colours;              ///< from dark to bright
    std::vector<std::uint32_t> colour_of;  ///< for each given colour, its colour in the palette
};

/// At most `most` colours, fewer where they represent the given ones to 0.001. Each is the weighted mean of
/// the given ones that it stands for, so that the mean of all of them is kept.
Palette make_palette(std::span<const WeightedColour> given, std::size_t most);

}  // namespace stilb::io
