#include "lights/panorama.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lights/environment.h"
#include "math/random.h"
#include "statistics/hypothesis.h"
#include "stilb/error.h"

namespace stilb::lights {
namespace {

constexpr int kHeight = 6, kWidth = 2 * kHeight;

/// Dark and bright pixels, some black, in three colours.
Panorama::Image spots() {
    Panorama::Image image{kWidth, kHeight, {}};
    for (int i = 0; i < kWidth * kHeight; ++i) {
        const auto value = static_cast<float>((i * 7) % 11);
        image.rgb_cd_m2.push_back({value, 2 * value, (i % 3 == 0 ? 5.0F : 0.5F) * value});
    }
    return image;
}

/// The middle of a pixel's solid angle, in the picture's frame, from the definition of the projection.
Vec3 middle_of(int column, int row, int width = kWidth, int height = kHeight) {
    const double z = (std::cos(kPi * row / height) + std::cos(kPi * (row + 1) / height)) / 2;
    const double left = kPi - 2 * kPi * (column + 0.5) / width, horizontal = std::sqrt(1 - z * z);
    return {horizontal * std::cos(left), horizontal * std::sin(left), z};
}

double solid_angle_sr(int row) {
    return 2 * kPi / kWidth * (std::cos(kPi * row / kHeight) - std::cos(kPi * (row + 1) / kHeight));
}

TEST(Panorama, LooksAlongXInTheMiddleAndToYOnTheLeft) {
    Panorama::Image image{8, 4, std::vector<std::array<float, 3>>(32)};
    for (std::size_t i = 0; i < 32; ++i) image.rgb_cd_m2[i].fill(static_cast<float>(i));
    const Panorama panorama(image);
    const auto at = [&](const Vec3& direction) { return panorama.luminance_cd_m2(normalized(direction))[0]; };
    // Rows 1 and 2 meet at the horizon; columns 3 and 4 on either side of the middle.
    EXPECT_EQ(at({1, 0.1, 0.1}), 8 + 3);
    EXPECT_EQ(at({1, -0.1, 0.1}), 8 + 4);
    EXPECT_EQ(at({0.1, 1, 0.1}), 8 + 2);
    EXPECT_EQ(at({-0.1, 1, -0.1}), 16 + 1);
    EXPECT_EQ(at({0.1, -1, 0.1}), 8 + 5);
    EXPECT_EQ(at({-1, 0.1, 0.1}), 8 + 0);
    EXPECT_EQ(at({-1, -0.1, 0.1}), 8 + 7);
    EXPECT_EQ(at({0.1, 0.01, 1}), 3);
    EXPECT_EQ(at({0.1, 0.01, -1}), 24 + 3);
}

TEST(Panorama, ItsDensityIsThatOfItsSamplesAndAddsUpToOne) {
    const Panorama panorama(spots());
    std::vector<double> expected, observed(kWidth * kHeight);
    constexpr std::uint64_t kSamples = 1 << 16;
    double whole = 0;
    Rgb total;
    for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
            const Vec3 middle = middle_of(column, row);
            const double share = panorama.pdf_per_sr(middle) * solid_angle_sr(row);
            whole += share;
            expected.push_back(share * kSamples);
            total += solid_angle_sr(row) * panorama.luminance_cd_m2(middle);
        }
    }
    EXPECT_NEAR(whole, 1, 1e-12);
    for (std::size_t b = 0; b < kBands; ++b) EXPECT_NEAR(panorama.total_lx()[b], total[b], 1e-9 * total[b]);
    std::vector<double> in_pixel_across, in_pixel_down;
    for (std::uint64_t i = 0; i < kSamples; ++i) {
        math::SampleStream stream(math::RandomKey{4}.derived(i), 0);
        const auto [u1, u2] = stream.next_two();
        const Panorama::Sample sample = panorama.sample(u1, u2);
        ASSERT_NEAR(length(sample.direction), 1, 1e-12);
        ASSERT_EQ(sample.luminance_cd_m2, panorama.luminance_cd_m2(sample.direction));
        ASSERT_EQ(sample.pdf_per_sr, panorama.pdf_per_sr(sample.direction));
        // Value over density is the same for all: the luminous integral.
        ASSERT_NEAR(sample.luminance_cd_m2.luminance() / sample.pdf_per_sr, total.luminance(),
                    1e-9 * total.luminance());
        const double row = std::acos(sample.direction.z) / kPi * kHeight;
        const double column = (0.5 - std::atan2(sample.direction.y, sample.direction.x) / (2 * kPi)) * kWidth;
        ++observed[static_cast<std::size_t>(row) * kWidth + static_cast<std::size_t>(column)];
        in_pixel_across.push_back(column - std::floor(column));
        const double top = std::cos(kPi * std::floor(row) / kHeight);
        in_pixel_down.push_back((top - sample.direction.z) /
                                (top - std::cos(kPi * (std::floor(row) + 1) / kHeight)));
    }
    std::vector<double> lit, found;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        if (expected[i] == 0) {
            EXPECT_EQ(observed[i], 0);
        } else {
            lit.push_back(expected[i]), found.push_back(observed[i]);
        }
    }
    EXPECT_GT(statistics::chi2_test(found, lit).p_value, 1e-4);
    EXPECT_GT(statistics::uniformity_p(in_pixel_across), 1e-4);
    EXPECT_GT(statistics::uniformity_p(in_pixel_down), 1e-4);
}

