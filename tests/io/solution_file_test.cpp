#include "io/results/solution_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include "base/version.h"
#include "io/text/compression.h"
#include "io/text/text.h"
#include "materials/diffuse.h"
#include "materials/phong.h"
#include "run/solve.h"
#include "stilb/error.h"
#include "support/scene_builder.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

/// Of a room with a glossy floor and a lamp.
StoredSolution sample_solution() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {2, 2, 2}}, Diffuse{Rgb::grey(0.5)});
    add_object(scene, Rectangle{{0, 0, 0.1}, {2, 0, 0}, {0, 2, 0}}, Phong{Rgb::grey(0.3), Rgb::grey(0.4), 5});
    add_point_light(scene, {1, 1, 1.5}, Rgb::grey(100));
    RunOptions options;
    options.paths = 8;
    options.patch_m = 2;
    SolveResult result = solve(scene, options, 2);
    return {"0.1.0", "rooms/room.toml",         "0123456789abcdef", 7, result.samples,
            0.02,    std::move(result.solution)};
}

const std::string& sample_bytes() {
    static const std::string bytes = to_bytes(sample_solution());
    return bytes;
}

std::string message_of(const std::string& bytes) {
    try {
        read_solution(bytes, "a.solution");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

/// Compressed, and with a header that fits.
std::string message_of_contents(const std::string& contents) {
    return message_of(solution_file_of(contents));
}

/// Before compression.
std::string sample_contents() {
    const std::string& bytes = sample_bytes();
    std::uint64_t size = 0;
    std::memcpy(&size, bytes.data() + 28, sizeof size);
    return gunzip(std::string_view(bytes).substr(36), size).value();
}

TEST(SolutionFile, KeepsEveryBit) {
    const StoredSolution written = sample_solution();
    const StoredSolution read = read_solution(to_bytes(written), "a.solution");
    EXPECT_EQ(read.version, written.version);
    EXPECT_EQ(read.scene, written.scene);
    EXPECT_EQ(read.light_hash, written.light_hash);
    EXPECT_EQ(read.seed, written.seed);
    EXPECT_EQ(read.steps, written.steps);
    EXPECT_EQ(read.attained_error, written.attained_error);
    EXPECT_EQ(read.solution.degree, written.solution.degree);
    EXPECT_EQ(read.solution.groups, written.solution.groups);
    EXPECT_EQ(read.solution.lit_vertices, written.solution.lit_vertices);
    EXPECT_EQ(read.solution.terms, written.solution.terms);
    EXPECT_EQ(read.solution.replicates, written.solution.replicates);
    EXPECT_EQ(read.solution.bias, written.solution.bias);
    EXPECT_EQ(read.solution.patches.corners, written.solution.patches.corners);
    EXPECT_EQ(to_bytes(read), to_bytes(written));
}

TEST(SolutionFile, SidesWithoutLightCostNothing) {
    const estimators::PatchSolution solution = sample_solution().solution;
    const std::uint32_t first_of_floor = solution.patches.corners[solution.patches.first_of_object[1]][0];
    for (const std::uint32_t side : solution.lit_vertices) {
        EXPECT_GE(side, first_of_floor) << "an outer side of the room";
    }
}

/// The offsets that the format's page states.
TEST(SolutionFile, BeginsAsDocumented) {
    const std::string& bytes = sample_bytes();
    const auto number_at = [&](std::size_t offset, auto number) {
        std::memcpy(&number, bytes.data() + offset, sizeof number);
        return number;
    };
    EXPECT_EQ(bytes.substr(0, 8), "STILBSOL");
    EXPECT_EQ(number_at(8, std::uint32_t{}), 3u);
    EXPECT_EQ(number_at(12, std::uint64_t{}), bytes.size());
    const std::string contents = sample_contents();
    EXPECT_EQ(number_at(28, std::uint64_t{}), contents.size());
    EXPECT_EQ(contents.substr(0, 13), std::string("\5\0\0\0\0\0\0\0"
                                                  "0.1.0",
                                                  13));
}

TEST(SolutionFile, NamesWhatIsWrong) {
    const std::string& good = sample_bytes();
    EXPECT_EQ(message_of(good), "accepted");
    EXPECT_EQ(message_of(""), "a.solution: not a solution: the file does not begin with STILBSOL.");
    EXPECT_EQ(message_of("[scene]\nname = \"a room\"\n"), message_of(""));
    EXPECT_EQ(message_of("STILBSOL\1"),
              "a.solution: damaged at byte 8 of its contents: the file ends before the version. Solve the "
              "scene again.");
    std::string other = good;
    other[8] = 9;
    EXPECT_EQ(message_of(other), "a.solution: the solution is of version 9, but Stilb " +
                                     std::string(program_version()) +
                                     " reads version 3. Solve the scene again.");
    EXPECT_EQ(message_of(good.substr(0, good.size() - 1)),
              "a.solution: the file has " + std::to_string(good.size() - 1) + " bytes instead of " +
                  std::to_string(good.size()) +
                  ": it was cut off or extended. Copy it again, or solve the scene again.");
    EXPECT_EQ(message_of(good + "x").substr(0, 26),
              "a.solution: the file has " + std::to_string(good.size() + 1).substr(0, 1));
    other = good;
    other[good.size() / 2] ^= 1;
    EXPECT_EQ(message_of(other),
              "a.solution: damaged: the contents do not match the stored hash. Copy the file again, or solve "
              "the scene again.");
}

/// With a hash that fits: no memory is taken for what is not there.
TEST(SolutionFile, CountsAreHeldAgainstTheFile) {
    const std::string body = sample_contents();
    std::string huge = body;
    huge[6] = 0x7f;
    EXPECT_EQ(message_of_contents(huge),
              "a.solution: damaged at byte 8 of its contents: Stilb's version: 35747322042253317 entries are "
              "expected, but only " +
                  std::to_string(body.size() - 8) + " bytes are left. Solve the scene again.");
    for (std::size_t length = 0; length < body.size(); length += 7)
        EXPECT_NE(message_of_contents(body.substr(0, length)).find("damaged at byte"), std::string::npos)
            << length;
    EXPECT_NE(message_of_contents(body + "abc").find("3 surplus bytes"), std::string::npos);
}

/// A file that pretends to be larger than it is takes no memory for that.
TEST(SolutionFile, SizesOfContentsAreChecked) {
    const std::string contents = sample_contents();
    const auto with_size = [&](std::uint64_t size) {
        std::string body(sizeof size, '\0');
        std::memcpy(body.data(), &size, sizeof size);
        body += gzip(contents);
        std::string file = solution_file_of(contents).substr(0, 12);
        const std::uint64_t whole = 28 + body.size(), hash = hash_of(body);
        file.append(reinterpret_cast<const char*>(&whole), sizeof whole);
        file.append(reinterpret_cast<const char*>(&hash), sizeof hash);
        return message_of(file + body);
    };
    EXPECT_EQ(with_size(contents.size()), "accepted");
    for (const std::uint64_t size : {contents.size() - 1, contents.size() + 1})
        EXPECT_NE(with_size(size).find("cannot be decompressed"), std::string::npos);
    EXPECT_NE(with_size(std::uint64_t{1} << 60).find("are too large"), std::string::npos);
}

TEST(SolutionFile, IsWrittenAndRead) {
    const TestFolder folder;
    const auto path = folder / "a.solution";
    write_solution_file(sample_solution(), path);
    EXPECT_EQ(read_whole_file(path), sample_bytes());
    EXPECT_EQ(read_solution_file(path).scene, "rooms/room.toml");
    std::filesystem::remove(path);
    EXPECT_THROW(read_solution_file(path), InputError);
}

}  // namespace
}  // namespace stilb::io
