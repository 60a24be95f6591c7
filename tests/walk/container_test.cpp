// Containers hold what was put in, plane by plane.
#include "walk/data/container.h"

#include <gtest/gtest.h>

#include <limits>

#include "walk/container_reader.h"

namespace stilb::walk {
namespace {

using Json = nlohmann::ordered_json;

TEST(Container, GivesBackWhatWasPutIn) {
    const std::vector<float> floats{1.5F, -2.25F, 3e-20F, 4e30F, 0, -7};
    const std::vector<std::uint32_t> words{0, 1, 0xffffffffU, 0x12345678U};
    const std::vector<std::uint16_t> shorts{7, 65535, 256};
    const std::vector<std::int16_t> units{-32767, 0, 32767};
    const std::vector<std::uint16_t> halves{to_half(0.5F), to_half(-1000), to_half(65504)};
    const std::string bytes = container_bytes(
        Json{{"name", "a \xc3\xa4 room"}},
        {make_array("floats", 3, std::span<const float>(floats)),
         make_array("words", 1, std::span<const std::uint32_t>(words)),
         make_array("shorts", 1, std::span<const std::uint16_t>(shorts)),
         make_array("units", 3, std::span<const std::int16_t>(units)), make_half_array("halves", 1, halves)});
    const ContainerReader read(bytes);
    EXPECT_EQ(read.header.at("name"), "a \xc3\xa4 room");
    EXPECT_EQ(read.numbers("floats"), std::vector<double>(floats.begin(), floats.end()));
    EXPECT_EQ(read.count("floats"), 2U);
    EXPECT_EQ(read.numbers("words"), std::vector<double>(words.begin(), words.end()));
    EXPECT_EQ(read.numbers("shorts"), std::vector<double>(shorts.begin(), shorts.end()));
    EXPECT_EQ(read.numbers("units"), (std::vector<double>{-32767, 0, 32767}));
    EXPECT_EQ(read.numbers("halves"), (std::vector<double>{0.5, -1000, 65504}));
}

/// The format itself, byte by byte: pages that were saved must stay readable.
TEST(Container, HasTheStatedLayout) {
    const std::vector<std::uint16_t> values{0x0201, 0x0403, 0x0605, 0x0807};
    const std::string bytes =
        container_bytes(Json::object(), {make_array("a", 2, std::span<const std::uint16_t>(values))});
    const std::string header =
        R"({"arrays":{"a":{"type":"u16","components":2,"count":2,"offset":0,"planes":true}}})";
    EXPECT_EQ(bytes.substr(0, 8), "STILBWLK");
    EXPECT_EQ(bytes.substr(8, 8),
              std::string("\1\0\0\0", 4) + static_cast<char>(header.size()) + std::string("\0\0\0", 3));
    EXPECT_EQ(bytes.substr(16, header.size()), header);
    const std::size_t start = (16 + header.size() + 7) / 8 * 8;
    EXPECT_EQ(bytes.substr(start), std::string("\1\5\2\6\3\7\4\10"));
}

TEST(Container, ArraysStartAtMultiplesOfEight) {
    const std::vector<std::uint16_t> three{1, 2, 3};
    const ContainerReader read(
        container_bytes(Json::object(), {make_half_array("a", 1, three), make_half_array("b", 3, three)}));
    EXPECT_EQ(read.info("b").at("offset"), 8);
    EXPECT_EQ(read.numbers("b").size(), 3U);
}

TEST(Container, TakesEmptyArraysAndNamesThatAreNoText) {
    const ContainerReader read(container_bytes(Json{{"name", "\xff"}}, {make_half_array("none", 3, {})}));
    EXPECT_TRUE(read.numbers("none").empty());
    EXPECT_EQ(read.header.at("name"), "\xef\xbf\xbd");
}

}  // namespace
}  // namespace stilb::walk
