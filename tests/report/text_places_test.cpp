#include "report/text_places.h"

#include <gtest/gtest.h>

namespace stilb::report {
namespace {

using plot::PageRectangle;

constexpr PageRectangle kFrame{0, 0, 200, 200};
constexpr double kWidth = 40, kHeight = 9;

bool touch(const PageRectangle& a, const PageRectangle& b) {
    return a.left < b.right() && b.left < a.right() && a.top < b.bottom() && b.top < a.bottom();
}

TEST(TextPlaces, AreBelowAThingWhereThatIsFree) {
    TextPlaces places(kFrame);
    const auto place = places.place_beside({90, 90, 20, 20}, kWidth, kHeight);
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->center().x, 100, 1e-9);
    EXPECT_GE(place->top, 110);
    EXPECT_LT(place->top, 115);
}

/// Things that stand closer than their names are wide.
TEST(TextPlaces, DoNotLieOnEachOther) {
    TextPlaces places(kFrame);
    std::size_t placed = 0;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 6; ++column) {
            const PageRectangle thing{20.0 + 25 * column, 30.0 + 40 * row, 8, 8};
            const auto place = places.place_beside(thing, kWidth, kHeight);
            if (!place) continue;
            ++placed;
            EXPECT_GE(place->left, kFrame.left);
            EXPECT_LE(place->right(), kFrame.right());
        }
    }
    EXPECT_GE(placed, 14u);
    ASSERT_EQ(places.texts().size(), placed);
    for (std::size_t i = 0; i < placed; ++i) {
        for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(touch(places.texts()[i], places.texts()[j]));
    }
}

TEST(TextPlaces, KeepClearOfThingsWherePossible) {
    TextPlaces places(kFrame);
    const PageRectangle thing{90, 90, 20, 20}, below{60, 111, 80, 30};
    places.avoid(thing);
    places.avoid(below);
    const auto place = places.place_beside(thing, kWidth, kHeight);
    ASSERT_TRUE(place);
    EXPECT_FALSE(touch(*place, thing));
    EXPECT_FALSE(touch(*place, below));
    EXPECT_LT(place->bottom(), 90);
}

TEST(TextPlaces, AreNoneWhereNothingIsFree) {
    TextPlaces places({0, 0, 30, 200});
    EXPECT_FALSE(places.place_beside({10, 90, 10, 10}, kWidth, kHeight));
    EXPECT_FALSE(places.place_within({0, 0, 30, 30}, kWidth, kHeight));
    EXPECT_TRUE(places.place_within({0, 0, 30, 30}, 20, kHeight));
}

}  // namespace
}  // namespace stilb::report
