// Files that are read piece by piece: nothing changes where a piece ends.
#include "io/text/unread_bytes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>

#include "io/import/obj/obj_scene.h"
#include "io/mesh_checks.h"
#include "io/text/text.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

constexpr std::array<std::size_t, 8> kPieceSizes{1, 2, 3, 5, 7, 16, 61, 1000};

std::filesystem::path written(const std::string& content) {
    static const TestFolder folder;
    return folder.write("pieces", content);
}

struct Line {
    std::string text;
    std::size_t number;
    bool operator==(const Line&) const = default;
};

std::vector<Line> lines_of(UnreadBytes bytes) {
    std::vector<Line> lines;
    for (TextLines text(bytes); text.next();) lines.push_back({std::string(text.line()), text.number()});
    return lines;
}

/// What the reader makes of a file in pieces, as text: the mesh, or the message.
std::string read_in_pieces(MeshReader read, const std::filesystem::path& path, std::size_t piece_size) {
    FilePieces file(path, Monitor::none(), piece_size);
    try {
        return to_obj(read(file, "room").mesh);
    } catch (const InputError& error) {
        return error.what();
    }
}

/// Expects the same from a file in pieces of any size as from the content in memory, which it returns.
std::string expect_same_in_pieces(MeshReader read, const std::string& content) {
    std::string whole = refusal(read, content);
    if (whole == "accepted") whole = to_obj(read(content, "room").mesh);
    const std::filesystem::path path = written(content);
    for (const std::size_t size : kPieceSizes)
        EXPECT_EQ(read_in_pieces(read, path, size), whole) << "in pieces of " << size << " bytes";
    return whole;
}

TEST(UnreadBytes, LinesOfAFileInPieces) {
    const std::string long_line(5000, 'x');
    const std::string content = "first\r\n\n\r\nshort\n" + long_line + "\nlast without an end";
    const std::vector<Line> expected{{"first", 1}, {"", 2},        {"", 3},
                                     {"short", 4}, {long_line, 5}, {"last without an end", 6}};
    EXPECT_EQ(lines_of(content), expected);
    for (const std::size_t size : kPieceSizes) {
        FilePieces file(written(content), Monitor::none(), size);
        EXPECT_EQ(lines_of(file), expected) << size;
        EXPECT_EQ(file.left(), 0u);
    }
}

TEST(UnreadBytes, AnEmptyFileHasNoLines) {
    FilePieces file(written(""));
    EXPECT_TRUE(lines_of(file).empty());
}

TEST(UnreadBytes, SizeCountsWhatIsNotInMemoryYet) {
    FilePieces file(written("0123456789"), Monitor::none(), 4);
    UnreadBytes bytes(file);
    EXPECT_EQ(bytes.in_memory(), "0123");
    EXPECT_EQ(bytes.size(), 10u);
    bytes.remove_prefix(3);
    EXPECT_EQ(bytes.size(), 7u);
    EXPECT_TRUE(bytes.extend());
    EXPECT_EQ(bytes.in_memory(), "34567");
    EXPECT_TRUE(bytes.extend());
    EXPECT_EQ(bytes.in_memory(), "3456789");
    EXPECT_FALSE(bytes.extend());
}

TEST(UnreadBytes, AMonitorTakesTheShareAndInterrupts) {
    std::atomic<bool> interrupt = false;
    std::vector<double> shares;
    std::string last_stage;
    const Monitor monitor(&interrupt, std::nullopt, [&](std::string_view stage, double share) {
        last_stage = stage;
        shares.push_back(share);
    });
    FilePieces file(written("0123456789"), monitor, 5);
    UnreadBytes bytes(file);
    EXPECT_EQ(last_stage, "reading pieces");
    EXPECT_EQ(shares, std::vector{0.5});
    interrupt = true;
    EXPECT_THROW(bytes.extend(), Cancelled);
}

TEST(UnreadBytes, ObjFilesInPieces) {
    const std::string corners = "v 0 0 0\r\nv 1.25e0 0 0\nv 1 1 \\\n 0\nv 0 1 0";
    const std::string read = expect_same_in_pieces(
        read_obj, "\xef\xbb\xbf# a comment " + std::string(300, '-') + "\\\n" + corners +
                      "\n\n  # another\no one\nvn 0 0 1\nf 1//1 2//1 3//1 # behind\nf 1 \\\r\n3 \\\r\n4");
    EXPECT_NE(read.find("f 1 3 4"), read.npos) << read;
}

