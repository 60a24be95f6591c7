#include "io/text/table.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <thread>

#include "stilb/error.h"
#include "support/picture_pixels.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

using Texts = std::vector<std::string>;
using Numbers = std::vector<double>;

TEST(Table, WritesColumnsAsRfc4180) {
    const std::vector<Column> columns{{"radius [m]", Numbers{0, 0.25}},
                                      {"say \"lx\", please", Texts{"plain", "a,b"}},
                                      {"lines", Texts{"one\ntwo", ""}}};
    EXPECT_EQ(to_csv(columns),
              "radius [m],\"say \"\"lx\"\", please\",lines\r\n"
              "0,plain,\"one\ntwo\"\r\n"
              "0.25,\"a,b\",\r\n");
}

TEST(Table, NumbersComeBackBitForBit) {
    std::mt19937_64 random(3);
    Numbers numbers{0.1, 1.0 / 3, -0.0, 5e-324, std::numeric_limits<double>::max(), 1e22};
    while (numbers.size() < 500) {
        const double number = std::bit_cast<double>(random());
        if (std::isfinite(number)) numbers.push_back(number);
    }
    const std::string csv = to_csv(std::vector<Column>{{"x", numbers}});
    const char* at = csv.c_str() + 3;
    for (const double number : numbers) {
        char* end = nullptr;
        const double back = std::strtod(at, &end);
        EXPECT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(number));
        at = end + 2;
    }
    EXPECT_EQ(*at, '\0');
}

TEST(Table, LeavesCellsWithoutANumberEmpty) {
    EXPECT_EQ(to_csv(std::vector<Column>{{"a", Numbers{NAN, 1}}, {"b", Numbers{2, NAN}}}),
              "a,b\r\n,2\r\n1,\r\n");
}

TEST(Table, RefusesColumnsOfDifferentLengths) {
    EXPECT_THROW(to_csv(std::vector<Column>{{"a", Numbers{1}}, {"b", Texts{}}}), std::invalid_argument);
}

TEST(Table, WritesFiles) {
    const std::vector<Column> columns{{"a", Numbers{1}}};
    const TestFolder folder;
    const auto path = folder / "a.csv";
    write_csv(columns, path);
    EXPECT_EQ(read_text(path), to_csv(columns));
    EXPECT_THROW(write_csv(columns, "/no/such/folder/a.csv"), InputError);
}

/// The names of temporary files are no longer than those of files may be.
TEST(Table, WritesFilesWithTheLongestNames) {
    const TestFolder folder;
    for (const std::size_t length : {245u, 246u, 247u, 255u}) {
        const auto path = folder / std::string(length, 'n');
        require_writable(path);
        replace_file(path, "content");
        EXPECT_EQ(read_text(path), "content") << length;
    }
}

TEST(Table, ReplacesFilesInOneStepAndLeavesLinks) {
    const TestFolder folder;
    const auto path = folder / "a.txt", link = folder / "a.link", loose = folder / "a.loose";
    replace_file(path, "old");
    std::filesystem::create_symlink(path, link);
    const std::ifstream reader(path);
    replace_file(link, "new");
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_EQ(read_text(path), "new");
    EXPECT_EQ((std::stringstream() << reader.rdbuf()).str(), "old");  // it was never emptied
    std::filesystem::create_symlink(path.string() + ".target", loose);
    replace_file(loose, "through a link to no file");
    EXPECT_EQ(read_text(path.string() + ".target"), "through a link to no file");
    const std::vector<std::string> parts{"in ", "", "parts"};
    replace_file(link, parts);
    EXPECT_EQ(read_text(path), "in parts");
    replace_file("/dev/null", "nowhere");
    EXPECT_THROW(replace_file("/no/such/folder/a", ""), InputError);
}

TEST(Table, NamesTheFileThatIsUnfinished) {
    const TestFolder folder;
    const auto path = folder / "a.bin";
    EXPECT_EQ(unfinished_file(), nullptr);
    const std::string content(std::size_t{1} << 27, 'x');  // takes long enough to be seen unfinished
    std::thread writer([&] { replace_file(path, content); });
    const char* file = nullptr;
    while (file == nullptr) file = unfinished_file();
    EXPECT_TRUE(std::string(file).starts_with(std::filesystem::canonical(path.parent_path()).string()));
    writer.join();
    EXPECT_EQ(unfinished_file(), nullptr);
    EXPECT_EQ(std::filesystem::file_size(path), content.size());
}

}  // namespace
}  // namespace stilb::io
