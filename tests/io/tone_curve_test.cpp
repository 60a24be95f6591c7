#include "io/image/tone_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/sample_picture.h"
#include "lights/colour_temperature.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

using ByteColour = std::array<std::uint8_t, 3>;

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
    EXPECT_NEAR(curve.display_luminance(1e-3), 1e-5, 1e-15);
    EXPECT_NEAR(curve.display_luminance(50), 0.5, 1e-12);  // linear to here, then without a kink
    EXPECT_NEAR((curve.display_luminance(50.1) - curve.display_luminance(50)) / 0.1, 0.01, 1e-4);
}

TEST(ToneCurve, TellsLampsFromWhatTheyLight) {
    const ToneCurve curve(1);
    // Of Reinhard's operator for what exceeds 0.5: x = 1 is l = 1, (1 + 1 / 225) / 2 of the upper half.
    EXPECT_NEAR(curve.display_luminance(1), 0.5 + 0.5 * (1 + 1 / 225.) / 2, 1e-12);
    EXPECT_GT(curve.display_luminance(4) - curve.display_luminance(2), 0.05);
}

TEST(ToneCurve, BlackStaysBlackAndGreyGrey) {
    const ToneCurve curve(1);
    const float nan = NAN;
    EXPECT_EQ(curve.srgb({0, 0, 0}), (ByteColour{0, 0, 0}));
    EXPECT_EQ(curve.srgb({-1, -1, -1}), (ByteColour{0, 0, 0}));
    EXPECT_EQ(curve.srgb({nan, nan, nan}), (ByteColour{0, 0, 0}));
    EXPECT_EQ(curve.srgb({8, 8, 8}), (ByteColour{255, 255, 255}));
    EXPECT_EQ(curve.srgb({INFINITY, INFINITY, INFINITY}), (ByteColour{255, 255, 255}));
    for (float grey = 0.001f; grey < 10; grey *= 1.5f) {
        const ByteColour bytes = curve.srgb({grey, grey, grey});
        EXPECT_EQ(bytes[0], bytes[1]);
        EXPECT_EQ(bytes[1], bytes[2]);
    }
    // 0.18 in sRGB is 0.4614.
    EXPECT_EQ(curve.srgb({0.18f, 0.18f, 0.18f}), (ByteColour{118, 118, 118}));
}

/// White balance: whatever the lamps' colour temperature, a grey wall is grey, and as bright as ever.
TEST(ToneCurve, ShowsANeutralWallWithoutHue) {
    for (const double kelvin : {2700.0, 3000.0, 4000.0, 6500.0, 10000.0}) {
        const Rgb white = lights::colour_of_temperature(kelvin);
        const ToneCurve curve(0.01, white);
        EXPECT_NEAR(curve.white_k(), kelvin, 1);
        for (const float luminance : {5.0f, 18.0f, 60.0f, 300.0f}) {
            const Rgb wall = luminance * white;
            const ByteColour shown = curve.srgb({float(wall[0]), float(wall[1]), float(wall[2])});
            EXPECT_EQ(shown, ToneCurve(0.01).srgb({luminance, luminance, luminance})) << kelvin;
        }
    }
    // Without it the wall at 4000 K is sepia.
    const Rgb wall = 18 * lights::colour_of_temperature(4000);
    const ByteColour shown = ToneCurve(0.01).srgb({float(wall[0]), float(wall[1]), float(wall[2])});
    EXPECT_GT(shown[0], shown[2] + 30);
}

double linear(std::uint8_t byte) {
    const double c = byte / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

TEST(ToneCurve, KeepsTheLuminanceOfColoursBeyondTheScreen) {
    const ToneCurve curve(1);
    for (const std::array<float, 3>& rgb :
         {std::array<float, 3>{4, 0.1f, 0}, {0, 0, 9}, {3, 3, -1}, {0.1f, 7, 0.1f}, {0.5f, -0.05f, 0.2f}}) {
        const ByteColour bytes = curve.srgb(rgb);
        const Rgb shown{{linear(bytes[0]), linear(bytes[1]), linear(bytes[2])}};
        const double luminance = Rgb{{rgb[0], rgb[1], rgb[2]}}.luminance();
        EXPECT_NEAR(shown.luminance(), curve.display_luminance(luminance), 0.005);
    }
    // The brighter, the whiter.
    EXPECT_EQ(curve.srgb({0.1f, 0, 0})[2], 0);
    EXPECT_LT(curve.srgb({10, 0, 0})[2], curve.srgb({30, 0, 0})[2]);
}

using Pixels = std::vector<std::array<float, 3>>;

/// So many of 100 pixels show lamps, the others a room of 5 to 201 cd/m2 (median 53, nine tenths up to 163).
Picture room_with(float lamps_cd_m2, int lamps) {
    Pixels pixels(static_cast<std::size_t>(lamps), {lamps_cd_m2, lamps_cd_m2, lamps_cd_m2});
    for (int i = 0; i < 100 - lamps; ++i) {
        const auto grey = static_cast<float>(5 + i * i / 50.);
        pixels.push_back({grey, grey, grey});
    }
    return picture_of(pixels);
}

TEST(AutomaticExposure, UsesTheRange) {
    EXPECT_NEAR(automatic_exposure(room_with(0, 0)), 0.65 / 163.4, 1e-5);
    // A picture of one grey is neither white nor dark.
    EXPECT_NEAR(automatic_exposure(picture_of(Pixels(50, {40, 40, 40}))), 0.36 / 40, 1e-9);
    EXPECT_EQ(automatic_exposure(picture_of({{0, 0, 0}, {NAN, 0, 0}})), 1);
    // Black borders and pixels without value do not count.
    EXPECT_NEAR(automatic_exposure(picture_of({{100, 100, 100}, {0, 0, 0}, {NAN, 0, 0}})), 0.36 / 100, 1e-9);
}

TEST(AutomaticExposure, LampsDoNotMakeTheRoomDark) {
    const double without = automatic_exposure(room_with(0, 0));
    for (const float lamps : {1e3f, 1e4f, 1e6f}) {
        const double with = automatic_exposure(room_with(lamps, 5));
        EXPECT_GT(with, 0.9 * without) << lamps;
        EXPECT_LT(with, 1.1 * without) << lamps;
    }
    // A window over a fifth of the picture, ten times as bright as the room: its median is not black.
    EXPECT_NEAR(53 * automatic_exposure(room_with(700, 20)), 0.12, 0.002);
}

TEST(AutomaticExposure, BrightThingsInTheDarkKeepTheirContrasts) {
    Pixels pixels(70, {0.01f, 0.01f, 0.01f});
    pixels.insert(pixels.end(), 30, {10, 10, 10});
    const ToneCurve curve(automatic_exposure(picture_of(pixels)));
    EXPECT_LT(curve.display_luminance(10), 0.96);
}

TEST(ToneCurve, RefusesAnExposureThatShowsNothing) {
    for (const double exposure : {0.0, -1.0, double(NAN), double(INFINITY)})
        EXPECT_THROW(ToneCurve{exposure}, InputError);
}

}  // namespace
}  // namespace stilb::io
