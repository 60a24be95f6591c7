#include "io/text/utf8.h"

#include <gtest/gtest.h>

#include "io/import/rtrace.h"
#include "io/import/view_file.h"
#include "io/mesh/mesh_file.h"
#include "io/scene/scene_file.h"
#include "stilb/error.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

using namespace std::string_literals;

const std::string kMark = "\xEF\xBB\xBF";

std::filesystem::path file(const std::string& extension, const std::string& content) {
    static const TestFolder folder;
    return folder.write("a" + extension, content);
}

TEST(Utf8, TextStartsBehindAByteOrderMark) {
    EXPECT_EQ(text_of(kMark + "a", "n"), "a");
    EXPECT_EQ(text_of("a" + kMark, "n"), "a" + kMark);
    EXPECT_EQ(text_of("", "n"), "");
    EXPECT_EQ(read_text_file(file(".txt", kMark + "one\n")), "one\n");
}

TEST(Utf8, RefusesUtf16) {
    for (const std::string& text : {"\xFF\xFEI\0E\0"s, "\xFE\xFF\0I\0E"s, "I\0E\0S\0"s, "\0I\0E\0S"s}) {
        try {
            text_of(text, "a.ies");
            ADD_FAILURE() << "accepted";
        } catch (const InputError& error) {
            EXPECT_STREQ(error.what(), "a.ies: is text in UTF-16. Save it as UTF-8.");
        }
    }
    for (const std::string& text : {"I\0\0\0"s, "IES\0"s, "\0\0\0\0"s, "I\0E"s})
        EXPECT_EQ(text_of(text, "n"), text);
}

TEST(Utf8, AllTextFilesMayHaveAMark) {
    EXPECT_EQ(read_points(file(".pts", kMark + "1 2 3 0 0 1\n")).size(), 1u);
    const auto view = file(".vf", kMark + "rvu -vtv -vp 1 1 1.6 -vd 1 1 0 -vu 0 0 1 -vh 60 -vv 40\n");
    EXPECT_EQ(read_view_file(view).camera.position, (Vec3{1, 1, 1.6}));
    EXPECT_EQ(
        read_mesh_file(file(".obj", kMark + "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).mesh.triangles.size(),
        1u);
    const auto scene = file(".toml", kMark + "[scene]\nname = \"marked\"\n");
    EXPECT_EQ(read_scene_file(scene).scene.name, "marked");
    EXPECT_THROW(read_mesh_file(file(".obj", "\xFF\xFEv\0 \0000\0"s)), InputError);
}

TEST(Utf8, OtherBytesAreReadAsLatin1) {
    EXPECT_EQ(as_utf8("Gl\xFChlampe \xC3\xBC "), "Gl\xC3\xBChlampe \xC3\xBC ");
    EXPECT_EQ(printable("\ta\x1B[2J\n"), "a [2J");
}

TEST(Utf8, StaysAsItIs) {
    // The first and last printable characters of one to four bytes.
    for (const std::string text : {"", "plain", "~", "\xc2\xa0", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf",
                                   "\xee\x80\x80", "\xef\xbf\xbf", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"})
        EXPECT_EQ(as_utf8(text), text);
}

TEST(Utf8, IncompleteOrForbiddenSequencesAreLatin1) {
    // Cut off, overlong, surrogates, beyond the last character.
    for (const std::string text : {"\xc3", "\xe2\x82", "\xc1\xbf", "\xe0\x9f\xbf", "\xf0\x8f\xbf\xbf",
                                   "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80"}) {
        const std::string converted = as_utf8(text);
        EXPECT_NE(converted, text);
        EXPECT_EQ(as_utf8(converted), converted);
    }
}

}  // namespace
}  // namespace stilb::io
