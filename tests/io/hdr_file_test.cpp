#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/image/picture_file.h"
#include "io/sample_picture.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

constexpr double kPrecision = 1.0 / 256;

std::string header(const std::string& lines, const std::string& resolution) {
    return "#?RADIANCE\n" + lines + "FORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n";
}

std::string bytes(std::initializer_list<int> values) {
    std::string text;
    for (const int value : values) text += static_cast<char>(value);
    return text;
}

/// A pixel of 1 W/(sr m2) in all of Radiance's bands, but for the half that is added to its mantissa of 128.
const std::string kOne = bytes({128, 128, 128, 129});
constexpr double kOneInCdM2 = 179 * 128.5 / 128;

std::string message_of_hdr(const std::string& content) {
    try {
        read_hdr(content, "a.hdr");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(HdrFile, KeepsEveryComponentToAPartOfTheLargest) {
    const Picture picture = sample_picture();
    const Picture read = read_hdr(to_hdr(picture), "a.hdr");
    ASSERT_EQ(read.width, picture.width);
    ASSERT_EQ(read.height, picture.height);
    for (std::size_t i = 0; i < picture.pixel_count(); ++i) {
        const auto& wanted = picture.rgb_cd_m2[i];
        const double largest = std::max({wanted[0], wanted[1], wanted[2]});
        for (std::size_t b = 0; b < 3; ++b)
            EXPECT_NEAR(read.rgb_cd_m2[i][b], wanted[b], 1.1 * kPrecision * largest) << i;
        EXPECT_NEAR(read.luminance_cd_m2(i), picture.luminance_cd_m2(i), kPrecision * largest) << i;
    }
}

TEST(HdrFile, KeepsExtremeLuminances) {
    const float infinity = INFINITY;
    const Picture read = read_hdr(to_hdr(picture_of({{0, 0, 0},
                                                     {1e-9f, 1e-9f, 1e-9f},
                                                     {1e9f, 1e9f, 1e9f},
                                                     {-5, -5, -5},
                                                     {NAN, 1, 1},
                                                     {1e-38f, 1e-38f, 1e-38f},
                                                     {3e38f, 3e38f, 3e38f},
                                                     {infinity, infinity, infinity}})),
                                  "a.hdr");
    EXPECT_EQ(read.luminance_cd_m2(0), 0);
    EXPECT_NEAR(read.luminance_cd_m2(1), 1e-9, 1e-9 * kPrecision);
    EXPECT_NEAR(read.luminance_cd_m2(2), 1e9, 1e9 * kPrecision);
    EXPECT_EQ(read.luminance_cd_m2(3), 0);
    EXPECT_EQ(read.luminance_cd_m2(4), 0);
    EXPECT_LE(read.luminance_cd_m2(5), 2e-38);
    EXPECT_NEAR(read.luminance_cd_m2(6), 3e38, 3e38 * kPrecision);
    EXPECT_NEAR(read.luminance_cd_m2(7), 3e38, 3e38 * kPrecision);
}

/// As Radiance's programs compute it, from the bytes.
double radiance_luminance(const std::string& pixel) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(pixel[i]); };
    return 179 * std::ldexp(1.0, byte(3) - 136) *
           (0.265 * (byte(0) + 0.5) + 0.670 * (byte(1) + 0.5) + 0.065 * (byte(2) + 0.5));
}

TEST(HdrFile, GivesRadiancesProgramsTheRightLuminance) {
    const std::vector<std::array<float, 3>> colours{{100, 100, 100}, {300, 20, 10}, {10, 300, 10},
                                                    {50, 50, 300},   {100, 0, 0},   {0, 100, 0}};
    for (const auto& colour : colours) {
        const Picture picture = picture_of({colour});
        const std::string content = to_hdr(picture);
        const double largest = *std::max_element(colour.begin(), colour.end());
        EXPECT_NEAR(radiance_luminance(content.substr(content.size() - 4)), picture.luminance_cd_m2(0),
                    1.1 * kPrecision * largest);
    }
}

TEST(HdrFile, KeepsGreyGrey) {
    const std::string content = to_hdr(picture_of({{179, 179, 179}}));
    EXPECT_EQ(content.substr(content.size() - 4), kOne);
}

TEST(HdrFile, EncodesRunsAndLiterals) {
    // 200 equal pixels, 200 different ones, 3 equal ones.
    std::vector<std::array<float, 3>> pixels(200, {50, 50, 50});
    for (int i = 0; i < 200; ++i) pixels.push_back({float(100 + i % 7), 100, float(100 + i % 11)});
    pixels.insert(pixels.end(), 3, {1, 1, 1});
    const Picture picture = picture_of(pixels);
    const std::string content = to_hdr(picture);
    EXPECT_LT(content.size(), 200 + 403 * 4);
    const Picture read = read_hdr(content, "a.hdr");
    for (std::size_t i = 0; i < pixels.size(); ++i)
        EXPECT_NEAR(read.luminance_cd_m2(i), picture.luminance_cd_m2(i), 0.5) << i;
}

