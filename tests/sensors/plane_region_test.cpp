#include "sensors/areas/plane_region.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace stilb::sensors {
namespace {

const Ring kSquare{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
/// The letter L.
const Ring kL{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};

Ring moved(Ring ring, double dx, double dy, double factor = 1) {
    for (PlanePoint& p : ring) p = {factor * p.x + dx, factor * p.y + dy};
    return ring;
}

TEST(PlaneRegion, AreasHaveASign) {
    EXPECT_EQ(doubled_area(kSquare), 32);
    EXPECT_EQ(doubled_area(kL), 14);
    EXPECT_EQ(doubled_area({kL.rbegin(), kL.rend()}), -14);
}

TEST(PlaneRegion, ContainsItsInside) {
    EXPECT_TRUE(contains(kL, {0.5, 3.9}, 0));
    EXPECT_TRUE(contains(kL, {3.9, 0.5}, 0));
    EXPECT_FALSE(contains(kL, {2, 2}, 0));
    EXPECT_FALSE(contains(kL, {-0.1, 1}, 0));
    EXPECT_TRUE(contains(kL, {2, 1.05}, 0.1));
    EXPECT_FALSE(contains(kL, {2, 1.15}, 0.1));
}

/// The share of random points is the share of the area, for a star with re-entrant corners, either way round.
TEST(PlaneRegion, ContainsAsManyPointsAsItsArea) {
    Ring star;
    for (int i = 0; i < 14; ++i) {
        const double radius = i % 2 == 0 ? 1 : 0.3, angle = 0.1 + 2 * M_PI * i / 14;
        star.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    constexpr int n = 100'000;
    const Ring turned(star.rbegin(), star.rend());
    int inside = 0;
    for (int i = 0; i < n; ++i) {
        const PlanePoint p{uniform(random), uniform(random)};
        inside += contains(star, p, 0);
        ASSERT_EQ(contains(star, p, 0), contains(turned, p, 0));
    }
    const double share = doubled_area(star) / 8, error = std::sqrt(share * (1 - share) / n);
    EXPECT_NEAR(inside / static_cast<double>(n), share, 4 * error);
}

TEST(PlaneRegion, KnowsTheDistanceToItsEdges) {
    EXPECT_DOUBLE_EQ(distance_to(kL, {2, 2}), 1);
    EXPECT_DOUBLE_EQ(distance_to(kL, {5, 5}), std::hypot(4, 1));
    EXPECT_DOUBLE_EQ(distance_to(kL, {0.5, 2}), 0.5);
    EXPECT_DOUBLE_EQ(distance_to(kSquare, {-3, -4}), 5);
}

std::string message_of(const Region& region) {
    const auto fault = fault_of(region);
    return fault ? fault->message : "";
}

TEST(PlaneRegion, AcceptsPolygonsWithHoles) {
    EXPECT_EQ(message_of({kSquare}), "");
    EXPECT_EQ(message_of({kL}), "");
    EXPECT_EQ(message_of({{kL.rbegin(), kL.rend()}}), "");
    EXPECT_EQ(message_of({kSquare, moved(kSquare, 0.5, 0.5, 0.2), moved(kL, 2, 2, 0.3)}), "");
}

TEST(PlaneRegion, RefusesWhatIsNotSimple) {
    EXPECT_EQ(message_of({{{0, 0}, {1, 0}}}), "has 2 corners. Allowed: 3 or more.");
    EXPECT_EQ(message_of({{{0, 0}, {4, 4}, {4, 0}, {0, 4}}}),
              "crosses or touches itself: the edges from corners 0 and 2, counted from 0, meet. Allowed: a "
              "simple polygon.");
    // A corner on another edge, and edges that overlap.
    EXPECT_NE(message_of({{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}}), "");
    EXPECT_NE(message_of({{{0, 0}, {4, 0}, {4, 4}, {3, 4}, {3, 0}, {1, 0}, {1, 4}, {0, 4}}}), "");
    EXPECT_EQ(message_of({{{0, 0}, {4, 0}, {2, 0}, {2, 4}}}),
              "turns back at corner 1, counted from 0. Allowed: a simple polygon.");
    EXPECT_NE(message_of({{{0, 0}, {4, 0}, {4, 0}, {4, 4}}}), "") << "a corner given twice";
}

TEST(PlaneRegion, RefusesHolesInTheWrongPlace) {
    EXPECT_EQ(message_of({kSquare, moved(kSquare, 3, 3, 0.5)}),
              "is not inside the outline. Allowed: a hole that touches no edge.");
    EXPECT_NE(message_of({kSquare, moved(kSquare, 5, 5, 0.5)}), "");
    EXPECT_NE(message_of({kSquare, moved(kSquare, -1, -1, 2)}), "") << "around the outline";
    EXPECT_EQ(message_of({kSquare, moved(kSquare, 1, 1, 0.5), moved(kSquare, 1.5, 1.5, 0.1)}),
              "meets hole 0. Allowed: separate holes.");
    EXPECT_NE(message_of({kSquare, moved(kSquare, 1.5, 1.5, 0.1), moved(kSquare, 1, 1, 0.5)}), "");
}

}  // namespace
}  // namespace stilb::sensors
