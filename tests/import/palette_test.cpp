#include "io/import/textures/palette.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random_pairs.h"

namespace stilb::io {
namespace {

Rgb total(const std::vector<WeightedColour>& colours) {
    Rgb sum;
    for (const auto& [rgb, weight] : colours) sum += weight * rgb;
    return sum;
}

TEST(Palette, FewColoursAreKept) {
    const Rgb dark = Rgb::grey(0.1), bright{{0.8, 0.7, 0.6}};
    const Palette palette =
        make_palette(std::vector<WeightedColour>{{bright, 2}, {dark, 1}, {bright, 3}}, 256);
    ASSERT_EQ(palette.colours.size(), 2u);
    for (std::size_t b = 0; b < kBands; ++b) {
        EXPECT_NEAR(palette.colours[0][b], dark[b], 1e-15);
        EXPECT_NEAR(palette.colours[1][b], bright[b], 1e-15);
    }
    EXPECT_EQ(palette.colour_of, (std::vector<std::uint32_t>{1, 0, 1}));
    EXPECT_TRUE(make_palette({}, 256).colours.empty());
}

TEST(Palette, ManyColoursKeepTheirMean) {
    RandomPairs random(1);
    std::vector<WeightedColour> colours;
    for (int i = 0; i < 5000; ++i) {
        const auto [r, g] = random.next_pair();
        const auto [b, weight] = random.next_pair();
        colours.push_back({{{r, g, b}}, 0.01 + weight});
    }
    for (const std::size_t most : {1u, 2u, 16u, 256u}) {
        const Palette palette = make_palette(colours, most);
        ASSERT_EQ(palette.colours.size(), most);
        std::vector<WeightedColour> shown = colours;
        double squares = 0, weight = 0;
        for (std::size_t i = 0; i < shown.size(); ++i) {
            shown[i].rgb = palette.colours[palette.colour_of[i]];
            const Rgb apart = shown[i].rgb + -1 * colours[i].rgb;
            squares += shown[i].weight * (apart * apart)[0];
            weight += shown[i].weight;
        }
        for (std::size_t b = 0; b < kBands; ++b)
            EXPECT_NEAR(total(shown)[b], total(colours)[b], 1e-12 * total(colours)[b]);
        // A cube divided into n equal cubes has the variance n^(-2/3) / 12 in each band.
        EXPECT_LT(squares / weight, 1.4 * std::pow(most, -2.0 / 3) / 12);
    }
}

}  // namespace
}  // namespace stilb::io
