#include "io/image/tone_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/sample_picture.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

using Bytes = std::array<std::uint8_t, 3>;

TEST(ToneCurve, IsMonotoneFromBlackToWhite) {
    const ToneCurve curve(0.01);
    EXPECT_EQ(curve.display_luminance(0), 0);
    double last = 0;
    for (double luminance = 1e-6; luminance < 1e6; luminance *= 1.01) {
        const double shown = curve.display_luminance(luminance);
        EXPECT_GE(shown, last);
        EXPECT_LE(shown, 1);
        last = shown;
    }
    EXPECT_EQ(last, 1);
    EXPECT_NEAR(curve.display_luminance(799.999), 1, 1e-5);  // no step at white
    EXPECT_NEAR(curve.display_luminance(1e-3), 1e-5, 1e-9);  // linear in the dark
}

TEST(ToneCurve, BlackStaysBlackAndGreyGrey) {
    const ToneCurve curve(1);
    const float nan = NAN;
    EXPECT_EQ(curve.srgb({0, 0, 0}), (Bytes{0, 0, 0}));
    EXPECT_EQ(curve.srgb({-1, -1, -1}), (Bytes{0, 0, 0}));
    EXPECT_EQ(curve.srgb({nan, nan, nan}), (Bytes{0, 0, 0}));
    EXPECT_EQ(curve.srgb({8, 8, 8}), (Bytes{255, 255, 255}));
    EXPECT_EQ(curve.srgb({INFINITY, INFINITY, INFINITY}), (Bytes{255, 255, 255}));
    for (float grey = 0.001f; grey < 10; grey *= 1.5f) {
        const Bytes bytes = curve.srgb({grey, grey, grey});
        EXPECT_EQ(bytes[0], bytes[1]);
        EXPECT_EQ(bytes[1], bytes[2]);
    }
    // 0.18 (1 + 0.18 / 64) / 1.18 = 0.15297, in sRGB 0.4283.
    EXPECT_EQ(curve.srgb({0.18f, 0.18f, 0.18f}), (Bytes{109, 109, 109}));
}

double linear(std::uint8_t byte) {
    const double c = byte / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

TEST(ToneCurve, KeepsTheLuminanceOfColoursBeyondTheScreen) {
    const ToneCurve curve(1);
    for (const std::array<float, 3>& rgb :
         {std::array<float, 3>{4, 0.1f, 0}, {0, 0, 9}, {3, 3, -1}, {0.1f, 7, 0.1f}, {0.5f, -0.05f, 0.2f}}) {
        const Bytes bytes = curve.srgb(rgb);
        const Rgb shown{{linear(bytes[0]), linear(bytes[1]), linear(bytes[2])}};
        const double luminance = Rgb{{rgb[0], rgb[1], rgb[2]}}.luminance();
        EXPECT_NEAR(shown.luminance(), curve.display_luminance(luminance), 0.005);
    }
    // The brighter, the whiter.
    EXPECT_EQ(curve.srgb({0.1f, 0, 0})[2], 0);
    EXPECT_LT(curve.srgb({10, 0, 0})[2], curve.srgb({30, 0, 0})[2]);
}

TEST(ToneCurve, ExposureMakesTheMeanMiddleGrey) {
    EXPECT_NEAR(automatic_exposure(picture_of({{50, 50, 50}, {200, 200, 200}})), 0.18 / 100, 1e-6);
    EXPECT_EQ(automatic_exposure(picture_of({{0, 0, 0}, {NAN, 0, 0}})), 1);
    // Black borders and pixels without value do not count.
    EXPECT_NEAR(automatic_exposure(picture_of({{100, 100, 100}, {0, 0, 0}, {NAN, 0, 0}})), 0.18 / 100, 1e-6);
}

TEST(ToneCurve, ExposureProtectsHighlights) {
    // 5 % of the pixels 150 times as bright: white but for the protection, which dims by less than two stops.
    std::vector<std::array<float, 3>> pixels(95, {100, 100, 100});
    pixels.insert(pixels.end(), 5, {15000, 15000, 15000});
    EXPECT_NEAR(automatic_exposure(picture_of(pixels)), 8.0 / 15000, 1e-7);
    pixels.back() = pixels[95] = pixels[96] = pixels[97] = pixels[98] = {1e9f, 1e9f, 1e9f};
    const double exposure = automatic_exposure(picture_of(pixels));
    EXPECT_NEAR(exposure, 0.18 / std::exp(0.95 * std::log(100) + 0.05 * std::log(1e9)) / 4, 1e-7);
}

TEST(ToneCurve, RefusesAnExposureThatShowsNothing) {
    for (const double exposure : {0.0, -1.0, double(NAN), double(INFINITY)})
        EXPECT_THROW(ToneCurve{exposure}, InputError);
}

}  // namespace
}  // namespace stilb::io
