#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "../support/scene_builder.h"
#include "rays/ray_caster.h"
#include "scene/overlaps.h"
#include "sensors/measurand.h"
#include "sensors/place.h"

namespace stilb::scene {
namespace {

const Box kRoom{{0, 0, 0}, {4, 3, 2.8}};
/// A panel whose front faces down.
Rectangle panel_at(double z) { return {{1.7, 1.2, z}, {0, 0.6, 0}, {0.6, 0, 0}}; }

Scene room_with_lamp(const Shape& room, const Shape& lamp) {
    Scene scene;
    add_object(scene, room, diffuse(0.6));
    add_area_light(scene, lamp, Rgb::grey(1000));
    put_lamps_in_front(scene);
    return scene;
}

/// Rays from the room to points of the panel at many angles, from steep to grazing.
std::vector<rays::Ray> rays_to_the_panel() {
    std::vector<rays::Ray> rays;
    for (int i = 0; i < 400; ++i) {
        const double angle = i * std::numbers::phi, x = 1.75 + 0.5 * (i % 20) / 20,
                     y = 1.25 + 0.5 * (i / 20) / 20.0, height = 2.75 / (1 + i % 7 * i % 11);
        const Vec3 origin{2 + 1.4 * std::cos(angle), 1.5 + 1.4 * std::sin(angle), 2.8 - height};
        rays.push_back({origin, normalized(Vec3{x, y, 2.8} - origin)});
    }
    return rays;
}

void expect_all_meet_the_lamp(const Scene& scene) {
    const rays::RayCaster caster(scene);
    const std::vector<rays::Ray> rays = rays_to_the_panel();
    std::vector<std::optional<rays::Hit>> hits(rays.size());
    caster.closest(rays, rays::Coherence::scattered, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto single = caster.closest(rays[i].origin, rays[i].direction);
        ASSERT_TRUE(single && hits[i]);
        EXPECT_EQ(single->object, ObjectId{1}) << i;
        EXPECT_EQ(hits[i]->object, ObjectId{1}) << i;
        EXPECT_TRUE(single->on_front && hits[i]->on_front) << i;
        // Nothing is between the room and the lamp, and a point of the ceiling behind the lamp is hidden.
        EXPECT_FALSE(caster.occluded(rays[i].origin, single->lifted)) << i;
        EXPECT_TRUE(caster.occluded(rays[i].origin, single->position + Vec3{0, 0, 1e-4})) << i;
    }
}

TEST(LampsInFront, OfABoxesCeiling) { expect_all_meet_the_lamp(room_with_lamp(kRoom, panel_at(2.8))); }

TEST(LampsInFront, OfASheet) {
    expect_all_meet_the_lamp(room_with_lamp(wall(kRoom, 2, Side::high), panel_at(2.8)));
}

TEST(LampsInFront, OfACeilingThatDiffersByRounding) {
    for (const double z : {2.8 - 1e-6, 2.8 + 1e-6, 2.8 + 3e-6})
        expect_all_meet_the_lamp(room_with_lamp(kRoom, panel_at(z)));
}

TEST(LampsInFront, MeshesOfSeparateTriangles) {
    const Rectangle r = panel_at(2.8);
    const Vec3 &a = r.corner, b = a + r.edge_u, c = b + r.edge_v, d = a + r.edge_v;
    expect_all_meet_the_lamp(room_with_lamp(kRoom, Mesh{{a, b, c, a, c, d}, {{0, 1, 2}, {3, 4, 5}}}));
}

TEST(LampsInFront, RoundPanels) {
    expect_all_meet_the_lamp(room_with_lamp(kRoom, Disk{{2, 1.5, 2.8}, {0, 0, -1}, 0.5}));
}

TEST(LampsInFront, InSlantedPlanesFarFromTheOrigin) {
    const Vec3 far{1000, -2000, 500}, u{3, 0, 1}, v{0.5, 2, 0.5};
    const Rectangle roof{far, u, v}, lamp{far + 0.3 * u + 0.3 * v, 0.4 * v, 0.4 * u};
    const Scene scene = room_with_lamp(roof, lamp);
    const rays::RayCaster caster(scene);
    const Vec3 front = normalized(cross(v, u)), target = far + 0.5 * u + 0.5 * v;
    for (int i = 0; i < 100; ++i) {
        const Vec3 origin = target + 0.5 * front + std::cos(i) * u + std::sin(i) * v;
        EXPECT_EQ(caster.closest(origin, normalized(target - origin))->object, ObjectId{1}) << i;
    }
}

TEST(LampsInFront, OnlyTheFacesOfABoxThatOverlapMove) {
    const Box box{{1, 1, 2.7}, {2, 2, 2.8}};
    const Box moved = std::get<Box>(room_with_lamp(kRoom, box).objects[1].shape);
    EXPECT_EQ(moved.min, box.min);
    EXPECT_GT(moved.max.z, box.max.z);
    EXPECT_LT(moved.max.z, box.max.z + 1e-4);
}

TEST(LampsInFront, LampsElsewhereStayWhereTheyAre) {
    for (const double z : {2.799, 1.0}) {
        const Scene scene = room_with_lamp(kRoom, panel_at(z));
        EXPECT_EQ(std::get<Rectangle>(scene.objects[1].shape).corner, panel_at(z).corner);
    }
}

/// A lamp a millimetre below a ceiling stays there, and one in its plane moves by two offsets of the room, on
/// any ground.
TEST(LampsInFront, AsFarOnAGroundOfAThousandKilometres) {
    for (const double side_m : {50.0, 1e3, 1e6}) {
        for (const double below_m : {0.0, 1e-3}) {
            Scene scene;
            add_object(scene, kRoom, diffuse(0.6));
            add_object(scene, Rectangle{{-side_m / 2, -side_m / 2, -0.2}, {side_m, 0, 0}, {0, side_m, 0}},
                       diffuse(0.5));
            add_area_light(scene, panel_at(2.8 - below_m), Rgb::grey(1000));
            put_lamps_in_front(scene);
            const double z = std::get<Rectangle>(scene.objects[2].shape).corner.z;
            EXPECT_LE(z, below_m == 0 ? 2.8 - 2e-5 : 2.8 - below_m) << side_m;
            EXPECT_GE(z, below_m == 0 ? 2.8 - 1.3e-4 : 2.8 - below_m) << side_m;
        }
    }
}

/// By no more than a tenth of a thousandth of a room's side, whatever lies far away; and a sensor in its
/// plane lies on the lamp.
TEST(LampsInFront, AsFarAsTheRoomIsLarge) {
    for (const double side_m : {0.01, 0.1, 3.0}) {
        for (const double far_m : {0.0, 20.0, 1e3, 1e7}) {
            Scene scene;
            add_object(scene, Box{{0, 0, 0}, {side_m, side_m, side_m}}, diffuse(0.6));
            if (far_m > 0) add_object(scene, Sphere{{far_m, 0, 0}, far_m / 10}, diffuse(0.5));
            const double edge_m = 0.3 * side_m;
            add_area_light(scene, Rectangle{{edge_m, edge_m, side_m}, {0, edge_m, 0}, {edge_m, 0, 0}},
                           Rgb::grey(1000));
            put_lamps_in_front(scene);
            const ObjectId lamp = *lights::emitting_object(scene.lights[0]);
            const double below_m = side_m - std::get<Rectangle>(scene.object(lamp).shape).corner.z;
            EXPECT_GT(below_m, 1e-6 * side_m) << side_m << ' ' << far_m;
            EXPECT_LT(below_m, 1e-4 * side_m) << side_m << ' ' << far_m;
            const Vec3 on_lamp{1.5 * edge_m, 1.5 * edge_m, side_m};
            const Vec3 corner{0.01 * side_m, 0.01 * side_m, 0.01 * side_m};
            for (const std::vector<Vec3>& measured :
                 {std::vector<Vec3>{}, {on_lamp}, {corner}, {on_lamp, corner}}) {
                const rays::RayCaster caster(scene, Monitor::none(), measured);
                const auto surface = place_of(MeasuringPoint{on_lamp, {0, 0, -1}}, caster).surface;
                ASSERT_TRUE(surface) << side_m << ' ' << far_m;
                EXPECT_EQ(surface->object, lamp) << side_m << ' ' << far_m;
            }
        }
    }
}

double offset_of_room_m() {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    return lift_of(scene).offset_m({2, 1.5, 2.8}, lift_of(scene).largest_size_m());
}

TEST(LampsInFront, OnlyThoseNearerThanTwoOffsetsMove) {
    const double offset_m = offset_of_room_m();
    for (const double offsets : {0.0, 1.0, 1.99, 2.01, 2.24, 2.26, 3.0}) {
        const double z = 2.8 - offsets * offset_m;
        const Scene scene = room_with_lamp(kRoom, panel_at(z));
        const double expected_z = offsets < 2 ? 2.8 - 2 * offset_m : z;
        EXPECT_NEAR(std::get<Rectangle>(scene.objects[1].shape).corner.z, expected_z, 1e-3 * offset_m)
            << offsets;
    }
}

/// A lamp so small that it lies within the offset of a ceiling at either angle.
TEST(LampsInFront, OnlyThoseParallelToTheSurfaceMove) {
    constexpr double size_m = 2e-4;
    for (const double degrees : {0.0, 0.5, 0.52, 1.0}) {
        const double angle = degrees * kPi / 180;
        const Vec3 along = size_m * Vec3{std::cos(angle), 0, std::sin(angle)}, across{0, size_m, 0};
        const Rectangle lamp{Vec3{2, 1.5, 2.8} - 0.5 * along, across, along};
        const Rectangle moved = std::get<Rectangle>(room_with_lamp(kRoom, lamp).objects[1].shape);
        EXPECT_EQ(moved.corner.z < lamp.corner.z - offset_of_room_m(), degrees < 0.51) << degrees;
        EXPECT_EQ(moved.corner == lamp.corner, degrees > 0.51) << degrees;
    }
}

/// From one offset above a floor to three below it, where a lamp that was put in front of it would hide it.
TEST(LampsInFront, SensorsLieOnWhatIsWithinTheirOffsets) {
    Scene scene;
    add_object(scene, kRoom, diffuse(0.6));
    const rays::RayCaster caster(scene);
    for (const double offsets : {-4.0, -3.1, -2.9, -1.0, 0.0, 0.9, 1.1, 2.0}) {
        const Vec3 position{2, 1.5, offsets * offset_of_room_m()};
        const bool lies_on_floor = offsets > -3 && offsets < 1;
        EXPECT_EQ(place_of(MeasuringPoint{position, {0, 0, 1}}, caster).surface.has_value(), lies_on_floor)
            << offsets;
    }
}

TEST(LampsInFront, TheSecondTimeNothingMoves) {
    Scene scene = room_with_lamp(kRoom, panel_at(2.8));
    const Vec3 once = std::get<Rectangle>(scene.objects[1].shape).corner;
    put_lamps_in_front(scene);
    EXPECT_EQ(std::get<Rectangle>(scene.objects[1].shape).corner, once);
}

TEST(LampsInFront, SensorsInThePlaneLieOnTheLamp) {
    const Scene scene = room_with_lamp(kRoom, panel_at(2.8));
    const rays::RayCaster caster(scene);
    const auto surface = place_of(MeasuringPoint{{2, 1.5, 2.8}, {0, 0, -1}}, caster).surface;
    ASSERT_TRUE(surface);
    EXPECT_EQ(surface->object, ObjectId{1});
    EXPECT_EQ(place_of(MeasuringPoint{{1, 1, 2.8}, {0, 0, -1}}, caster).surface->object, ObjectId{0});
}

}  // namespace
}  // namespace stilb::scene
