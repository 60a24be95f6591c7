#include "lights/colour_temperature.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stilb::lights {
namespace {

struct Published {
    const char* name;
    double temperature_k, x, y;  // CIE 1931
};

/// Forward matrix of Rec. 709 primaries and white D65, the other way round from what the code uses.
void expect_chromaticity(const Published& expected, double tolerance) {
    const Rgb c = colour_of_temperature(expected.temperature_k);
    const double x = 0.412391 * c[0] + 0.357584 * c[1] + 0.180481 * c[2];
    const double y = 0.212639 * c[0] + 0.715169 * c[1] + 0.072192 * c[2];
    const double z = 0.019331 * c[0] + 0.119195 * c[1] + 0.950532 * c[2];
    EXPECT_NEAR(x / (x + y + z), expected.x, tolerance) << expected.name;
    EXPECT_NEAR(y / (x + y + z), expected.y, tolerance) << expected.name;
}

/// A blackbody's chromaticity straight from Planck's law and the colour matching functions in the analytic
/// form of [Wyman, Sloan, Shirley 2013], which is good to about 0.003 in x and y.
Published integrated_blackbody(double temperature_k) {
    const auto lobe = [](double nm, double peak, double mean, double below, double above) {
        const double t = (nm - mean) / (nm < mean ? below : above);
        return peak * std::exp(-t * t / 2);
    };
    double x = 0, y = 0, z = 0;
    for (double nm = 360; nm <= 830; nm += 1) {
        const double power = 1e14 / std::pow(nm, 5) / std::expm1(1.4388e7 / (nm * temperature_k));
        x += power * (lobe(nm, 1.056, 599.8, 37.9, 31.0) + lobe(nm, 0.362, 442.0, 16.0, 26.7) +
                      lobe(nm, -0.065, 501.1, 20.4, 26.2));
        y += power * (lobe(nm, 0.821, 568.8, 46.9, 40.5) + lobe(nm, 0.286, 530.9, 16.3, 31.1));
        z += power * (lobe(nm, 1.217, 437.0, 11.8, 36.0) + lobe(nm, 0.681, 459.0, 26.0, 13.8));
    }
    return {"Planck's law", temperature_k, x / (x + y + z), y / (x + y + z)};
}

TEST(ColourTemperature, MeetsPublishedChromaticities) {
    expect_chromaticity({"illuminant A", 2856, 0.44757, 0.40745}, 5e-4);
    expect_chromaticity({"D50", 5003, 0.34567, 0.35850}, 5e-4);
    expect_chromaticity({"D55", 5503, 0.33242, 0.34743}, 5e-4);
    expect_chromaticity({"D65", 6504, 0.31271, 0.32902}, 5e-4);
    expect_chromaticity({"D75", 7504, 0.29902, 0.31485}, 5e-4);
}

TEST(ColourTemperature, IsABlackbodyUpTo4000K) {
    for (const double t : {2000.0, 2400.0, 2700.0, 3000.0, 3500.0, 4000.0}) {
        expect_chromaticity(integrated_blackbody(t), 4e-3);
    }
}

TEST(ColourTemperature, D65IsWhite) {
    const Rgb white = colour_of_temperature(6504);
    for (std::size_t b = 0; b < kBands; ++b) EXPECT_NEAR(white[b], 1, 2e-3);
}

TEST(ColourTemperature, HasLuminanceOneAndNoNegativeChannel) {
    for (double t = kMinColourTemperature_k; t <= kMaxColourTemperature_k; t += 100) {
        const Rgb c = colour_of_temperature(t);
        EXPECT_NEAR(c.luminance(), 1, 1e-12) << t;
        EXPECT_GE(c.min(), 0) << t;
    }
    EXPECT_EQ(colour_of_temperature(1000)[2], 0) << "outside of Rec. 709";
    EXPECT_GT(colour_of_temperature(2000)[2], 0);
}

TEST(ColourTemperature, GrowsBluerWithoutJumps) {
    const auto blueness = [](double t) {
        const Rgb c = colour_of_temperature(t);
        return c[2] / c[0];
    };
    double last = blueness(2000);
    for (double t = 2010; t <= 25000; t += 10) {
        const double now = blueness(t);
        EXPECT_GT(now, last) << t;
        EXPECT_LT(now - last, 0.01) << t;
        last = now;
    }
}

TEST(CorrelatedTemperature, IsTheWayBack) {
    for (const double t : {1800.0, 2700.0, 4000.0, 4400.0, 5000.0, 6504.0, 9300.0, 20000.0}) {
        const CorrelatedTemperature found = correlated_temperature(37 * colour_of_temperature(t));
        EXPECT_NEAR(1e6 / found.temperature_k, 1e6 / t, 0.003) << t;
        EXPECT_LT(found.distance, 1e-6) << t;
    }
}

TEST(CorrelatedTemperature, StatesTheDistanceFromWhite) {
    // u = 4x / (-2x + 12y + 3), v = 6y / (-2x + 12y + 3); Rec. 709 green is x = 0.30, y = 0.60.
    const ChromaticityUv green = chromaticity_of({{0, 5, 0}});
    EXPECT_NEAR(green.u, 1.2 / 9.6, 1e-3);
    EXPECT_NEAR(green.v, 3.6 / 9.6, 1e-3);
    EXPECT_GT(correlated_temperature({{0, 1, 0}}).distance, 0.05);
    EXPECT_LT(correlated_temperature(Rgb::grey(1)).distance, 0.001);
}

TEST(CorrelatedTemperature, ChromaticitiesAreColours) {
    const Rgb colour{{2, 0.5, 0.25}};
    const Rgb back = colour_of(chromaticity_of(colour)) * colour.luminance();
    for (std::size_t b = 0; b < kBands; ++b) EXPECT_NEAR(back[b], colour[b], 1e-3);
}

}  // namespace
}  // namespace stilb::lights
