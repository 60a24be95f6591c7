// The centre of ray queries, and what is lifted by how much.
#include <gtest/gtest.h>

#include "support/scene_builder.h"

namespace stilb::scene {
namespace {

/// A room of 4 m.
void add_room(Scene& scene, const Vec3& at) {
    add_object(scene, Box{at, at + Vec3{4, 3, 2.5}}, diffuse(0.5));
    add_object(scene, Box{at + Vec3{1, 1, 0.7}, at + Vec3{2, 2, 0.75}}, diffuse(0.5));
    add_point_light(scene, at + Vec3{2, 1, 2}, Rgb::grey(1));
}

Mesh triangle_at(const Vec3& p) { return {{p, p + Vec3{1, 0, 0}, p + Vec3{0, 1, 0}}, {{0, 1, 2}}}; }

TEST(LiftOf, IsAroundTheMiddleOfScenesUpTo64Metres) {
    for (const double side_m : {63.9, 64.0, 64.1}) {
        Scene scene;
        add_room(scene, {});
        add_object(scene, Rectangle{{0, 0, 0}, {side_m, 0, 0}, {0, side_m, 0}}, diffuse(0.5));
        const Lift lift = lift_of(scene, std::vector<Vec3>{{1, 1, 1}});
        EXPECT_EQ(lift.center().x == side_m / 2, side_m <= 64) << side_m;
        EXPECT_EQ(length(lift.center() - Vec3{1, 1, 1}) < 4, side_m > 64);
    }
}

TEST(LiftOf, IsAroundWhatIsNearToTheMeasuredPoints) {
    const Vec3 map{3.5e6, 5.4e6, 100}, other{3.5e6, 5.41e6, 100};
    Scene scene;
    add_room(scene, map), add_room(scene, other);
    for (int i = 0; i < 20; ++i) add_object(scene, triangle_at({100.0 * i, 0, 0}), diffuse(0.5));
    add_object(scene, icosphere({map + Vec3{2000, 0, 0}, 5}, 5), diffuse(0.5));
    for (const Vec3& at : {map, other}) {
        const Lift lift = lift_of(scene, std::vector{at + Vec3{1, 1, 0}, at + Vec3{2, 2, 0.75}});
        EXPECT_LT(length(lift.center() - at), 5);
        EXPECT_LT(lift.offset_m(at + Vec3{4, 3, 2.5}, 4), 2e-5);
    }
}

/// Neither x of one and y of the other, nor half the way between them.
TEST(LiftOf, IsInOneOfTwoPlacesThatAreMeasured) {
    const Vec3 a{0, 0, 0}, b{5000, -7000, 20};
    Scene scene;
    add_room(scene, a), add_room(scene, b);
    const std::vector<Vec3> both{a + Vec3{1, 1, 0}, b + Vec3{1, 1, 0}};
    for (const Lift& lift : {lift_of(scene, both), lift_of(scene)}) {
        EXPECT_LT(std::min(length(lift.center() - a), length(lift.center() - b)), 5);
    }
}

TEST(LiftOf, DoesNotCountATriangleThatWasLeftElsewhere) {
    const Vec3 map{3.5e6, 5.4e6, 100};
    Scene scene;
    Mesh room = triangulated(Box{map, map + Vec3{4, 3, 2.5}});
    const auto first = static_cast<std::uint32_t>(room.vertices.size());
    for (const Vec3& vertex : triangle_at({}).vertices) room.vertices.push_back(vertex);
    room.triangles.push_back({first, first + 1, first + 2});
    add_object(scene, room, diffuse(0.5));
    EXPECT_LT(length(lift_of(scene).center() - map), 5);
    EXPECT_LT(length(lift_of(scene, std::vector{map + Vec3{1, 1, 0}}).center() - map), 5);
}

TEST(Lift, OfThingsSeenFromAfarGrowsWithTheDistance) {
    const Lift lift({}, 1);
    const double near_m = lift.offset_m({}, 0.1, 0.9);
    EXPECT_EQ(near_m, lift.offset_m({}, 0.1));  // a quarter of the extent is more
    EXPECT_EQ(near_m, lift.offset_m({}, 0.1, 1));
    EXPECT_GT(lift.offset_m({}, 0.1, 1.1), near_m);
    EXPECT_EQ(lift.offset_m({}, 0.1, 1000), 2 * lift.offset_m({}, 0.1, 500));
}

/// Of many points and triangles only some are compared (kMostPoints, kMostVisits): the centre is where most
/// of the points are, all the same.
TEST(LiftOf, IsAroundTheMeasuredPointsHoweverManyThereAre) {
    const Vec3 map{3.5e6, 5.4e6, 100};
    Scene scene;
    add_room(scene, map);
    add_object(scene, triangle_at({}), diffuse(0.5));
    for (const int count : {1, 2, 31, 32, 33, 100}) {
        std::vector<Vec3> points;
        for (int i = 0; i < count; ++i) points.push_back(map + Vec3{1 + 0.02 * i, 1, 0});
        EXPECT_LT(length(lift_of(scene, points).center() - map), 5) << count;
    }
    const std::vector<Vec3> points(40, map + Vec3{1, 1, 0});
    for (const std::uint32_t triangles : {624'996, 624'997, 624'998}) {  // and three others
        Scene large = scene;
        Mesh& mesh = std::get<Mesh>(large.objects.back().shape);
        mesh.triangles.resize(triangles, mesh.triangles.front());
        EXPECT_LT(length(lift_of(large, points).center() - map), 5) << triangles;
    }
}

/// Rays from beyond 32 extents of the room are lifted by a share of their length instead.
TEST(LiftOf, DoesNotCountWhatLiesBeyondAGap) {
    const std::vector<Vec3> measured{{1, 1, 0}};  // with the lamp, x is at most 2
    for (const double distance_m : {127.9, 128.0, 128.1, 1e6}) {
        Scene scene;
        add_room(scene, {});
        add_object(scene, triangle_at({2 + distance_m, 0, 0}), diffuse(0.5));
        const double near_m = distance_m > 128 ? 4 : 32;
        EXPECT_EQ(lift_of(scene, measured).largest_size_m(), near_m) << distance_m;
        EXPECT_EQ(lift_of(scene).largest_size_m(), 32);
    }
}

/// Wherever a mesh has a stray triangle, and on every side.
TEST(LiftOf, DoesNotCountAPartOfAMeshBeyondAGap) {
    for (const Vec3& stray : {Vec3{1e4, 0, 0}, Vec3{-1e4, 0, 0}, Vec3{0, 1e4, 0}, Vec3{0, 0, -1e7}}) {
        Scene scene;
        add_room(scene, {});
        Mesh& room =
            std::get<Mesh>(scene.objects[0].shape = triangulated(std::get<Box>(scene.objects[0].shape)));
        const auto first = static_cast<std::uint32_t>(room.vertices.size());
        for (const Vec3& vertex : triangle_at(stray).vertices) room.vertices.push_back(vertex);
        room.triangles.push_back({first, first + 1, first + 2});
        EXPECT_EQ(lift_of(scene, std::vector<Vec3>{{1, 1, 0}}).largest_size_m(), 4);
    }
}

/// A lamp and a measured point there count, however far they are.
TEST(LiftOf, CountsLampsAndMeasuredPointsBeyondAGap) {
    Scene scene;
    add_room(scene, {});
    EXPECT_EQ(lift_of(scene, std::vector<Vec3>{{1, 1, 0}, {1000, 1, 0}}).largest_size_m(), 32);
    add_point_light(scene, {0, 0, 1000}, Rgb::grey(1));
    EXPECT_EQ(lift_of(scene, std::vector<Vec3>{{1, 1, 0}}).largest_size_m(), 32);
}

/// One of 1 cm, 20 m beside another thing, in a scene of less than 64 m.
TEST(LiftOf, IsThatOfASmallRoomInASmallScene) {
    Scene scene;
    add_object(scene, Box{{5, 5, 5}, {5.01, 5.01, 5.01}}, diffuse(0.5));
    add_object(scene, triangle_at({25, 5, 5}), diffuse(0.5));
    const Vec3 inside{5.003, 5.002, 5.001};
    const Lift lift = lift_of(scene, std::vector{inside});
    EXPECT_NEAR(lift.largest_size_m(), 0.01, 1e-12);
    EXPECT_LT(length(lift.center() - inside), 0.02);
}

/// Where nothing is measured nearby, things are lifted for those who see them.
TEST(LiftOf, KnowsHowFarTheNearestMeasuredPointIs) {
    Scene scene;
    add_area_light(scene, Rectangle{{0, 0, 0}, {0.3, 0, 0}, {0, 0.3, 0}}, Rgb::grey(1));
    EXPECT_EQ(lift_of(scene).least_size_m(), 0.15 / 4);
    EXPECT_NEAR(lift_of(scene, std::vector<Vec3>{{0, 0, -31}}).least_size_m(), 31. / 4, 1e-9);
    EXPECT_NEAR(lift_of(scene, std::vector<Vec3>{{0, 0, -33}}).least_size_m(), 33. / 4, 1e-9);
    EXPECT_NEAR(lift_of(scene, std::vector<Vec3>{{0, 0, -1}, {0, 0, -1000}}).least_size_m(), 8, 1e-9);
}

}  // namespace
}  // namespace stilb::scene
