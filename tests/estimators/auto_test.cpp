// Which technique method auto chooses.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "estimators/estimates.h"
#include "estimators/estimator_list.h"
#include "materials/phong.h"
#include "support/scene_builder.h"
#include "transport/receiver.h"

namespace stilb::estimators {
namespace {

/// A room with a lamp below its ceiling and a box.
Scene office_room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {3, 3, 3}}, diffuse(0.5));
    add_object(scene, Box{{1.7, 0.6, 0.001}, {2.5, 1.4, 0.7}}, diffuse(0.5));
    add_area_light(scene, Rectangle{{1.1, 1.1, 2.99}, {0, 0.8, 0}, {0.8, 0, 0}}, Rgb::grey(5000));
    return scene;
}

/// Point lights below the ceiling and glossy furniture. Light paths by Sobol' points have little noise here.
Scene room_with_point_lights() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4.2, 3.1, 2.6}}, diffuse(0.75));
    add_object(scene, Box{{0, 2.4, 0}, {4.2, 3.1, 0.7}}, Phong{Rgb::grey(0.35), Rgb::grey(0.3), 60});
    for (const double x : {1., 3.2})
        for (const double y : {0.8, 2.3}) add_point_light(scene, {x, y, 2.2}, Rgb::grey(100));
    return scene;
}

/// columns x rows points on a horizontal rectangle.
std::vector<Measurand> grid(const Vec3& corner, double width, double depth, int columns, int rows) {
    std::vector<Measurand> points;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const Vec3 offset{width * (column + 0.5) / columns, depth * (row + 0.5) / rows, 0};
            points.push_back(MeasuringPoint{corner + offset, {0, 0, 1}});
        }
    }
    return points;
}
std::vector<Measurand> room_grid(int edge) { return grid({0, 0, 0.8}, 3, 3, edge, edge); }

struct Choice : MeasuredScene {
    using MeasuredScene::MeasuredScene;
    std::string_view technique() const { return make_auto(problem())->technique(); }
};

TEST(Auto, TracesPathsFromFewPointsUnderAnAreaLamp) {
    const Choice choice(office_room(), room_grid(4));
    EXPECT_EQ(choice.technique(), "path");
}

TEST(Auto, TakesAGuessForManyPointsUnderAnAreaLamp) {
    const Choice choice(office_room(), room_grid(40));
    EXPECT_EQ(choice.technique(), "guided");
}

/// A cupboard of which a fifth of the points are inside, open below and 1 mm above the floor: there is next
/// to no light in it.
TEST(Auto, TakesAGuessThoughSomePointsAreInACupboard) {
    Scene scene = office_room();
    Mesh cupboard = triangulated(Box{{0.2, 0.2, 0.001}, {1.5, 1.4, 1.8}});
    std::erase_if(cupboard.triangles, [&](const Triangle& t) {
        return std::ranges::all_of(t, [&](std::uint32_t v) { return cupboard.vertices[v].z < 0.01; });
    });
    add_object(scene, cupboard, diffuse(0.5));
    const Choice choice(std::move(scene), room_grid(40));
    EXPECT_EQ(choice.technique(), "guided");
}

/// Of few readings, one is in the dark.
TEST(Auto, TracesPathsThoughAPointIsInABox) {
    std::vector<Measurand> points = room_grid(4);
    points.back() = MeasuringPoint{{2.1, 1, 0.3}, {0, 0, 1}};
    const Choice choice(office_room(), points);
    EXPECT_EQ(choice.technique(), "path");
}

/// Light paths end before a guess is made.
TEST(Auto, TakesNoGuessUnderPointLightsForALargeError) {
    const Choice choice(room_with_point_lights(), grid({1, 1, 0.8}, 1.6, 0.8, 16, 8));
    Problem problem = choice.problem();
    problem.error = 0.02;
    EXPECT_EQ(make_auto(problem)->technique(), "light-paths");
}

TEST(Auto, TakesNoGuessWhereReflectionsHaveALimit) {
    const Choice choice(office_room(), room_grid(40));
    Problem limited = choice.problem();
    limited.max_reflections = 100;
    EXPECT_EQ(make_auto(limited)->technique(), "light-paths");
}

