#include "plot/false_colour_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/image/colour_map.h"
#include "io/sample_picture.h"
#include "plot/false_colour.h"
#include "stilb/error.h"
#include "support/picture_pixels.h"
#include "support/test_folder.h"

namespace stilb::plot {
namespace {

/// Grey of 10 cd/m2, with one block of pixels (x from 10 to 19, y from 5 to 14) of `value`.
io::Picture with_block(int width, int height, float value) {
    io::Picture picture;
    picture.width = width;
    picture.height = height;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const bool inside = x >= 10 && x < 20 && y >= 5 && y < 15;
            const float grey = inside ? value : 10;
            picture.rgb_cd_m2.push_back({grey, grey, grey});
        }
    }
    return picture;
}

FalseColourOptions up_to_hundred() {
    FalseColourOptions options;
    options.minimum = 0;
    options.maximum = 100;
    return options;
}

PngPixels draw(const io::Picture& picture, const FalseColourOptions& options) {
    const TestFolder folder;
    const auto path = folder / "a.png";
    draw_false_colour(picture, "Luminance", options, path);
    return read_png(path);
}

/// Where the colour is that stands for `fraction` of the scale, left of the bar.
Spot find_value(const PngPixels& pixels, double fraction) {
    return find_colour(pixels, io::ColourMap().at(fraction), pixels.width * 85 / 100);
}

TEST(FalseColourPicture, DrawsEachPixelAsOneOfThePng) {
    const PngPixels pixels = draw(with_block(1200, 300, 60), up_to_hundred());
    const Spot block = find_value(pixels, 0.6);
    EXPECT_EQ(block.count, 100);
    const Spot rest = find_colour(pixels, io::ColourMap().at(0.1), pixels.width * 9 / 10);
    EXPECT_NEAR(rest.count, 1200 * 300, 5000);  // less the border, and a line of the bar
    EXPECT_NEAR(block.left - rest.left, 10, 1);
    EXPECT_GT(rest.y - block.y, 120);  // row 0 is at the top
}

TEST(FalseColourPicture, MagnifiesSmallPicturesSharply) {
    // 100 x 50: ten pixels of the PNG for each, as rectangles; 250 x 100: four, as an image.
    EXPECT_EQ(find_value(draw(with_block(100, 50, 60), up_to_hundred()), 0.6).count, 10000);
    EXPECT_EQ(find_value(draw(with_block(250, 100, 60), up_to_hundred()), 0.6).count, 1600);
}

TEST(FalseColourPicture, AveragesVeryLargePictures) {
    const PngPixels pixels = draw(with_block(8192, 40, 60), up_to_hundred());
    EXPECT_NEAR(find_value(pixels, 0.6).count, 25, 12);
    EXPECT_LT(pixels.width, 4600);
}

TEST(FalseColourPicture, HatchesWhatHasNoValue) {
    const PngPixels holes = draw(with_block(250, 100, NAN), up_to_hundred());
    EXPECT_GT(find_colour(holes, io::grey(0.86)).count, 800);
    EXPECT_GT(find_colour(holes, io::grey(0.62)).count, 20);
    const PngPixels whole = draw(with_block(250, 100, 50), up_to_hundred());
    EXPECT_LT(find_colour(whole, io::grey(0.86)).count, 100);  // some pixels of the writing

    io::Picture fisheye = with_block(200, 200, 10);
    fisheye.camera = io::sample_camera(Projection::fisheye);
    fisheye.camera->resolution = {200, 200};
    const PngPixels circle = draw(fisheye, up_to_hundred());
    const Spot seen = find_value(circle, 0.1);
    EXPECT_NEAR(seen.count / 25.0, 0.7854 * 200 * 200, 300);
}

TEST(FalseColourPicture, LogarithmicScaleTakesDarkPixelsToItsLowestColour) {
    FalseColourOptions options = up_to_hundred();
    options.scale = ScaleType::logarithmic;
    options.minimum = 1;
    const PngPixels pixels = draw(with_block(100, 50, 0), options);
    EXPECT_EQ(find_value(pixels, 0).count, 10000);
    EXPECT_GT(find_value(pixels, 0.5).count, 400'000);
}

TEST(FalseColourPicture, DrawsIsolinesAndNumbers) {
    io::Picture ramp;
    ramp.width = 1000;
    ramp.height = 200;
    for (int i = 0; i < 200'000; ++i) {
        const float grey = static_cast<float>(i % 1000) / 10;  // 0 to 100 cd/m2, from left to right
        ramp.rgb_cd_m2.push_back({grey, grey, grey});
    }
    FalseColourOptions options = up_to_hundred();
    const PngPixels plain = draw(ramp, options);
    options.isolines = true;
    const PngPixels lines = draw(ramp, options);
    ASSERT_EQ(plain.width, lines.width);
    // A cut in the upper quarter, above the labels: changes at multiples of 20 or 10 only.
    const Spot middle = find_colour(plain, io::ColourMap().at(0.5), plain.width * 8 / 10);
    int changed = 0;
    for (int x = int(middle.x) - 490; x < int(middle.x) + 490; ++x) {
        if (plain.at(x, int(middle.y) - 60) == lines.at(x, int(middle.y) - 60)) continue;
        ++changed;
        const double luminance = 50 + (x - middle.x) / 10;
        EXPECT_LT(std::abs(luminance - 10 * std::round(luminance / 10)), 1) << luminance;
    }
    EXPECT_GE(changed, 4 * 4);

    options.isolines = false;
    options.numbers = true;
    const PngPixels numbers = draw(ramp, options);
    ASSERT_EQ(plain.height, numbers.height);
    int written = 0;
    for (int y = 0; y < plain.height; ++y) {
        for (int x = 0; x < plain.width; ++x) written += plain.at(x, y) != numbers.at(x, y);
    }
    EXPECT_GT(written, 2000);
    EXPECT_LT(written, 40'000);
}

TEST(FalseColourPicture, EmbedsTheImageInAnSvg) {
    const TestFolder folder;
    const auto path = folder / "a.svg";
    draw_false_colour(io::sample_picture(1280, 720), "Luminance", {}, path);
    const std::string svg = read_text(path);
    EXPECT_NE(svg.find("data:image/png;base64,"), svg.npos);
    EXPECT_NE(svg.find("</svg>"), svg.npos);
    EXPECT_LT(svg.size(), 4'000'000u);
}

TEST(FalseColourPicture, DrawsPicturesWithoutAnyValue) {
    io::Picture picture = with_block(20, 10, 1);
    for (auto& rgb : picture.rgb_cd_m2) rgb = {NAN, NAN, NAN};
    FalseColourOptions options;
    options.isolines = options.numbers = true;
    EXPECT_GT(find_colour(draw(picture, options), io::grey(0.86)).count, 1000);
    EXPECT_NO_THROW(draw(io::picture_of({{1, 2, 3}}), options));
}

TEST(FalseColourPicture, SaysWhatIsWrong) {
    FalseColourOptions options = up_to_hundred();
    EXPECT_THROW(draw_false_colour(with_block(20, 20, 1), "", options, "a.jpg"), InputError);
    options.maximum = -1;
    EXPECT_THROW(draw(with_block(20, 20, 1), options), InputError);
    EXPECT_THROW(draw(io::Picture{}, options), std::invalid_argument);
}

}  // namespace
}  // namespace stilb::plot
