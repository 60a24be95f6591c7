#include "io/text/file_kind.h"

#include <gtest/gtest.h>

#include "stilb/error.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

namespace fs = std::filesystem;

TEST(FileKind, IsToldByTheBeginning) {
    EXPECT_EQ(kind_of_content(""), FileKind::empty);
    EXPECT_EQ(kind_of_content("\x76\x2f\x31\x01..."), FileKind::exr_picture);
    EXPECT_EQ(kind_of_content("#?RADIANCE\n"), FileKind::hdr_picture);
    EXPECT_EQ(kind_of_content("\x89PNG\r\n\x1a\n"), FileKind::png_picture);
    EXPECT_EQ(kind_of_content("<?xml version=\"1.0\"?>\n<svg width=\"1\"/>"), FileKind::svg_drawing);
    EXPECT_EQ(kind_of_content("STILBSOL\x01"), FileKind::solution);
    EXPECT_EQ(kind_of_content("<!doctype html>\n<head>\n" + std::string(kWalkMark)), FileKind::walk);
    EXPECT_EQ(kind_of_content("<!DOCTYPE html>\n<head>" + std::string(kReportMark)), FileKind::report);
    EXPECT_EQ(kind_of_content("<!doctype html>\n<head>\n<title>x</title>"), FileKind::other);
    EXPECT_EQ(kind_of_content("{\n\"format\": \"stilb-harmonics\""), FileKind::series);
    EXPECT_EQ(kind_of_content("{ \"stilb\": \"0.1.0\", \"attained_error\": 0.01"), FileKind::results);
    EXPECT_EQ(kind_of_content("{\"asset\": {\"version\": \"2.0\"}"), FileKind::gltf_scene);
    EXPECT_EQ(kind_of_content("{\"name\": \"x\"}"), FileKind::json);
    EXPECT_EQ(kind_of_content("ply\nformat ascii 1.0\n"), FileKind::ply_mesh);
    EXPECT_EQ(kind_of_content("IESNA:LM-63-2002\n"), FileKind::ies_luminaire);
    EXPECT_EQ(kind_of_content("# A scene\n[scene]\nname = \"x\"\n"), FileKind::other);
    EXPECT_EQ(kind_of_content(" \n"), FileKind::other);
    EXPECT_EQ(kind_of_content("\xEF\xBB\xBFIES:LM-63-2019\n"), FileKind::ies_luminaire);
    EXPECT_EQ(kind_of_content("ANSI/IES LM-63-19\n"), FileKind::ies_luminaire);
}

TEST(FileKind, FilesOfOtherProgramsAreNamed) {
    EXPECT_EQ(kind_of_content("LOCATION,Berlin,-,DEU,IWEC,103840,52.47"), FileKind::weather);
    EXPECT_EQ(kind_of_content("<?xml version=\"1.0\"?><WindowElement/>"), FileKind::scattering);
    EXPECT_EQ(kind_of_content("#?RADIANCE\noconv a.rad\nFORMAT=Radiance_octree\n"), FileKind::octree);
    EXPECT_EQ(kind_of_content("AC1032"), FileKind::drawing);
    EXPECT_EQ(kind_of_name("a.DXF"), FileKind::drawing);
    EXPECT_EQ(kind_of_name("a.uld"), FileKind::luminaire_of_another_kind);
    EXPECT_EQ(kind_of_name("a.skp"), FileKind::model);
    for (const char* name : {"a.epw", "a.dxf", "a.oct", "a.uld", "a.fbx"}) {
        EXPECT_FALSE(may_be_scene_file(kind_of_name(name)));
        EXPECT_GT(not_a_scene(kind_of_name(name)).size(), 60u);
    }
}

class FilesOfKinds : public testing::Test {
  protected:
    fs::path file(const std::string& name, const std::string& content) const {
        return folder_.write(name, content);
    }

    static std::string refusal(const fs::path& output, FileKind kind, const std::vector<fs::path>& inputs) {
        try {
            require_output(output, kind, inputs);
            return "";
        } catch (const InputError& error) {
            return error.what();
        }
    }

    const TestFolder folder_;
};

TEST_F(FilesOfKinds, TheContentCountsMoreThanTheName) {
    EXPECT_EQ(kind_of_file(file("a.obj", "ply\n")), FileKind::ply_mesh);
    EXPECT_EQ(kind_of_file(file("b.GLB", "words")), FileKind::gltf_scene);
    EXPECT_EQ(kind_of_file(file("c.gltf", "{\"scenes\": []}")), FileKind::gltf_scene);
    EXPECT_EQ(kind_of_file(file("d.ldt", "")), FileKind::eulumdat_luminaire);
    EXPECT_EQ(kind_of_file(file("e.toml", "words")), FileKind::other);
    EXPECT_EQ(kind_of_file(file("f.toml", "STILBSOL")), FileKind::solution);
    EXPECT_THROW(kind_of_file(folder_ / "none.exr"), InputError);
    EXPECT_THROW(kind_of_file(folder_), InputError);
}

TEST_F(FilesOfKinds, OutputsMayReplaceFilesOfTheirKindAndEmptyOnes) {
    EXPECT_EQ(refusal(folder_ / "new.png", FileKind::png_picture, {}), "");
    EXPECT_EQ(refusal(file("old.png", "\x89PNG\r\n\x1a\n"), FileKind::png_picture, {}), "");
    EXPECT_EQ(refusal(file("empty.png", ""), FileKind::png_picture, {}), "");
    EXPECT_EQ(refusal("/dev/null", FileKind::png_picture, {}), "");
    const std::string message =
        refusal(file("s.json", "{\"format\": \"stilb-harmonics\""), FileKind::results, {});
    EXPECT_NE(
        message.find("s.json: this file exists and is a surface by spherical harmonics, but the result is a "
                     "document with results."),
        message.npos)
        << message;
    EXPECT_NE(refusal(file("room.toml", "words"), FileKind::solution, {}), "");
    EXPECT_NE(refusal(folder_ / "none" / "x", FileKind::solution, {}).find("there is no folder"),
              message.npos);
}

TEST_F(FilesOfKinds, OutputsNeverReplaceInputs) {
    const fs::path input = file("series.json", "{\"format\": \"stilb-harmonics\"");
    fs::create_symlink(input, folder_ / "soft.json");
    fs::create_hard_link(input, folder_ / "hard.json");
    for (const fs::path& output :
         {input, folder_ / "." / "series.json", folder_ / "soft.json", folder_ / "hard.json"}) {
        const std::string message = refusal(output, FileKind::series, {folder_ / "none", input});
        EXPECT_NE(message.find("cannot be written over '" + input.string() + "'"), message.npos) << message;
    }
    EXPECT_EQ(refusal(folder_ / "other.json", FileKind::series, {input}), "");
}

}  // namespace
}  // namespace stilb::io
