// Rooms of buildings of wall boxes, whose floors, bands and walls are known.
#include "sensors/areas/rooms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "materials/thin_dielectric.h"
#include "sensors/areas/surface_points.h"
#include "support/scene_builder.h"

namespace stilb::sensors {
namespace {

constexpr double kHeight = 2.8, kThick = 0.1;

void add_wall(Scene& scene, const Vec3& min, const Vec3& max) {
    add_object(scene, Box{min, max}, diffuse(0.6));
}

/// Floor, ceiling and outer walls of boxes around x_m x y_m, on a floor at z.
void add_shell(Scene& scene, double x_m, double y_m, double z = 0) {
    const Vec3 low{-kThick, -kThick, z}, high{x_m + kThick, y_m + kThick, z + kHeight};
    add_wall(scene, {low.x, low.y, z - kThick}, {high.x, high.y, z});
    add_wall(scene, {low.x, low.y, high.z}, {high.x, high.y, high.z + kThick});
    add_wall(scene, low, {0, high.y, high.z});
    add_wall(scene, {x_m, low.y, z}, high);
    add_wall(scene, {0, low.y, z}, {x_m, 0, high.z});
    add_wall(scene, {0, y_m, z}, {x_m, high.y, high.z});
}

/// A room of 4 m x 5 m to the left of one of 3 m x 5 m, with a door of 2.1 m in between.
Scene two_rooms(double door_m) {
    Scene scene;
    add_shell(scene, 4 + kThick + 3, 5);
    const double left = 4, right = 4 + kThick;
    add_wall(scene, {left, 0, 0}, {right, 2, kHeight});
    add_wall(scene, {left, 2 + door_m, 0}, {right, 5, kHeight});
    if (door_m > 0) add_wall(scene, {left, 2, 2.1}, {right, 2 + door_m, kHeight});
    return scene;
}

std::vector<Room> rooms_of(const Scene& scene) { return find_rooms(scene, rays::RayCaster(scene)); }

TEST(Rooms, EndAtDoorsNarrowerThanTwoMargins) {
    const auto two = rooms_of(two_rooms(0.99));
    ASSERT_EQ(two.size(), 2u);
    for (const Room& room : two) {
        const bool is_left = room.is_under({1, 1, 0});
        EXPECT_NEAR(room.area_m2(), is_left ? 20 : 15, 2e-3);  // of the doorway 1 mm
        EXPECT_NEAR(room.floor_m, 0, 1e-9);
        EXPECT_NEAR(room.highest_m, kHeight, 0.02);
        EXPECT_EQ(room.is_under({4.05, 2.5, 0}), false) << "the doorway";
    }
    const auto one = rooms_of(two_rooms(1.01));
    ASSERT_EQ(one.size(), 1u);
    EXPECT_NEAR(one[0].area_m2(), 35 + 1.01 * kThick, 1e-3);
}

/// A niche of 1 m beside a room.
double area_with_niche(double width_m) {
    Scene scene;
    add_shell(scene, 5, 4);
    add_wall(scene, {4, 0, 0}, {5, 1, kHeight});
    add_wall(scene, {4, 1 + width_m, 0}, {5, 4, kHeight});
    const auto rooms = rooms_of(scene);
    const Room* const room = room_at(rooms, {1, 1, 1});
    return room ? room->area_m2() : 0;
}

TEST(Rooms, HaveNichesThatAreNotTooNarrow) {
    EXPECT_NEAR(area_with_niche(0.49), 16, 1e-3);
    EXPECT_NEAR(area_with_niche(0.51), 16.51, 2e-3);
    EXPECT_NEAR(area_with_niche(1.2), 17.2, 1e-3);
}

TEST(Rooms, AreFoundByAPointOnTheirStorey) {
    Scene scene;
    add_shell(scene, 4, 5);
    add_shell(scene, 6, 5, 3);
    const auto rooms = rooms_of(scene);
    ASSERT_EQ(rooms.size(), 2u);
    EXPECT_EQ(room_at(rooms, {1, 1, 0.75}), &rooms[0]);
    EXPECT_EQ(room_at(rooms, {1, 1, 3.75}), &rooms[1]);
    EXPECT_EQ(room_at(rooms, {5, 1, 0.75}), nullptr);
    EXPECT_EQ(room_at(rooms, {1, 1, 2.9}), nullptr) << "between both";
}

Area settled_area(Area area) {
    EXPECT_FALSE(area.settle(GivenKeys({})));
    return area;
}

/// The same points as without walls, less those beyond them, on a raster that holds them.
TEST(Rooms, EndBands) {
    const Scene scene = two_rooms(0.9);
    const rays::RayCaster caster(scene);
    const auto rooms = find_rooms(scene, caster);
    const PolygonInSpace desk{{{0.3, 2, 0.75}, {1.9, 2, 0.75}, {1.9, 2.8, 0.75}, {0.3, 2.8, 0.75}}, {}};
    const Area free = settled_area({.polygon = desk, .band_m = {0.5, 3.5}});
    Area band = free;
    const Room* const room = room_of(rooms, band);
    ASSERT_TRUE(room && room->is_under({1, 1, 0}));
    end_at_walls(*room, scene, caster, band);
    std::vector<Vec3> inside;
    for (const MeasuringPoint& point : free.points) {
        const Vec3& p = point.position;
        if (p.x > 0 && p.x < 4 && p.y > 0 && p.y < 5) inside.push_back(p);
    }
    ASSERT_LT(inside.size(), free.points.size());
    ASSERT_EQ(band.points.size(), inside.size());
    for (std::size_t j = 0; j < inside.size(); ++j) EXPECT_EQ(band.points[j].position, inside[j]);
    // Cells have their points in the middle.
    const Grid& raster = band.raster;
    EXPECT_LT(raster.size(), free.raster.size());
    const Vec3 cell_u = raster.edge_u / raster.count[0], cell_v = raster.edge_v / raster.count[1];
    EXPECT_NEAR(length(cell_u), free.cell_m[0], 1e-12);
    EXPECT_NEAR(length(cell_v), free.cell_m[1], 1e-12);
    for (const Vec3& p : inside) {
        for (const auto& [cell, count] : {std::pair{cell_u, raster.count[0]}, {cell_v, raster.count[1]}}) {
            const double place = dot(p - raster.corner, cell) / squared_length(cell);
            EXPECT_NEAR(place - std::floor(place), 0.5, 1e-9);
            EXPECT_TRUE(place > 0 && place < count);
        }
    }
}

/// Around a board on a wall: not below the floor, above the ceiling or beyond the next wall.
TEST(Rooms, EndBandsOnWalls) {
    const Scene scene = two_rooms(0.9);
    const rays::RayCaster caster(scene);
    const auto rooms = find_rooms(scene, caster);
    const PolygonInSpace board{{{0.01, 1, 1}, {0.01, 2, 1}, {0.01, 2, 2}, {0.01, 1, 2}}, {}};
    Area band = settled_area({.polygon = board, .band_m = {0, 2}});
    const std::size_t before = band.points.size();
    end_at_walls(*room_of(rooms, band), scene, caster, band);
    EXPECT_LT(band.points.size(), before);
    for (const MeasuringPoint& point : band.points) {
        EXPECT_TRUE(point.position.z > 0 && point.position.z < kHeight) << point.position.z;
        EXPECT_TRUE(point.position.y > 0 && point.position.y < 5) << point.position.y;
    }
    const double share = static_cast<double>(band.points.size()) / static_cast<double>(before);
    // Of the square of 5 m with round corners, without the board, the part within 0 to 4 m and 0 to 2.8 m.
    EXPECT_NEAR(share, (4 * 2.8 - 1) / (8 + 4 * kPi), 0.06);
}

Area measured(const Scene& scene, SurfacePart part, const Vec3& in_room = {1, 1, 1}) {
    const rays::RayCaster caster(scene);
    const auto rooms = find_rooms(scene, caster);
    Area area{.polygon = {}, .surfaces = {.objects = {}, .room = in_room, .part = part}};
    const Room* const room = room_at(rooms, in_room);
    if (!room || place_in(*room, scene, caster, area)) ADD_FAILURE() << "no such room, or no such part";
    return area;
}

/// Of a building of wall boxes: those of a box of the size of the room.
TEST(Rooms, HaveThePointsOfTheFacesOfABox) {
    const std::vector<PlaneFace> faces = plane_faces(triangulated(Box{{0, 0, 0}, {4, 5, kHeight}}));
    for (const SurfacePart part :
         {SurfacePart::walls, SurfacePart::ceiling, SurfacePart::floor, SurfacePart::all}) {
        std::vector<PlaneFace> wanted;
        std::ranges::copy_if(faces, std::back_inserter(wanted),
                             [&](const PlaneFace& face) { return is_of_part(face, part); });
        Area of_box{.polygon = {}};
        ASSERT_FALSE(place_on(wanted, of_box));
        const Area of_room = measured(two_rooms(0), part);
        ASSERT_EQ(of_room.points.size(), of_box.points.size()) << static_cast<int>(part);
        for (const MeasuringPoint& point : of_room.points) {
            const auto is_same = [&](const MeasuringPoint& other) {
                return length(point.position - other.position) < 1e-3 &&
                       dot(point.normal, other.normal) > 0.999;
            };
            EXPECT_TRUE(std::ranges::any_of(of_box.points, is_same))
                << point.position.x << " " << point.position.y << " " << point.position.z;
        }
    }
}

TEST(Rooms, HaveNoWallInADoor) {
    const Area with_door = measured(two_rooms(0.9), SurfacePart::walls),
               without = measured(two_rooms(0), SurfacePart::walls);
    const auto in_door = [](const MeasuringPoint& point) {
        return point.position.x > 3.9 && point.position.y > 2 && point.position.y < 2.9 &&
               point.position.z < 2.1;
    };
    EXPECT_EQ(std::ranges::count_if(with_door.points, in_door), 0);
    EXPECT_EQ(with_door.points.size(), without.points.size() - static_cast<std::size_t>(std::ranges::count_if(
                                                                   without.points, in_door)));
}

/// A window of 3 m with its pane in the middle of the wall: the wall below and above it is measured where it
/// stands, and a cupboard in front of a wall is none.
TEST(Rooms, MeasureTheWallBelowAWindow) {
    Scene scene;
    const double y = 5 + kThick;
    add_wall(scene, {-kThick, -kThick, -kThick}, {4.1, y, 0});
    add_wall(scene, {-kThick, -kThick, kHeight}, {4.1, y, kHeight + kThick});
    add_wall(scene, {-kThick, -kThick, 0}, {0, y, kHeight});
    add_wall(scene, {4, -kThick, 0}, {4.1, y, kHeight});
    add_wall(scene, {0, -kThick, 0}, {4, 0, kHeight});
    add_wall(scene, {0, 5, 0}, {4, y, 0.9});
    add_wall(scene, {0, 5, 2.2}, {4, y, kHeight});
    add_wall(scene, {0, 5, 0.9}, {0.5, y, 2.2});
    add_wall(scene, {3.5, 5, 0.9}, {4, y, 2.2});
    add_object(scene, Rectangle{{0.5, 5.05, 0.9}, {3, 0, 0}, {0, 0, 1.3}}, ThinDielectric{});
    add_wall(scene, {0.3, 0.05, 0}, {1.3, 0.25, 1});
    std::size_t below = 0;
    for (const auto& [p, normal] : measured(scene, SurfacePart::walls).points) {
        const bool is_in_window = p.x > 0.5 && p.x < 3.5 && p.z > 0.9 && p.z < 2.2;
        if (normal.y < -0.5) {
            EXPECT_NEAR(p.y, 5, 1e-6);
            EXPECT_FALSE(is_in_window);
            below += p.z < 0.9;
        }
        if (normal.y > 0.5) {
            EXPECT_NEAR(p.y, 0, 1e-6);
        }
    }
    EXPECT_GE(below, 8u);
}

TEST(Rooms, MeasureTheCeilingAboveLamps) {
    Scene scene = two_rooms(0.9);
    add_area_light(scene, Rectangle{{0.5, 0.5, 2.5}, {0, 3, 0}, {3, 0, 0}}, Rgb::grey(1000));
    for (const MeasuringPoint& point : measured(scene, SurfacePart::ceiling).points)
        EXPECT_NEAR(point.position.z, kHeight, 1e-6);
}

}  // namespace
}  // namespace stilb::sensors
