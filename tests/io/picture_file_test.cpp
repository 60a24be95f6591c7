#include "io/image/picture_file.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "io/sample_picture.h"
#include "io/text/table.h"
#include "lights/colour_temperature.h"
#include "stilb/error.h"
#include "support/picture_pixels.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

namespace fs = std::filesystem;

class PictureFile : public testing::Test {
  protected:
    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder_.path()))
            names.push_back(entry.path().filename());
        std::sort(names.begin(), names.end());
        return names;
    }

    const TestFolder folder_;
};

TEST_F(PictureFile, WritesByExtensionAndReadsByContent) {
    const Picture picture = sample_picture();
    EXPECT_FALSE(write_picture(picture, folder_ / "a.EXR"));
    EXPECT_FALSE(write_picture(picture, folder_ / "b.hdr"));
    EXPECT_TRUE(write_picture(picture, folder_ / "c.Png"));
    EXPECT_EQ(files(), (std::vector<std::string>{"a.EXR", "b.hdr", "c.Png"}));
    fs::rename(folder_ / "a.EXR", folder_ / "a");
    fs::rename(folder_ / "b.hdr", folder_ / "b.exr");
    EXPECT_EQ(read_picture(folder_ / "a").depth_m, picture.depth_m);
    EXPECT_EQ(read_picture(folder_ / "b.exr").width, picture.width);
    EXPECT_TRUE(is_picture_file(folder_ / "a"));
    EXPECT_TRUE(is_picture_file(folder_ / "b.exr"));
    EXPECT_FALSE(is_picture_file(folder_ / "c.Png"));
}

TEST_F(PictureFile, PngHasThePixelsOfItsCurve) {
    const Picture picture = sample_picture();
    const auto curve = write_picture(picture, folder_ / "a.png", {.exposure = 0.02});
    ASSERT_TRUE(curve);
    EXPECT_EQ(curve->exposure(), 0.02);
    const PngPixels pixels = read_png(folder_ / "a.png");
    ASSERT_EQ(pixels.width, picture.width);
    ASSERT_EQ(pixels.height, picture.height);
    for (std::size_t i = 0; i < picture.pixel_count(); ++i) {
        const auto shown = curve->srgb(picture.rgb_cd_m2[i]);
        EXPECT_EQ(pixels.rgb[i], unsigned(shown[0]) << 16 | unsigned(shown[1]) << 8 | shown[2]);
    }
}

TEST_F(PictureFile, PngSaysHowItWasMade) {
    Picture picture = sample_picture();
    picture.origin.scene = "Büro.toml";
    const auto curve = write_picture(picture, folder_ / "a.png");
    EXPECT_DOUBLE_EQ(curve->exposure(), automatic_exposure(picture));
    const std::string png = read_text(folder_ / "a.png");
    const auto has = [&](const std::string& text) { return png.find(text) != png.npos; };
    const std::string zero(1, '\0');
    EXPECT_TRUE(has("tEXtExposure" + zero));
    EXPECT_TRUE(has(" per cd/m2"));
    EXPECT_TRUE(
        has("tEXtTone curve" + zero + "linear to 0.5 / exposure, then Reinhard 2002, white at 8 / exposure"));
    EXPECT_TRUE(has("tEXtsoftware" + zero + "Stilb 9.8.7"));
    EXPECT_TRUE(has("iTXtscene" + zero));
    EXPECT_TRUE(has("Büro.toml"));
    EXPECT_TRUE(has("sRGB"));
}

/// The screen's white balance belongs to .png alone: the other formats keep absolute values.
TEST_F(PictureFile, OnlyPngIsAdaptedToTheWhite) {
    const Picture picture = sample_picture();
    const Rgb warm = lights::colour_of_temperature(3000);
    const ToneOptions balanced{.exposure = 0.02, .white = {warm, warm}}, plain{.exposure = 0.02};
    for (const std::string extension : {".exr", ".hdr", ".png"}) {
        const fs::path first = folder_ / ("a" + extension), second = folder_ / ("b" + extension);
        write_picture(picture, first, balanced);
        write_picture(picture, second, plain);
        EXPECT_EQ(read_text(first) == read_text(second), extension != ".png") << extension;
    }
    EXPECT_NE(read_text(folder_ / "a.png").find(std::string("tEXtWhite") + '\0' + "3000 K"),
              std::string::npos);
}

TEST_F(PictureFile, ReplacesWhatIsThere) {
    const fs::path path = folder_ / "a.hdr";
    write_picture(sample_picture(400, 300), path);
    write_picture(sample_picture(10, 5), path);
    EXPECT_EQ(read_picture(path).width, 10);
    EXPECT_EQ(files(), std::vector<std::string>{"a.hdr"});
    // A link stays one; its target changes.
    fs::create_symlink(path, folder_ / "link.hdr");
    write_picture(sample_picture(20, 5), folder_ / "link.hdr");
    EXPECT_TRUE(fs::is_symlink(folder_ / "link.hdr"));
    EXPECT_EQ(read_picture(path).width, 20);
}

TEST_F(PictureFile, NamesWhatIsAllowed) {
    const auto message = [&](const auto& act) -> std::string {
        try {
            act();
        } catch (const InputError& error) {
            return error.what();
        }
        return "nothing thrown";
    };
    const Picture picture = sample_picture();
    EXPECT_NE(message([&] { write_picture(picture, folder_ / "a.jpg"); }).find(".exr, .hdr or .png"),
              std::string::npos);
    EXPECT_NE(message([&] { require_luminance_picture_path("a", {}); }).find(".exr, .hdr or .png"),
              std::string::npos);
    EXPECT_NE(
        message([&] { require_luminance_picture_path("/no/such/a.exr", {}); }).find("no folder '/no/such'"),
        std::string::npos);
    EXPECT_NE(message([&] { write_picture(picture, "/no/such/a.exr"); }).find("/no/such/a.exr'"),
              std::string::npos);
    EXPECT_NO_THROW(require_luminance_picture_path(folder_ / "a.HDR", {}));
    write_file(folder_ / "text.exr", "words");
    EXPECT_NE(message([&] { read_picture(folder_ / "text.exr"); }).find("text.exr: neither an OpenEXR"),
              std::string::npos);
    EXPECT_NE(message([&] { read_picture(folder_ / "none.exr"); }).find("cannot be read"), std::string::npos);
    EXPECT_NE(message([&] { is_picture_file(folder_ / "none.exr"); }).find("cannot be read"),
              std::string::npos);
    EXPECT_NE(message([&] { is_picture_file(folder_); }).find("cannot be read"), std::string::npos);
    Picture wrong = picture;
    wrong.depth_m.pop_back();
    EXPECT_THROW(write_picture(wrong, folder_ / "a.exr"), std::invalid_argument);
}

}  // namespace
}  // namespace stilb::io