TEST(HdrFile, WritesAnyWidth) {
    for (const int width : {1, 7, 8, 127, 128, 129, 255, 256, 32767, 32768}) {
        const Picture picture = sample_picture(width, 2);
        const Picture read = read_hdr(to_hdr(picture), "a.hdr");
        ASSERT_EQ(read.width, width);
        for (const std::size_t i : {std::size_t{0}, read.pixel_count() - 1})
            EXPECT_NEAR(read.luminance_cd_m2(i), picture.luminance_cd_m2(i),
                        2 * kPrecision * picture.luminance_cd_m2(i));
    }
}

TEST(HdrFile, SaysWhereItComesFrom) {
    Picture picture = sample_picture();
    picture.origin.scene = "two\nlines";
    const std::string content = to_hdr(picture);
    for (const char* line :
         {"#?RADIANCE\n", "\nSOFTWARE= Stilb 9.8.7\n", "\nCOMMAND= stilb render office.toml -o a.exr\n",
          "\nSCENE= two lines\n", "\nSCENEHASH= 0123abcd\n", "\nSEED= 17\n", "\nEXPOSURE= 1\n",
          "\nPRIMARIES= 0.6400 0.3300 0.2900 0.6000 0.1500 0.0600 0.3333 0.3333\n",
          "\nFORMAT=32-bit_rle_rgbe\n", "\n\n-Y 20 +X 40\n"})
        EXPECT_NE(content.find(line), content.npos) << line;
    picture.origin.scene = "two lines";
    EXPECT_EQ(read_hdr(content, "a.hdr").origin, picture.origin);
}

TEST(HdrFile, HasRadiancesViewWhereThereIsOne) {
    Picture picture = sample_picture();
    const auto view_line = [&](Projection projection) {
        picture.camera->projection = projection;
        const std::string content = to_hdr(picture);
        const std::size_t begin = std::min(content.find("VIEW="), content.find("PANORAMA="));
        return content.substr(begin, content.find('\n', begin) - begin);
    };
    const std::string place = "-vp 0.3 0.25 1.6 -vd 2.7 2.5 -0.5 -vu 0 0 1 -vh 70 -vv ";
    // 2 atan(tan(35 deg) / 2), with digits beyond those compared.
    EXPECT_EQ(view_line(Projection::perspective).rfind("VIEW= -vtv " + place + "38.5", 0), 0u);
    EXPECT_EQ(view_line(Projection::fisheye), "VIEW= -vta " + place + "35");
    EXPECT_EQ(view_line(Projection::panorama), "PANORAMA= " + place + "35");
}

TEST(HdrFile, ReadsItsCameraBack) {
    for (const Projection projection : {Projection::perspective, Projection::fisheye, Projection::panorama}) {
        Picture picture = sample_picture();
        picture.camera->projection = projection;
        const Picture read = read_hdr(to_hdr(picture), "a.hdr");
        ASSERT_TRUE(read.camera);
        EXPECT_EQ(read.camera->projection, projection);
        EXPECT_EQ(read.camera->position, picture.camera->position);
        EXPECT_LT(length(read.camera->target - picture.camera->target), 1e-12);
        EXPECT_EQ(read.camera->up, picture.camera->up);
        EXPECT_EQ(read.camera->fov_deg, 70);
        EXPECT_EQ(read.camera->resolution, picture.camera->resolution);
    }
}

TEST(HdrFile, PassesOverViewsThatAreNoCamera) {
    for (const char* view :
         {"-vtl -vp 0 0 0 -vd 0 1 0 -vu 0 0 1 -vh 2 -vv 2", "-vtc -vh 360", "-vtv -vd 0 0 1 -vu 0 0 1",
          "-vtv -vh 0", "-vtv -vh 180", "-vp 1 2", "-vp 1 nan 2", "-vtv -vs 0.5", "-vtv -vd 0 0 0"})
        EXPECT_FALSE(read_hdr(header(std::string("VIEW= ") + view + "\n", "-Y 1 +X 1") + kOne, "a").camera)
            << view;
    EXPECT_TRUE(read_hdr(header("VIEW= -vs 0\n", "-Y 1 +X 1") + kOne, "a").camera);
}

