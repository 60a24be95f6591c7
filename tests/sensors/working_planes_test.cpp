#include "sensors/areas/working_planes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/scene_builder.h"

namespace stilb::sensors {
namespace {

std::vector<WorkingPlane> planes_in(const Scene& scene, const WorkingPlaneOptions& options = {}) {
    return working_planes(scene, rays::RayCaster(scene), options);
}

/// A vertical wall between two points of the plan.
Rectangle wall_from(const Vec3& from, const Vec3& to, double height_m = 3) {
    return {from, to - from, {0, 0, height_m}};
}

/// Walls without thickness around a polygon, a floor at z and a ceiling.
void add_room(Scene& scene, double x_m, double y_m, double z = 0, double height_m = 3) {
    add_object(scene, Rectangle{{0, 0, z}, {x_m, 0, 0}, {0, y_m, 0}}, diffuse(0.2));
    add_object(scene, Rectangle{{0, 0, z + height_m}, {0, y_m, 0}, {x_m, 0, 0}}, diffuse(0.7));
    const std::vector<Vec3> corners{{0, 0, z}, {x_m, 0, z}, {x_m, y_m, z}, {0, y_m, z}};
    for (std::size_t i = 0; i < 4; ++i)
        add_object(scene, wall_from(corners[i], corners[(i + 1) % 4], height_m), diffuse(0.5));
}

Scene room(double x_m, double y_m) {
    Scene scene;
    add_room(scene, x_m, y_m);
    return scene;
}

constexpr double kRounding = 1e-4;

TEST(WorkingPlanes, KeepTheirMarginFromTheWallsOfABox) {
    Scene scene;
    add_object(scene, Box{{1, 2, 3}, {7, 6, 6}}, diffuse(0.5));
    const auto planes = planes_in(scene, {0.8, 0.5});
    ASSERT_EQ(planes.size(), 1u);
    EXPECT_NEAR(area_m2(planes[0].polygon), 5 * 3, kRounding);
    EXPECT_NEAR(planes[0].floor_m, 3, kRounding);
    for (const Vec3& corner : planes[0].polygon.outline) {
        EXPECT_NEAR(std::abs(corner.x - 4), 2.5, kRounding);
        EXPECT_NEAR(std::abs(corner.y - 4), 1.5, kRounding);
        EXPECT_NEAR(corner.z, 3.8, kRounding);
    }
}

TEST(WorkingPlanes, WithoutAMarginReachTheWalls) {
    const auto planes = planes_in(room(6, 4), {0.75, 0});
    ASSERT_EQ(planes.size(), 1u);
    EXPECT_NEAR(area_m2(planes[0].polygon), 24, 0.03);
}

/// An L of 6 m x 6 m without 3 m x 3 m, extruded.
TEST(WorkingPlanes, FollowAnglesOfTheRoom) {
    const std::vector<Vec3> outline{{0, 0, 0}, {6, 0, 0}, {6, 3, 0}, {3, 3, 0}, {3, 6, 0}, {0, 6, 0}};
    Scene scene;
    for (const double z : {0., 3.}) {
        add_object(scene, Rectangle{{0, 0, z}, {6, 0, 0}, {0, 3, 0}}, diffuse(0.5));
        add_object(scene, Rectangle{{0, 3, z}, {3, 0, 0}, {0, 3, 0}}, diffuse(0.5));
    }
    for (std::size_t i = 0; i < outline.size(); ++i)
        add_object(scene, wall_from(outline[i], outline[(i + 1) % outline.size()]), diffuse(0.5));
    const auto planes = planes_in(scene);
    ASSERT_EQ(planes.size(), 1u);
    // The corner of the wall into the room keeps its distance square.
    EXPECT_NEAR(area_m2(planes[0].polygon), 5 * 5 - 3 * 3, kRounding);
    EXPECT_EQ(planes[0].polygon.outline.size(), 6u);
}

TEST(WorkingPlanes, DoorsPartRoomsAndWideOpeningsDoNot) {
    for (const auto& [opening_m, count] : {std::pair{0.9, 2u}, {1.8, 1u}, {0.0, 2u}}) {
        Scene scene = room(8, 4);
        add_object(scene, wall_from({4, 0, 0}, {4, 2 - opening_m / 2, 0}), diffuse(0.5));
        add_object(scene, wall_from({4, 2 + opening_m / 2, 0}, {4, 4, 0}), diffuse(0.5));
        // A lintel.
        add_object(scene, wall_from({4, 2 - opening_m / 2, 2.1}, {4, 2 + opening_m / 2 + 1e-3, 2.1}, 0.9),
                   diffuse(0.5));
        const auto planes = planes_in(scene);
        ASSERT_EQ(planes.size(), count) << opening_m;
        for (const WorkingPlane& plane : planes) {
            if (count == 2) {
                EXPECT_NEAR(area_m2(plane.polygon), 9, kRounding);
            }
        }
    }
}

/// As in buildings of CAD programs: a slab reaches below walls of 0.3 m and beyond, to an open terrace, and
/// the leaves of the door have slits of 3 mm.
TEST(WorkingPlanes, NeitherTheInsidesOfWallsNorSlitsCount) {
    Scene scene;
    const auto add = [&](const Vec3& min, const Vec3& max) {
        add_object(scene, triangulated(Box{min, max}), diffuse(0.5));
    };
    add({-0.3, -8, -0.3}, {6.3, 4.3, 0}), add({-0.3, -0.3, 2.5}, {6.3, 4.3, 2.8});
    add({-0.3, -0.3, 0}, {0, 4.3, 2.5}), add({6, -0.3, 0}, {6.3, 4.3, 2.5}), add({0, 4, 0}, {6, 4.3, 2.5});
    add({0, -0.3, 0}, {2, 0, 2.5}), add({4, -0.3, 0}, {6, 0, 2.5}), add({2, -0.3, 2.1}, {4, 0, 2.5});
    add({2.003, -0.2, 0.003}, {2.997, -0.15, 2.097}), add({3, -0.2, 0.003}, {3.997, -0.15, 2.097});
    for (const double margin_m : {0.5, 0.2, 0.02}) {
        const auto planes = planes_in(scene, {0.8, margin_m});
        ASSERT_EQ(planes.size(), 1u) << margin_m;
        const double niche_m2 = (2 - 2 * margin_m) * 0.15;  // up to the door's leaves
        EXPECT_NEAR(area_m2(planes[0].polygon), (6 - 2 * margin_m) * (4 - 2 * margin_m) + niche_m2,
                    kRounding);
    }
}

TEST(WorkingPlanes, FurnitureIsNeitherAFloorNorAWall) {
    Scene scene = room(6, 4);
    add_object(scene, Box{{1, 1, 0}, {3, 2, 0.72}}, diffuse(0.3));                      // a desk
    add_object(scene, Rectangle{{3.5, 1, 0.7}, {1.5, 0, 0}, {0, 1, 0}}, diffuse(0.3));  // a table top
    add_object(scene, Box{{0, 3.4, 0}, {3, 4, 1}}, diffuse(0.3));                       // a sideboard
    add_object(scene, Rectangle{{0, 3.4, 1}, {3, 0, 0}, {0, 0.6, 0}}, diffuse(0.3));    // its top
    const auto planes = planes_in(scene);
    ASSERT_EQ(planes.size(), 1u);
    EXPECT_NEAR(area_m2(planes[0].polygon), 15, kRounding);
}

/// A narrow office, of which a desk and a shelf cover two thirds.
TEST(WorkingPlanes, FurnitureMayCoverMostOfAFloor) {
    Scene scene = room(2.6, 6);
    add_object(scene, Box{{0, 0.2, 0.72}, {1.7, 4.6, 0.75}}, diffuse(0.5));
    add_object(scene, Box{{0, 4.7, 0}, {1.7, 5.9, 1.2}}, diffuse(0.5));
    const auto planes = planes_in(scene);
    ASSERT_EQ(planes.size(), 1u);
    EXPECT_NEAR(planes[0].floor_m, 0, kRounding);
    EXPECT_NEAR(area_m2(planes[0].polygon), 1.6 * 5, kRounding);
}

/// The floor of a house at the height of the grounds, in one surface with them.
TEST(WorkingPlanes, AHouseOnItsGroundsHasAFloor) {
    Scene scene;
    add_object(scene, Rectangle{{-20, -20, 0}, {50, 0, 0}, {0, 50, 0}}, diffuse(0.2));
    add_room(scene, 6, 4);
    const auto planes = planes_in(scene);
    ASSERT_EQ(planes.size(), 1u);
    EXPECT_NEAR(area_m2(planes[0].polygon), 15, 0.05);
}

/// A bed in a corner has edges on two sides only, with a frame a little below its top.
TEST(WorkingPlanes, ABedIsNoFloor) {
    Scene scene = room(4, 4);
    add_object(scene, Box{{0, 0, 0}, {2, 2, 0.48}}, diffuse(0.5));
    add_object(scene, Rectangle{{0, 0, 0.5}, {1.97, 0, 0}, {0, 1.97, 0}}, diffuse(0.5));
    const auto planes = planes_in(scene);
    ASSERT_EQ(planes.size(), 1u);
    EXPECT_NEAR(planes[0].floor_m, 0, kRounding);
}

/// Walls that begin above the floor, a little beside it, as behind a skirting.
TEST(WorkingPlanes, WallsMayBeginAboveTheFloor) {
    Scene scene;
    add_object(scene, Rectangle{{0.01, 0.01, 0}, {3.98, 0, 0}, {0, 2.98, 0}}, diffuse(0.2));
    add_object(scene, Rectangle{{0, 0, -0.3}, {4, 0, 0}, {0, 3, 0}}, diffuse(0.2));
    add_object(scene, Rectangle{{0, 0, 3}, {0, 3, 0}, {4, 0, 0}}, diffuse(0.7));
    const std::vector<Vec3> corners{{0, 0, 0.05}, {4, 0, 0.05}, {4, 3, 0.05}, {0, 3, 0.05}};
    for (std::size_t i = 0; i < 4; ++i)
        add_object(scene, wall_from(corners[i], corners[(i + 1) % 4]), diffuse(0.5));
    const auto planes = planes_in(scene);
    ASSERT_EQ(planes.size(), 1u);
    EXPECT_NEAR(planes[0].floor_m, 0, kRounding);
    EXPECT_NEAR(area_m2(planes[0].polygon), 2.98 * 1.98, 0.05);
}

TEST(WorkingPlanes, PillarsAreHoles) {
    Scene scene = room(6, 6);
    add_object(scene, Box{{2.9, 2.9, 0}, {3.1, 3.1, 3}}, diffuse(0.5));
    const auto planes = planes_in(scene);
    ASSERT_EQ(planes.size(), 1u);
    ASSERT_EQ(planes[0].polygon.holes.size(), 1u);
    EXPECT_NEAR(area_m2(planes[0].polygon), 25 - 1.2 * 1.2, 0.2);  // corners of the hole are cut
}

/// A cloth of many small triangles once took minutes, before their common edges were left out.
TEST(WorkingPlanes, FloorsOfManyTrianglesAreTheirOutline) {
    Scene scene = room(6, 4);
    Mesh floor;
    constexpr std::uint32_t across = 300, along = 200;
    for (std::uint32_t row = 0; row <= along; ++row) {
        for (std::uint32_t column = 0; column <= across; ++column)
            floor.vertices.push_back({6.0 * column / across, 4.0 * row / along, 0.2});
    }
    const auto is_hole = [](std::uint32_t row, std::uint32_t column) {
        return row >= 90 && row < 110 && column >= 140 && column < 160;
    };
    for (std::uint32_t row = 0; row < along; ++row) {
        for (std::uint32_t column = 0; column < across; ++column) {
            if (is_hole(row, column)) continue;
            const std::uint32_t a = row * (across + 1) + column, b = a + across + 1;
            floor.triangles.push_back({a, a + 1, b + 1});
            floor.triangles.push_back({a, b, b + 1});  // the other side upwards
        }
    }
    add_object(scene, std::move(floor), diffuse(0.5));
    add_object(scene, Box{{2.8, 1.8, 0}, {3.2, 2.2, 3}}, diffuse(0.5));
    const auto planes = planes_in(scene);
    const auto upper =
        std::ranges::find_if(planes, [](const WorkingPlane& plane) { return plane.floor_m > 0.1; });
    ASSERT_NE(upper, planes.end());
    ASSERT_EQ(upper->polygon.holes.size(), 1u);
    EXPECT_NEAR(area_m2(upper->polygon), 15 - 1.4 * 1.4, 0.2);  // corners of the hole are cut
}

TEST(WorkingPlanes, EachStoreyOfSlabsHasItsOwn) {
    Scene scene;
    for (const double top : {0., 3., 6.})
        add_object(scene, Box{{0, 0, top - 0.2}, {5, 4, top}}, diffuse(0.5));
    const std::vector<Vec3> corners{{0, 0, 0}, {5, 0, 0}, {5, 4, 0}, {0, 4, 0}};
    for (std::size_t i = 0; i < 4; ++i)
        add_object(scene, wall_from(corners[i], corners[(i + 1) % 4], 6), diffuse(0.5));
    const auto planes = planes_in(scene);
    ASSERT_EQ(planes.size(), 2u);
    EXPECT_NEAR(planes[0].floor_m, 0, kRounding);
    EXPECT_NEAR(planes[1].floor_m, 3, kRounding);
    for (const WorkingPlane& plane : planes) EXPECT_NEAR(area_m2(plane.polygon), 12, kRounding);
}

/// A stage along one wall of a hall: of its edges, one long one is a step.
TEST(WorkingPlanes, AStageIsAFloorAndATableIsNone) {
    Scene scene = room(5, 9);
    add_object(scene, Box{{0, 6, 0}, {5, 9, 0.4}}, diffuse(0.4));
    const auto planes = planes_in(scene);
    ASSERT_EQ(planes.size(), 2u);
    EXPECT_NEAR(planes[1].floor_m, 0.4, kRounding);
    EXPECT_NEAR(area_m2(planes[1].polygon), 4 * 2, kRounding);
}

TEST(WorkingPlanes, OpenGroundHasNone) {
    Scene scene;
    add_object(scene, Rectangle{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}}, diffuse(0.2));
    EXPECT_TRUE(planes_in(scene).empty());
    EXPECT_TRUE(planes_in(room(0.9, 4)).empty()) << "no place away from the walls";
}

TEST(WorkingPlanes, OfSomeObjectsOnly) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 4, 3}}, diffuse(0.5));
    const ObjectId second = add_object(scene, Box{{5, 0, 0}, {8, 4, 3}}, diffuse(0.5));
    EXPECT_EQ(planes_in(scene).size(), 2u);
    const auto planes = working_planes(scene, rays::RayCaster(scene), {}, std::array{second});
    ASSERT_EQ(planes.size(), 1u);
    EXPECT_NEAR(area_m2(planes[0].polygon), 2 * 3, kRounding);
}

