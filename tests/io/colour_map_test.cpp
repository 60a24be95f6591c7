#include "io/image/colour_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace stilb::io {
namespace {

TEST(Oklab, GivesThePublishedValues) {
    const Oklab white = to_oklab({1, 1, 1});
    EXPECT_NEAR(white.lightness, 1, 1e-6);
    EXPECT_NEAR(white.a, 0, 1e-6);
    EXPECT_NEAR(white.b, 0, 1e-6);
    // sRGB red as CSS Color 4 lists it: oklab(0.628 0.225 0.126).
    const Oklab red = to_oklab({1, 0, 0});
    EXPECT_NEAR(red.lightness, 0.628, 5e-4);
    EXPECT_NEAR(red.a, 0.225, 5e-4);
    EXPECT_NEAR(red.b, 0.126, 5e-4);
}

TEST(Oklab, ComesBack) {
    for (const Colour colour : {Colour{0.2, 0.5, 0.9}, Colour{0.01, 0.02, 0.03}, Colour{1, 0.3, 0}}) {
        const Colour back = from_oklab(to_oklab(colour));
        EXPECT_NEAR(back.red, colour.red, 1e-6);
        EXPECT_NEAR(back.green, colour.green, 1e-6);
        EXPECT_NEAR(back.blue, colour.blue, 1e-6);
    }
}

TEST(ColourMap, GrowsLighterAllTheWay) {
    const ColourMap map;
    constexpr int kSteps = 1000;
    // No step is less than half of the mean step: nowhere does the order get lost in grey print.
    const double least = 0.5 * (to_oklab(map.at(1)).lightness - to_oklab(map.at(0)).lightness) / kSteps;
    ASSERT_GT(least, 0);
    for (int i = 0; i < kSteps; ++i) {
        const double from = to_oklab(map.at(double(i) / kSteps)).lightness;
        const double to = to_oklab(map.at(double(i + 1) / kSteps)).lightness;
        EXPECT_GT(to - from, least) << i;
    }
}

TEST(ColourMap, StepsAreEqualInOklabToOnePercent) {
    const ColourMap map;
    constexpr int kSteps = 100;
    std::vector<double> steps;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        steps.push_back(
            distance(to_oklab(map.at(double(i) / kSteps)), to_oklab(map.at(double(i + 1) / kSteps))));
        sum += steps.back();
    }
    for (const double step : steps) EXPECT_NEAR(step / (sum / kSteps), 1, 0.01);
}

TEST(ColourMap, StaysWithinWhatAScreenShows) {
    const ColourMap map;
    for (int i = 0; i <= 1000; ++i) {
        const Colour colour = map.at(i / 1000.0);
        for (const double component : {colour.red, colour.green, colour.blue}) {
            EXPECT_GE(component, 0) << i;
            EXPECT_LE(component, 1) << i;
        }
    }
}

TEST(ColourMap, GivesTheEndsBeyondTheEnds) {
    const ColourMap map;
    EXPECT_EQ(distance(to_oklab(map.at(-3)), to_oklab(map.at(0))), 0);
    EXPECT_EQ(distance(to_oklab(map.at(INFINITY)), to_oklab(map.at(1))), 0);
    EXPECT_GT(distance(to_oklab(map.at(0)), to_oklab(map.at(1))), 0.8);
}

double relative_luminance(const Colour& colour) {
    const auto linear = [](double c) {
        return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) + 0.0722 * linear(colour.blue);
}

TEST(ColourMap, NumbersAreReadableOnEveryColour) {
    const ColourMap map;
    for (int i = 0; i <= 256; ++i) {
        const double background = relative_luminance(map.at(i / 256.0)) + 0.05;
        const double text = relative_luminance(readable_on(map.at(i / 256.0))) + 0.05;
        EXPECT_GE(std::max(background, text) / std::min(background, text), 4.5) << i;  // WCAG 2.1, level AA
    }
}

}  // namespace
}  // namespace stilb::io