TEST(HdrFile, HonoursExposures) {
    const std::string exposed = header("EXPOSURE=2\nEXPOSURE=  4.0\n", "-Y 1 +X 1") + kOne;
    EXPECT_NEAR(read_hdr(exposed, "a.hdr").luminance_cd_m2(0), kOneInCdM2 / 8, 1e-4);
}

TEST(HdrFile, HonoursPrimaries) {
    const std::string red = bytes({128, 0, 0, 130});
    const auto luminance = [&](const std::string& lines) {
        return read_hdr(header(lines, "-Y 1 +X 1") + red, "a.hdr").luminance_cd_m2(0);
    };
    EXPECT_NEAR(luminance(""), 179 * 2 * 0.265, 2);
    EXPECT_NEAR(luminance("PRIMARIES= .64 .33 .3 .6 .15 .06 .3127 .329\n"), 179 * 2 * 0.2126, 2);
}

TEST(HdrFile, ReadsFlatAndOldRuns) {
    const std::string half = bytes({128, 128, 128, 128});
    const std::string flat = header("", "-Y 2 +X 2") + kOne + half + half + kOne;
    const Picture read = read_hdr(flat, "a.hdr");
    EXPECT_NEAR(read.luminance_cd_m2(0), kOneInCdM2, 1e-3);
    EXPECT_NEAR(read.luminance_cd_m2(1), kOneInCdM2 / 2, 1e-3);
    EXPECT_NEAR(read.luminance_cd_m2(3), kOneInCdM2, 1e-3);
    // 300 = 44 + 1 * 256 repetitions.
    const std::string runs = header("", "-Y 1 +X 302") + kOne + bytes({1, 1, 1, 44, 1, 1, 1, 1}) + half;
    const Picture repeated = read_hdr(runs, "a.hdr");
    EXPECT_NEAR(repeated.luminance_cd_m2(300), kOneInCdM2, 1e-3);
    EXPECT_NEAR(repeated.luminance_cd_m2(301), kOneInCdM2 / 2, 1e-3);
}

TEST(HdrFile, RefusesWhatItCannotRead) {
    const std::string good = to_hdr(sample_picture());
    EXPECT_EQ(message_of_hdr(good), "");
    for (std::size_t length = 0; length < good.size(); length += 7)
        EXPECT_NE(message_of_hdr(good.substr(0, length)), "") << length;
    const auto expect = [](const std::string& content, const std::string& part) {
        EXPECT_NE(message_of_hdr(content).find(part), std::string::npos) << message_of_hdr(content);
    };
    expect("BM", "a.hdr:1: not a Radiance picture");
    expect(header("", "+Y 1 +X 1") + kOne, "-Y height +X width");
    expect(header("", "+X 1 -Y 1") + kOne, "-Y height +X width");
    expect(header("", "-Y 0 +X 1") + kOne, "-Y height +X width");
    expect(header("", "-Y 99999 +X 99999"), "too many");
    expect(header("", "-Y 1 +X 9999999999999"), "too many");
    expect(header("FORMAT=32-bit_rle_xyze\n", "-Y 1 +X 1") + kOne, "32-bit_rle_xyze");
    expect(header("EXPOSURE=0\n", "-Y 1 +X 1") + kOne, "EXPOSURE");
    expect(header("EXPOSURE=high\n", "-Y 1 +X 1") + kOne, "EXPOSURE");
    expect(header("PRIMARIES= 1 2\n", "-Y 1 +X 1") + kOne, "PRIMARIES");
    expect(header("", "-Y 1 +X 8") + bytes({2, 2, 0, 9}), "another width");
    expect(header("", "-Y 1 +X 8") + bytes({2, 2, 0, 8, 137, 5}), "does not fit");
    expect(header("", "-Y 1 +X 8") + bytes({2, 2, 0, 8, 0}), "does not fit");
    expect(header("", "-Y 1 +X 2") + bytes({1, 1, 1, 2}), "does not fit");
    expect(header("", "-Y 1 +X 2") + kOne + bytes({1, 1, 1, 2}), "does not fit");
    expect(header("", "-Y 1 +X 2") + kOne, "ends within row 1 of 1");
    expect("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", "ends within its header");
}

TEST(HdrFile, BandsAsTheyAreComeBackByTheirPrimaries) {
    const Picture read = read_hdr(to_hdr(picture_of({{400, 100, 20}}), HdrBands::as_they_are), "a.hdr");
    EXPECT_NEAR(read.rgb_cd_m2[0][0], 400, 2);
    EXPECT_NEAR(read.rgb_cd_m2[0][1], 100, 2);
    EXPECT_NEAR(read.rgb_cd_m2[0][2], 20, 2);
}

}  // namespace
}  // namespace stilb::io
