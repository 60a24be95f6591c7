#include "io/image/white_balance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/sample_picture.h"
#include "lights/colour_temperature.h"

namespace stilb::io {
namespace {

Rgb at(double kelvin) { return lights::colour_of_temperature(kelvin); }

TEST(ChromaticAdaptation, MakesTheWhiteGrey) {
    for (const Rgb& white : {at(1900), at(3000), at(4000), at(6500), at(20000), Rgb{{1.1, 1, 0.7}}}) {
        const Rgb adapted = ChromaticAdaptation(white)(50 * white);
        for (std::size_t b = 0; b < kBands; ++b) EXPECT_NEAR(adapted[b], 50 * white.luminance(), 1e-9);
    }
}

TEST(ChromaticAdaptation, OfTheScreensWhiteChangesNothing) {
    const Rgb colour{{3, -0.2, 7}};
    const Rgb adapted = ChromaticAdaptation(Rgb::grey(1))(colour);
    for (std::size_t b = 0; b < kBands; ++b) EXPECT_NEAR(adapted[b], colour[b], 1e-12);
}

/// [Lindbloom, Chromatic adaptation]: XYZ under D50 to XYZ under D65.
constexpr std::array<std::array<double, 3>, 3> kD50ToD65{{{0.9555766, -0.0230393, 0.0631636},
                                                          {-0.0282895, 1.0099416, 0.0210077},
                                                          {0.0122982, -0.0204830, 1.3299098}}};

std::array<double, 3> xyz(const Rgb& c) {
    return {0.412391 * c[0] + 0.357584 * c[1] + 0.180481 * c[2],
            0.212639 * c[0] + 0.715169 * c[1] + 0.072192 * c[2],
            0.019331 * c[0] + 0.119195 * c[1] + 0.950532 * c[2]};
}

TEST(ChromaticAdaptation, IsBradfords) {
    const ChromaticAdaptation adapted(lights::colour_of({0.20916, 0.32538}));  // D50: x 0.34567, y 0.35850
    for (const Rgb& colour : {Rgb{{1, 0.2, 0.1}}, Rgb{{0.1, 0.8, 0.3}}, Rgb{{0.2, 0.1, 1}}}) {
        const auto before = xyz(colour), after = xyz(adapted(colour));
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& row = kD50ToD65[i];
            EXPECT_NEAR(after[i], row[0] * before[0] + row[1] * before[1] + row[2] * before[2], 2e-3);
        }
    }
}

std::array<float, 3> pixel(const Rgb& rgb) {
    return {static_cast<float>(rgb[0]), static_cast<float>(rgb[1]), static_cast<float>(rgb[2])};
}

double kelvin_of(const Picture& picture, const scene::WhiteRange& whites) {
    return lights::correlated_temperature(choose_white(picture, whites)).temperature_k;
}

TEST(ChooseWhite, IsTheLampsWhateverThePictureShows) {
    const Picture wood = picture_of({{45, 33, 22}, {9, 3, 1}});
    EXPECT_EQ(choose_white(wood, {at(4000), at(4000)}), at(4000));
    // Lamps of one colour and several fluxes, divided by their luminances.
    EXPECT_NEAR(kelvin_of(wood, {at(4000) * (1 + 1e-16), at(4000) * (1 - 1e-15)}), 4000, 1);
    EXPECT_NEAR(kelvin_of(wood, {at(4000), at(4000) + Rgb{{1e-15, 0, -1e-15}}}), 4000, 1);
}

TEST(ChooseWhite, LiesBetweenTheLampsNearestToThePicture) {
    const scene::WhiteRange whites{at(3000), at(6000)};
    EXPECT_NEAR(kelvin_of(picture_of({pixel(10 * at(3000))}), whites), 3000, 10);
    EXPECT_NEAR(kelvin_of(picture_of({pixel(10 * at(6000))}), whites), 6000, 20);
    EXPECT_NEAR(kelvin_of(picture_of({pixel(10 * at(2000))}), whites), 3000, 10);
    EXPECT_NEAR(kelvin_of(picture_of({pixel(10 * at(20000))}), whites), 6000, 20);
    const Rgb mixed = at(3000) + at(6000);
    EXPECT_NEAR(kelvin_of(picture_of({pixel(10 * mixed)}), whites),
                lights::correlated_temperature(mixed).temperature_k, 10);
    EXPECT_NO_THROW(choose_white(picture_of({{0, 0, 0}, {NAN, 0, 0}}), whites));
}

TEST(ChooseWhite, DoesNotFollowAFewBrightLamps) {
    std::vector<std::array<float, 3>> pixels(95, pixel(100 * at(3000)));
    pixels.insert(pixels.end(), 5, pixel(1e6 * at(6000)));
    EXPECT_NEAR(kelvin_of(picture_of(pixels), {at(3000), at(6000)}), 3000, 150);
}

}  // namespace
}  // namespace stilb::io