TEST(Panorama, PartsAddUpToTheWhole) {
    Panorama::Image image{200, 100, {}};
    for (int i = 0; i < 20000; ++i) image.rgb_cd_m2.push_back({1, static_cast<float>(i % 7), 3});
    const Panorama panorama(image);
    Rgb sum;
    for (const Panorama::Part& part : panorama.parts()) sum += part.normal_illuminance_lx;
    EXPECT_LE(panorama.parts().size(), 64u * 32);
    for (std::size_t b = 0; b < kBands; ++b)
        EXPECT_NEAR(sum[b], panorama.total_lx()[b], 1e-9 * panorama.total_lx()[b]);
    // The same luminance all around, in this band, is pi times it on any plane.
    EXPECT_NEAR(panorama.illuminance_lx(normalized(Vec3{1, 2, -1}))[2], 3 * kPi, 1e-3 * 3 * kPi);
}

TEST(Panorama, RefusesWhatIsNone) {
    Panorama::Image image = spots();
    image.rgb_cd_m2[5][1] = -1;
    EXPECT_THROW(Panorama{image}, InputError);
    image.rgb_cd_m2[5][1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(Panorama{image}, InputError);
    image.rgb_cd_m2[5][1] = 1;
    EXPECT_NO_THROW(Panorama{image});
    EXPECT_THROW((Panorama{{2, 1, {{0, 0, 0}, {0, 0, 0}}}}), InputError);
    EXPECT_THROW((Panorama{{3, 1, {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}}}), InputError);
}

TEST(PanoramaAxes, TurnAboutTheTopAndTheShortestWay) {
    const auto expect_axes = [](const Frame& actual, const Vec3& u, const Vec3& v, const Vec3& w) {
        EXPECT_LT(length(actual.u - u) + length(actual.v - v) + length(actual.w - w), 1e-12);
    };
    expect_axes(panorama_axes({0, 0, 1}, 0), {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    expect_axes(panorama_axes({0, 0, 1}, 90), {0, 1, 0}, {-1, 0, 0}, {0, 0, 1});
    // From +z to +x is a quarter turn about y, which takes x to -z.
    expect_axes(panorama_axes({1, 0, 0}, 0), {0, 0, -1}, {0, 1, 0}, {1, 0, 0});
    // Upside down: a half turn about x.
    expect_axes(panorama_axes({0, 0, -1}, 0), {1, 0, 0}, {0, -1, 0}, {0, 0, -1});
}

}  // namespace
}  // namespace stilb::lights
