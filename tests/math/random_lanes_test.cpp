#include "math/random_lanes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/lane_functions.h"
#include "math/sampling.h"

namespace stilb::math {
namespace {

TEST(RandomLanes, AreTheNumbersOfSingleStreams) {
    constexpr unsigned sobol_dimensions = 8;
    StreamPacket packet;
    std::vector<SampleStream> streams;
    for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
        // Some have Sobol' points for two blocks more, some for one, some for none.
        streams.push_back(
            SampleStream({0x123456789abcdefull * (lane + 1)}, lane * 0x1'2345'6789ull, sobol_dimensions)
                .from(static_cast<unsigned>(4 * (lane % 3))));
        packet.set(lane, streams.back());
    }
    for (int block = 0; block < 4; ++block) {
        const NumberPacket numbers = next_four(packet, sobol_dimensions);
        for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
            for (std::size_t d = 0; d < 4; ++d)
                EXPECT_EQ(unit_interval(numbers.words[d][lane]), streams[lane].next()) << lane << ' ' << d;
        }
    }
    SampleStream one = packet.stream(5, sobol_dimensions);
    EXPECT_EQ(one.next(), streams[5].next());
}

TEST(RandomLanes, DeriveTheKeysOfSingleOnes) {
    const RandomKey key{0xfedcba9876543210ull};
    StreamPacket packet;
    StreamPacket::Words parts;
    for (std::size_t lane = 0; lane < kPacketWidth; ++lane)
        parts[lane] = static_cast<std::uint32_t>(lane * lane * 77);
    set_derived_keys(key, parts, packet);
    for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
        EXPECT_EQ(packet.stream(lane, 0).key().value, key.derived(parts[lane]).value);
    }
}

/// Neither their mean depends on a number, nor on each other.
TEST(RandomLanes, HashedNumbersAreUniformAndIndependent) {
    StreamPacket packet;
    for (std::size_t lane = 0; lane < kPacketWidth; ++lane) packet.set(lane, SampleStream({7}, lane, 0));
    constexpr int rounds = 1 << 14;
    double sum = 0, with_first = 0, with_other = 0;
    for (int i = 0; i < rounds; ++i) {
        const NumberPacket numbers = next_four(packet, 0);
        for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
            const double u = lane_unit_interval(numbers.hashed(lane, 0)) - 0.5;
            sum += u;
            with_first += u * (unit_interval(numbers.words[0][lane]) - 0.5);
            with_other += u * (lane_unit_interval(numbers.hashed(lane, 1)) - 0.5);
        }
    }
    const double count = rounds * double{kPacketWidth};
    EXPECT_LT(std::abs(sum), 4 * std::sqrt(count / 12));
    EXPECT_LT(std::abs(with_first), 4 * std::sqrt(count) / 12);
    EXPECT_LT(std::abs(with_other), 4 * std::sqrt(count) / 12);
}

TEST(LaneFunctions, AgreeWithTheStandardLibrary) {
    for (int i = -1000; i <= 1000; ++i) {
        const float x = static_cast<float>(i) / 1000 * 1.5707963f;
        const auto [sine, cosine] = lane_sine_cosine(x);
        EXPECT_NEAR(sine, std::sin(double{x}), 2e-7);
        EXPECT_NEAR(cosine, std::cos(double{x}), 2e-7);
        const float angle = 2 * x;
        const float y = 3 * std::sin(angle), z = 3 * std::cos(angle);
        EXPECT_NEAR(lane_atan2(y, z), std::atan2(double{y}, double{z}), 5e-7);
    }
    EXPECT_EQ(lane_atan2(0, 0), 0);
}

TEST(LaneFunctions, MapToTheDiskAsInDoublePrecision) {
    for (int i = 0; i <= 32; ++i) {
        for (int j = 0; j <= 32; ++j) {
            const float u1 = static_cast<float>(i) / 32, u2 = static_cast<float>(j) / 32;
            const auto [x, y] = lane_unit_disk(u1, u2);
            const DiskPoint exact = sample_unit_disk(u1, u2);
            EXPECT_NEAR(x, exact.x, 5e-7);
            EXPECT_NEAR(y, exact.y, 5e-7);
        }
    }
}

}  // namespace
}  // namespace stilb::math