TEST(UnreadBytes, MistakesInObjFilesInPieces) {
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
    for (const auto& [end, line] : {std::pair{"f 1 2 4\n", ":4: "},
                                    {"f 1 \\\n2 3\nf 1 9", ":6: "},
                                    {"v 0 0 1e\n", ":4: "},
                                    {"f 1 2 3\nv 0 \1 0\n", ":5: "},
                                    {"f 1 9 \\", ":4: "},
                                    {"face 1 2 3", ":4: "}}) {
        const std::string message = expect_same_in_pieces(read_obj, corners + end);
        EXPECT_NE(message.find(line), message.npos) << message;
    }
}

Mesh wavy_mesh() {
    Mesh mesh;
    constexpr std::uint32_t n = 12;
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j)
            mesh.vertices.push_back({0.5 * i, 0.25 * j, std::sin(static_cast<double>(i + j))});
    }
    for (std::uint32_t i = 0; i + n + 1 < n * n; ++i) {
        if ((i + 1) % n != 0) mesh.triangles.push_back({i, i + 1, i + n});
    }
    return mesh;
}

TEST(UnreadBytes, PlyFilesInPieces) {
    const std::string binary = to_ply(wavy_mesh(), PlyNumbers::float64);
    EXPECT_EQ(expect_same_in_pieces(read_ply, binary), to_obj(wavy_mesh()));
    expect_same_in_pieces(read_ply, binary.substr(0, binary.size() - 2));
    EXPECT_NE(expect_same_in_pieces(read_ply, binary + "more").find("4 bytes follow"), std::string::npos);
    const std::string text =
        "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float x\r\nproperty float y\r\nproperty "
        "float "
        "z\r\nproperty list uchar int tags\r\nelement face 1\r\nproperty list uchar int vertex_indices\r\n"
        "end_header\r\n0 0 0 0\r\n1 0 0 2 7 8\r\n0 1 0 1 9\r\n3 0 1 2";
    EXPECT_NE(expect_same_in_pieces(read_ply, text).find("f 1 2 3"), std::string::npos);
    EXPECT_NE(
        expect_same_in_pieces(read_ply, text + "\n\n" + std::string(40, ' ') + "x").find("bytes follow"),
        std::string::npos);
    EXPECT_NE(expect_same_in_pieces(read_ply, text.substr(0, text.size() - 2)).find(":14: "),
              std::string::npos);
}

TEST(UnreadBytes, BinaryListsAreSkippedAcrossPieces) {
    std::string ply =
        "ply\nformat binary_big_endian 1.0\nelement other 1\nproperty list ushort double numbers\nelement "
        "vertex "
        "3\nproperty char x\nproperty char y\nproperty char z\nelement face 1\nproperty list uchar uchar "
        "vertex_indices\nend_header\n";
    ply += std::string{1, 0} + std::string(256 * 8, 'n');  // 256 numbers
    ply += std::string{0, 0, 0, 1, 0, 0, 0, 1, 0} + std::string{3, 0, 1, 2};
    EXPECT_EQ(expect_same_in_pieces(read_ply, ply), to_obj({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}));
}

TEST(UnreadBytes, MaterialsAreNamedAcrossABorder) {
    const std::string statement = "\nmtllib room.mtl\n";
    for (std::size_t before = 0; before <= statement.size(); ++before) {
        const std::string comment = "#" + std::string(FilePieces::kPieceSize - 1 - before, ' ');
        EXPECT_TRUE(names_materials(written(comment + statement + "v 0 0 0\n"))) << before;
    }
    EXPECT_TRUE(names_materials(written("mtllib room.mtl\n")));
    EXPECT_FALSE(names_materials(written("# mtllib\nv 0 0 0\n")));
    EXPECT_FALSE(names_materials(written("")));
}

TEST(UnreadBytes, TheHashIsThatOfTheWholeFile) {
    std::string content(2 * FilePieces::kPieceSize + 100, ' ');
    for (std::size_t i = 0; i < content.size(); ++i) content[i] = static_cast<char>(i * i % 251);
    const std::vector files{written(content)};
    EXPECT_EQ(content_hash(files), fmt::format("{:016x}", hash_of(content)));
}

}  // namespace
}  // namespace stilb::io
