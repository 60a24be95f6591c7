#include "io/results/packed_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "io/text/compression.h"

namespace stilb::io {
namespace {

class Uniform {
  public:
    double operator()() { return static_cast<double>(engine_()) / 0x1p32; }

  private:
    std::mt19937 engine_;
};

/// Two groups of lights. The numbers have both signs and sizes between two powers of two.
LightOfGroups sample_light(std::size_t terms, int least_exponent, int most_exponent) {
    LightOfGroups light(2, std::vector<HalfRgb>(terms));
    Uniform uniform;
    for (auto& group : light) {
        for (HalfRgb& rgb : group) {
            for (Half& band : rgb) {
                const double exponent = least_exponent + (most_exponent - least_exponent) * uniform();
                const double sign = uniform() < 0.5 ? -1 : 1;
                band = to_half(static_cast<float>(sign * std::exp2(exponent)));
            }
        }
    }
    return light;
}

TEST(PackedLight, KeepsEveryBit) {
    for (const auto& [least, most] : {std::pair{-14, 1}, std::pair{-2, 15}, std::pair{0, 0}}) {
        const LightOfGroups light = sample_light(500, least, most);
        EXPECT_EQ(unpack(pack(light), 2), light) << least;
    }
    EXPECT_EQ(unpack(pack({}), 0), LightOfGroups{});
    const LightOfGroups dark(3, std::vector<HalfRgb>(4));
    EXPECT_EQ(unpack(pack(dark), 3), dark);
}

/// Beside the largest numbers of half precision the smallest ones are lost, and nothing else.
TEST(PackedLight, LosesOnlyWhatIsTooSmallToSee) {
    const LightOfGroups light{{{to_half(65504), to_half(6e-8f), to_half(-1)}}};
    const auto read = unpack(pack(light), 1);
    ASSERT_TRUE(read);
    EXPECT_EQ(to_float(read->at(0)[0][0]), 65504);
    EXPECT_NEAR(to_float(read->at(0)[0][1]), 0, 1e-3);
    EXPECT_NEAR(to_float(read->at(0)[0][2]), -1, 1e-3);
}

/// Nearly white light takes less space than in half precision.
TEST(PackedLight, CompressesWell) {
    LightOfGroups light(4, std::vector<HalfRgb>(2000));
    std::string plain;
    Uniform uniform;
    for (auto& group : light) {
        for (HalfRgb& rgb : group) {
            const double green = std::nearbyint(20 * uniform()), red = green + std::nearbyint(uniform());
            rgb = to_half_rgb(Rgb{{red, green, green}} * 0.125);
            for (const Half band : rgb)
                plain.append({static_cast<char>(band & 255), static_cast<char>(band >> 8)});
        }
    }
    EXPECT_LT(1.3 * static_cast<double>(gzip(pack(light).bytes).size()),
              static_cast<double>(gzip(plain).size()));
}

TEST(PackedLight, RefusesPartsThatDoNotFit) {
    const PackedLight good = pack(sample_light(5, -3, 3));
    EXPECT_TRUE(unpack(good, 2));
    EXPECT_FALSE(unpack(good, 1));
    PackedLight bad = good;
    bad.bytes.pop_back();
    EXPECT_FALSE(unpack(bad, 2));
    bad = good;
    bad.exponents.push_back(0);
    EXPECT_FALSE(unpack(bad, 2));
    for (const int exponent : {-25, 17, 30000}) {
        bad = good;
        bad.exponents[3] = static_cast<std::int16_t>(exponent);
        EXPECT_FALSE(unpack(bad, 2)) << exponent;
    }
}

}  // namespace
}  // namespace stilb::io