/// A room with a lamp and an open side under the sky, beside a thing a kilometre away: light paths of the sky
/// start around both, and hardly one finds the room.
TEST(Auto, TakesNoLightPathsWhereTheyMissTheLight) {
    Scene open_room;
    const Box room{{0, 0, 0}, {3, 3, 3}};
    for (const std::size_t axis : {0, 1, 2})
        for (const Side side : {Side::low, Side::high})
            if (axis != 1 || side == Side::high) add_object(open_room, wall(room, axis, side), diffuse(0.6));
    add_object(open_room, Rectangle{{1000, 1000, 0}, {0.3, 0, 0}, {0, 0.3, 0}}, diffuse(0.6));
    add_environment(open_room, Rgb::grey(1000));
    add_point_light(open_room, {2, 2, 2.5}, Rgb::grey(100));
    for (const int edge : {8, 9}) {  // 64 readings and more
        const Choice choice(open_room, room_grid(edge));
        EXPECT_NE(choice.technique(), "light-paths") << edge;
        Problem limited = choice.problem();
        limited.max_reflections = 2;
        EXPECT_EQ(make_auto(limited)->technique(), "path") << edge;
    }
}

/// Beside a ground of 2 km, connections to what the guess lacks are few for their area, and nearly each ray
/// is continued by path tracing, ten times as dear: light paths take a tenth of the time.
TEST(Auto, TakesNoGuessForPicturesBesideALargeGround) {
    for (const bool has_ground : {false, true}) {
        Scene scene;
        const Box room{{0, 0, 0}, {3, 3, 3}};
        for (const std::size_t axis : {0, 1, 2})
            for (const Side side : {Side::low, Side::high})
                if (axis != 1 || side == Side::low) add_object(scene, wall(room, axis, side), diffuse(0.7));
        add_object(scene, Rectangle{{0, 3, 0}, {3, 0, 0}, {0, 0, 2}}, diffuse(0.7));
        for (const Vec3& lamp : {Vec3{2.3, 1, 1.3}, Vec3{0.7, 2.3, 2}, Vec3{0.7, 0.9, 1.2}})
            add_area_light(scene, Sphere{lamp, 0.03}, Rgb::grey(1e5));
        add_environment(scene, Rgb::grey(50));
        if (has_ground)
            add_object(scene, Rectangle{{-1000, -1000, -5}, {2000, 0, 0}, {0, 2000, 0}}, diffuse(0.5));
        const Choice choice(std::move(scene), {});
        Problem picture = choice.problem();
        picture.camera = Camera{};
        picture.camera->position = {1.5, 0.3, 1.5};
        picture.camera->target = {1.5, 3, 1};
        picture.camera->fov_deg = 90;
        picture.camera->resolution = {32, 32};
        EXPECT_EQ(make_auto(picture)->technique(), has_ground ? "light-paths" : "guided");
    }
}

/// Where nothing is reflected, methods agree but for rounding: that is no reason to take another one.
TEST(Auto, TakesLightPathsWhereNothingIsRandom) {
    Scene black;
    add_object(black, Box{{0, 0, 0}, {3, 3, 3}}, diffuse(0));
    for (int i = 0; i < 7; ++i) add_point_light(black, {0.3 + 0.37 * i, 1.1, 2.3}, Rgb::grey(100));
    const Choice choice(std::move(black), room_grid(9));
    EXPECT_EQ(choice.technique(), "light-paths");
}

TEST(Auto, TracesNoPathsWhereTheyFindNothing) {
    Scene dark;
    add_object(dark, Box{{0, 0, 0}, {3, 3, 3}}, diffuse(0.5));
    const Choice choice(std::move(dark), room_grid(2));
    EXPECT_EQ(choice.technique(), "light-paths");
}

/// Pilots of a part of the readings promise the cost of all.
TEST(CostPerSample, OfAPartThatStandsForAllIsThatOfAll) {
    for (const auto& make : {make_path, make_balanced, make_guided}) {
        Choice choice(office_room(), room_grid(40));
        const double of_all = make(choice.problem())->cost_per_sample();
        Problem part = choice.problem();
        part.measurands = part.measurands.subspan(640, 160);
        part.stands_for = 10;
        EXPECT_NEAR(make(part)->cost_per_sample(), of_all, 0.25 * of_all);
    }
}

}  // namespace
}  // namespace stilb::estimators
