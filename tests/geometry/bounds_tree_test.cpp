#include "geometry/bounds_tree.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace stilb::geometry {
namespace {

std::vector<Bounds> random_boxes(std::size_t count, double largest) {
    std::mt19937_64 random(count);
    std::uniform_real_distribution<double> place(0, 1), size(0, largest);
    std::vector<Bounds> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 corner{place(random), place(random), place(random)};
        boxes.push_back({corner, corner + Vec3{size(random), size(random), size(random)}});
    }
    return boxes;
}

bool meet(const Bounds& a, const Bounds& b) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (a.max[axis] < b.min[axis] || b.max[axis] < a.min[axis]) return false;
    }
    return true;
}

TEST(BoundsTree, FindsExactlyTheBoxesThatMeet) {
    for (const std::size_t count : {0, 1, 2, 3, 7, 100, 1000}) {
        const std::vector<Bounds> boxes = random_boxes(count, 0.3);
        const BoundsTree tree(boxes);
        for (const Bounds& asked : random_boxes(20, 0.2)) {
            std::set<std::uint32_t> found, right;
            tree.any_meeting(asked, [&](std::uint32_t number) {
                EXPECT_TRUE(found.insert(number).second);
                return false;
            });
            for (std::uint32_t i = 0; i < count; ++i) {
                if (meet(boxes[i], asked)) right.insert(i);
            }
            EXPECT_EQ(found, right) << count;
        }
    }
}

TEST(BoundsTree, CountsBoxesThatTouch) {
    const BoundsTree tree(std::vector<Bounds>{{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {1, 1, 1}}});
    int touched = 0;
    const Vec3 corner{1, 1, 1};
    EXPECT_FALSE(tree.any_meeting({corner, corner}, [&](std::uint32_t) { return ++touched == 3; }));
    EXPECT_EQ(touched, 2);
    EXPECT_FALSE(tree.any_meeting({2 * corner, 2 * corner}, [](std::uint32_t) { return true; }));
}

/// Equal boxes, as lamps that lie in one place, and one that contains all others.
TEST(BoundsTree, StopsWhereTheConditionHolds) {
    std::vector<Bounds> boxes(100, Bounds{{0, 0, 0}, {1, 1, 1}});
    boxes.push_back({{-9, -9, -9}, {9, 9, 9}});
    const BoundsTree tree(boxes);
    int asked = 0;
    EXPECT_TRUE(tree.any_meeting({{0, 0, 0}, {0, 0, 0}}, [&](std::uint32_t) { return ++asked == 5; }));
    EXPECT_EQ(asked, 5);
}

}  // namespace
}  // namespace stilb::geometry
