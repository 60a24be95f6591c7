#include "io/text/compression.h"

#include <gtest/gtest.h>

#include "math/random.h"

namespace stilb::io {
namespace {

std::string sample_text(std::size_t size) {
    std::string bytes;
    for (std::uint64_t i = 0; bytes.size() < size; ++i)
        bytes += static_cast<char>(i % 3 == 0 ? math::random_block({}, i, 0)[0] & 255 : 'a');
    return bytes;
}

TEST(Compression, GivesBackTheBytes) {
    for (const std::size_t size : {0, 1, 65536, 1'000'003}) {
        const std::string bytes = sample_text(size), compressed = gzip(bytes);
        EXPECT_EQ(gunzip(compressed, size), bytes) << size;
        EXPECT_EQ(compressed, gzip(bytes));
    }
}

TEST(Compression, OtherSizesAndDamagesAreNoticed) {
    const std::string compressed = gzip(sample_text(100'000));
    for (const std::size_t size : {std::size_t{0}, std::size_t{99'999}, std::size_t{100'001}})
        EXPECT_FALSE(gunzip(compressed, size)) << size;
    EXPECT_FALSE(gunzip(compressed + "x", 100'000));
    EXPECT_FALSE(gunzip(std::string_view(compressed).substr(0, compressed.size() - 1), 100'000));
    EXPECT_FALSE(gunzip("", 0));
    std::string damaged = compressed;
    damaged[compressed.size() / 2] ^= 1;
    EXPECT_FALSE(gunzip(damaged, 100'000));
}

}  // namespace
}  // namespace stilb::io
