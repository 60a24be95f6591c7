// Paces of packets of readings.
#include <gtest/gtest.h>

#include <array>

#include "estimators/estimator.h"

namespace stilb::estimators {
namespace {

TEST(Pace, TakesAllThenOneOfEach) {
    const Pace pace{8, 4};
    EXPECT_EQ(pace.taken(0), 0u);
    EXPECT_EQ(pace.taken(8), 8u);
    EXPECT_EQ(pace.taken(9), 9u);
    EXPECT_EQ(pace.taken(12), 9u);
    EXPECT_EQ(pace.taken(13), 10u);
    EXPECT_EQ(pace.taken(48), 18u);
}

TEST(Pace, OfOneTakesAll) {
    for (const std::uint64_t samples : {0u, 1u, 7u, 100u}) EXPECT_EQ((Pace{3, 1}.taken(samples)), samples);
}

TEST(Batch, NumbersAPacketsSamplesWithoutGaps) {
    const std::array<Pace, 2> paces{{{2, 1}, {2, 3}}};
    std::uint64_t next = 0;
    for (const std::uint64_t first : {0u, 1u, 4u, 9u}) {
        const std::uint64_t count = first == 0 ? 1 : first == 1 ? 3 : first == 4 ? 5 : 7;
        const Batch batch{math::RandomKey{1}, first, count, paces};
        EXPECT_EQ(batch.of_packet(0).first, first);
        EXPECT_EQ(batch.of_packet(0).count, count);
        const Batch own = batch.of_packet(1);
        EXPECT_EQ(own.first, next);
        next += own.count;
    }
    EXPECT_EQ(next, paces[1].taken(16));
    const Batch all{math::RandomKey{1}, 5, 7};
    EXPECT_EQ(all.of_packet(9).first, 5u);
    EXPECT_EQ(all.of_packet(9).count, 7u);
}

}  // namespace
}  // namespace stilb::estimators
