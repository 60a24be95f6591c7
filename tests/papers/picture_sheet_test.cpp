#include "papers/picture_sheet.h"

#include <gtest/gtest.h>

#include "support/picture_pixels.h"
#include "support/test_folder.h"

namespace stilb::papers {
namespace {

LabelledPicture plain(const std::array<float, 3>& rgb_cd_m2) {
    LabelledPicture labelled;
    labelled.label = "label";
    labelled.picture.width = 40, labelled.picture.height = 20;
    labelled.picture.rgb_cd_m2.assign(800, rgb_cd_m2);
    return labelled;
}

TEST(PictureSheet, ShowsEveryPixelByOneCurve) {
    const TestFolder folder;
    const auto path = folder / "a.png";
    const io::ToneCurve curve(0.1);
    const std::array<std::array<float, 3>, 3> colours{{{1, 1, 5}, {4, 1, 1}, {9, 9, 2}}};
    draw_picture_sheet({plain(colours[0]), plain(colours[1]), plain(colours[2])}, 2, curve, path);
    const PngPixels pixels = read_png(path);
    std::vector<Spot> spots;
    for (const auto& colour : colours) {
        const auto [red, green, blue] = curve.srgb(colour);
        spots.push_back(find_colour(pixels, {red / 255., green / 255., blue / 255.}));
        EXPECT_EQ(spots.back().count, 800);
    }
    EXPECT_GT(spots[1].left, spots[0].right);  // two columns
    EXPECT_GT(spots[2].y, spots[0].y + 20);    // two rows
    EXPECT_NEAR(spots[2].x, spots[0].x, 1);
}

}  // namespace
}  // namespace stilb::papers