TEST(WorkingPlanes, OverAPolygon) {
    const PolygonInSpace floor{{{0, 0, 1}, {0, 3, 1}, {4, 3, 1}, {4, 0, 1}}, {}};
    const auto planes = working_planes(floor, {0.75, 0.5});
    ASSERT_EQ(planes.size(), 1u);
    EXPECT_NEAR(area_m2(planes[0].polygon), 3 * 2, kRounding);
    EXPECT_NEAR(planes[0].polygon.outline[0].z, 1.75, kRounding);
}

TEST(WorkingPlanes, BecomeSensors) {
    const auto planes = planes_in(room(6, 4));
    const auto one = sensors_on(planes, "desk", std::nullopt);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(one[0].name, "desk");
    // 5 m x 3 m: p = 0.2 * 5^log10(5) = 0.62 m, eight cells along 5 m.
    const auto& area = std::get<Area>(one[0].kind);
    EXPECT_NEAR(std::max(area.cell_m[0], area.cell_m[1]), 0.625, kRounding);
    const std::vector<WorkingPlane> two{planes[0], planes[0]};
    const auto both = sensors_on(two, "desk", 1);
    ASSERT_EQ(both.size(), 2u);
    EXPECT_EQ(both[1].name, "desk_2");
    EXPECT_EQ(both[1].size(), 15u);
}

}  // namespace
}  // namespace stilb::sensors
