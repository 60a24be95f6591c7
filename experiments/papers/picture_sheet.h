// Pictures beside each other on one sheet, with a line of text below each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/image/picture.h"
#include "io/image/tone_curve.h"

namespace stilb::papers {

struct LabelledPicture {
    std::string label;
    io::Picture picture;
};

/// Writes a .png or .svg: rows of `columns` pictures, all of one size and by one curve, each pixel a pixel of
/// the .png. Throws InputError where it cannot be written.
void draw_picture_sheet(const std::vector<LabelledPicture>& pictures, std::size_t columns,
                        const io::ToneCurve& curve, const std::filesystem::path& path);

}  // namespace stilb::papers
