#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "io/image/picture_file.h"
#include "io/image/tone_curve.h"
#include "io/sample_picture.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

template <typename Value>
bool same_bits(const std::vector<Value>& a, const std::vector<Value>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0;
}

/// What another program may write: channels of half floats, all with the same value, 3 x 2 pixels.
std::string foreign_exr(const std::vector<std::string>& names, float value,
                        const std::function<void(Imf::Header&)>& change = {}) {
    const Imath::Box2i window({10, -5}, {12, -4});
    Imf::Header header(Imath::Box2i({0, 0}, {99, 99}), window);
    std::vector<half> values(6, half(value));
    Imf::FrameBuffer buffer;
    for (const std::string& name : names) {
        header.channels().insert(name, Imf::Channel(Imf::HALF));
        buffer.insert(name, Imf::Slice::Make(Imf::HALF, values.data(), window));
    }
    if (change) change(header);
    Imf::StdOSStream stream;
    {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(buffer);
        file.writePixels(2);
    }
    return stream.str();
}

std::string message_of_exr(const std::string& content) {
    try {
        read_exr(content, "a.exr");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(ExrFile, KeepsAllChannelsExactly) {
    Picture picture = sample_picture();
    picture.rgb_cd_m2[3] = {0, 1e-9f, 1e9f};
    picture.rgb_cd_m2[4] = {-5, 3e38f, 1e-40f};
    picture.rgb_cd_m2[5] = {NAN, INFINITY, -INFINITY};
    const Picture read = read_exr(to_exr(picture), "a.exr");
    EXPECT_EQ(read.width, picture.width);
    EXPECT_EQ(read.height, picture.height);
    EXPECT_TRUE(same_bits(read.rgb_cd_m2, picture.rgb_cd_m2));
    EXPECT_TRUE(same_bits(read.standard_error_cd_m2, picture.standard_error_cd_m2));
    EXPECT_TRUE(same_bits(read.normals, picture.normals));
    EXPECT_TRUE(same_bits(read.depth_m, picture.depth_m));
    EXPECT_EQ(read.origin, picture.origin);
    ASSERT_TRUE(read.camera);
    EXPECT_EQ(read.camera->position, picture.camera->position);
    EXPECT_EQ(read.camera->projection, picture.camera->projection);
}

TEST(ExrFile, LeavesOutWhatThePictureHasNot) {
    Picture picture = picture_of({{1, 2, 3}});
    const Picture read = read_exr(to_exr(picture), "a.exr");
    EXPECT_TRUE(read.standard_error_cd_m2.empty());
    EXPECT_TRUE(read.normals.empty());
    EXPECT_TRUE(read.depth_m.empty());
    EXPECT_FALSE(read.camera);
    EXPECT_EQ(read.origin, PictureOrigin{});
}

TEST(ExrFile, SaysWhatItsValuesAre) {
    const Picture picture = sample_picture();
    Imf::StdISStream stream;
    stream.str(to_exr(picture));
    Imf::InputFile file(stream);
    const Imf::Header& header = file.header();
    std::string channels;
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
        channels += std::string(it.name()) + " ";
        EXPECT_EQ(it.channel().type, Imf::FLOAT);
    }
    EXPECT_EQ(channels, "B G N.X N.Y N.Z R SE.Y Y Z ");
    EXPECT_EQ(header.compression(), Imf::PIZ_COMPRESSION);
    EXPECT_EQ(Imf::whiteLuminance(header), 1);
    EXPECT_EQ(Imf::chromaticities(header).green, Imath::V2f(0.30f, 0.60f));
    const auto text = [&](const char* name) {
        const auto* attribute = header.findTypedAttribute<Imf::StringAttribute>(name);
        return attribute != nullptr ? attribute->value() : "missing";
    };
    EXPECT_EQ(text("scene"), "office.toml");
    EXPECT_EQ(text("sceneHash"), "0123abcd");
    EXPECT_EQ(text("sensor"), "main");
    EXPECT_EQ(text("method"), "auto");
    const auto number = [&](const char* name) {
        const auto* attribute = header.findTypedAttribute<Imf::DoubleAttribute>(name);
        return attribute != nullptr ? attribute->value() : -1;
    };
    EXPECT_EQ(number("seed"), 17);
    EXPECT_EQ(number("paths"), 4096);
    EXPECT_EQ(number("replicates"), 32);
    EXPECT_EQ(number("elapsed_s"), 12.5);
    EXPECT_EQ(number("patches"), 10080);
    EXPECT_EQ(number("patchSize_m"), 0.25);
    EXPECT_EQ(text("firstShot"), "incoming");
    EXPECT_EQ(text("command"), "stilb render office.toml -o a.exr");
    EXPECT_EQ(text("software"), "Stilb 9.8.7");
    EXPECT_EQ(text("VIEW").rfind("-vtv -vp 0.3 0.25 1.6 ", 0), 0u);

    std::vector<float> luminance(picture.pixel_count());
    Imf::FrameBuffer buffer;
    buffer.insert("Y", Imf::Slice::Make(Imf::FLOAT, luminance.data(), header.dataWindow()));
    file.setFrameBuffer(buffer);
    file.readPixels(0, picture.height - 1);
    for (std::size_t i = 0; i < luminance.size(); ++i)
        EXPECT_FLOAT_EQ(luminance[i], static_cast<float>(picture.luminance_cd_m2(i)));
}

/// 999,999,999,999,999 is the last number that the file has as a number, and 10^15 the first as a text.
TEST(ExrFile, KeepsLongSeeds) {
    for (const std::uint64_t seed : {999'999'999'999'998u, 999'999'999'999'999u, 1'000'000'000'000'000u,
                                     1'000'000'000'000'001u, ~std::uint64_t{0} / 2}) {
        Picture picture = sample_picture();
        picture.origin.seed = seed;
        EXPECT_EQ(read_exr(to_exr(picture), "a.exr").origin.seed, seed);
    }
}

TEST(ExrFile, ReadsOtherProgramsFiles) {
    const Picture coloured = read_exr(foreign_exr({"A", "B", "G", "R"}, 2.5), "a.exr");
    EXPECT_EQ(coloured.width, 3);
    EXPECT_EQ(coloured.height, 2);
    for (const auto& rgb : coloured.rgb_cd_m2) EXPECT_EQ(rgb, (std::array<float, 3>{2.5, 2.5, 2.5}));
    const Picture grey = read_exr(foreign_exr({"Y", "Z"}, 2.5), "a.exr");
    for (const auto& rgb : grey.rgb_cd_m2) EXPECT_EQ(rgb, (std::array<float, 3>{2.5, 2.5, 2.5}));
    EXPECT_EQ(grey.depth_m, std::vector<float>(6, 2.5));
    EXPECT_TRUE(grey.normals.empty());
}

TEST(ExrFile, HonoursWhiteLuminanceAndChromaticities) {
    const Picture bright = read_exr(
        foreign_exr({"B", "G", "R"}, 2.5, [](Imf::Header& header) { Imf::addWhiteLuminance(header, 100); }),
        "a.exr");
    EXPECT_NEAR(bright.luminance_cd_m2(0), 250, 1e-4);
    const auto rec2020 = [](Imf::Header& header) {
        Imf::addChromaticities(header,
                               {{0.708f, 0.292f}, {0.170f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.3290f}});
    };
    const Picture white = read_exr(foreign_exr({"B", "G", "R"}, 2.5, rec2020), "a.exr");
    for (const float component : white.rgb_cd_m2[0]) EXPECT_NEAR(component, 2.5, 1e-5);
    const auto aces = [](Imf::Header& header) {
        Imf::addChromaticities(header,
                               {{0.7347f, 0.2653f}, {0, 1}, {0.0001f, -0.077f}, {0.32168f, 0.33767f}});
    };
    const Picture aces_white = read_exr(foreign_exr({"B", "G", "R"}, 2.5, aces), "a.exr");
    for (const float component : aces_white.rgb_cd_m2[0]) EXPECT_NEAR(component, 2.5, 1e-5);
}

/// The luminances of the primaries of ACES, by SMPTE ST 2065-1: that of blue is negative.
TEST(Primaries, OfAcesHaveTheirLuminances) {
    const Primaries aces{{{0.7347, 0.2653}, {0, 1}, {0.0001, -0.077}, {0.32168, 0.33767}}};
    ASSERT_TRUE(are_usable(aces));
    const PrimariesConversion convert(aces, kRec709);
    const auto luminance = [&](const Triple& rgb) { return Rgb{convert(rgb)}.luminance(); };
    EXPECT_NEAR(luminance({1, 0, 0}), 0.3439664498, 2e-4);
    EXPECT_NEAR(luminance({0, 1, 0}), 0.7281660966, 2e-4);
    EXPECT_NEAR(luminance({0, 0, 1}), -0.0721325464, 2e-4);
    // Blue on the other side of the line: white would need less than nothing of it.
    EXPECT_FALSE(are_usable({{{0.7347, 0.2653}, {0, 1}, {0.9, 0.8}, {0.32168, 0.33767}}}));
    EXPECT_FALSE(are_usable({{{0.7347, 0.2653}, {0, 1}, {0.0001, 0}, {0.32168, 0.33767}}}));
}

TEST(ExrFile, RefusesWhatItCannotRead) {
    const std::string good = to_exr(sample_picture());
    for (std::size_t length = 0; length < good.size(); length += good.size() / 50)
        EXPECT_NE(message_of_exr(good.substr(0, length)), "") << length;
    EXPECT_EQ(message_of_exr("BM").rfind("a.exr: not a readable OpenEXR picture", 0), 0u)
        << message_of_exr("BM");
    EXPECT_NE(message_of_exr(foreign_exr({"A", "left.R"}, 1)).find("the file has A, left.R"),
              std::string::npos);
    const auto with = [](const std::function<void(Imf::Header&)>& change) {
        return message_of_exr(foreign_exr({"B", "G", "R"}, 1, change));
    };
    EXPECT_NE(with([](Imf::Header& header) { Imf::addWhiteLuminance(header, -1); }).find("whiteLuminance"),
              std::string::npos);
    EXPECT_NE(with([](Imf::Header& header) {
                  Imf::addChromaticities(header, {{0, 0}, {0, 0}, {0, 0}, {0, 0}});
              }).find("chromaticities"),
              std::string::npos);
}

TEST(ExrFile, RefusesHugePictures) {
    std::string content = to_exr(picture_of({{1, 1, 1}}));
    const std::size_t window = content.find(std::string("dataWindow\0box2i\0", 17)) + 17 + 4;
    const int most = 200'000;
    std::memcpy(content.data() + window + 8, &most, 4);
    EXPECT_NE(message_of_exr(content), "");
}

TEST(ExrFile, SurvivesChangedBytes) {
    const std::string good = to_exr(sample_picture(9, 5));
    for (std::size_t at = 0; at < good.size(); at += 3) {
        std::string changed = good;
        changed[at] = static_cast<char>(changed[at] ^ 0x15);
        message_of_exr(changed);  // whatever it says
    }
}

}  // namespace
}  // namespace stilb::io
