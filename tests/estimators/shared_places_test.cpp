// A guess of the light where several surfaces lie in one plane.
#include "estimators/local/guess/shared_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "estimators/estimates.h"
#include "estimators/estimator_list.h"
#include "support/scene_builder.h"

namespace stilb::estimators {
namespace {

std::vector<Measurand> points_at(double z, double from_x, double from_y, double step, int edge) {
    std::vector<Measurand> points;
    for (int i = 0; i < edge * edge; ++i)
        points.push_back(
            MeasuringPoint{{from_x + step * (i % edge), from_y + step * (i / edge), z}, {0, 0, 1}});
    return points;
}

void add_lamp(Scene& scene) {
    add_area_light(scene, Rectangle{{1.3, 1.1, 2.5}, {0, 0.8, 0}, {0.8, 0, 0}}, Rgb::grey(1000));
}

/// Every reading by a guess is that of path tracing, in one scene or in two of which one is the same.
void expect_same(const MeasuredScene& guided, const MeasuredScene& traced) {
    const auto by_guess = guided.by(make_guided, 256), by_paths = traced.by(make_path, 2048, 2);
    const double threshold = statistics::sidak_threshold_z(1e-3, by_guess.size());
    for (std::size_t j = 0; j < by_guess.size(); ++j) {
        EXPECT_LT(distance_of(by_guess[j], by_paths[j]), threshold)
            << j << ": " << by_guess[j].value << " +- " << by_guess[j].standard_error << ", "
            << by_paths[j].value << " +- " << by_paths[j].standard_error;
        EXPECT_LT(by_guess[j].standard_error, 0.01 * by_paths[j].value);
    }
}

/// The room's floor is lit, the box's bottom in the same plane is not: light of the floor came out of it, and
/// its residual took more away.
TEST(SharedPlaces, InABoxOnTheFloorItIsDark) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4.2, 3.1, 2.6}}, diffuse(0.7));
    add_object(scene, Box{{1.01, 0.93, 0}, {2.27, 1.91, 0.09}}, diffuse(0.5));
    add_lamp(scene);
    const auto inside = points_at(0.02, 1.05, 0.96, 0.23, 5);
    const MeasuredScene in_box(scene, inside);
    const double threshold = statistics::sidak_threshold_z(0.01, inside.size());
    for (const statistics::Estimate& reading : in_box.by(make_guided, 256))
        EXPECT_LT(distance_of(reading, {}), threshold) << reading.value << " +- " << reading.standard_error;
    // A few dark readings among others have no noise.
    std::vector<Measurand> points = inside;
    std::ranges::copy(points_at(0.8, 0.3, 0.3, 0.5, 6), std::back_inserter(points));
    const auto all = MeasuredScene(scene, points).by(make_guided, 64);
    for (std::size_t j = 0; j < points.size(); ++j) {
        EXPECT_EQ(all[j].value == 0, j < inside.size()) << j;
        EXPECT_EQ(all[j].standard_error == 0, j < inside.size()) << j;
    }
}

TEST(SharedPlaces, BesideABoxOnTheFloorNothingIsLost) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4.2, 3.1, 2.6}}, diffuse(0.7));
    add_object(scene, Box{{1.01, 0.93, 0}, {2.27, 1.91, 0.6}}, diffuse(0.5));
    add_lamp(scene);
    const MeasuredScene room(std::move(scene), points_at(0.02, 0.3, 0.4, 0.6, 4));
    MeasuredScene outside(room.scene, {});
    for (const Measurand& point : room.measurands) {
        const Vec3 at = sensors::position_of(point);
        if (at.x < 1 || at.x > 2.3 || at.y < 0.9 || at.y > 1.95) outside.measurands.push_back(point);
    }
    ASSERT_GT(outside.measurands.size(), 8u);
    expect_same(outside, outside);
}

/// Faces that occur twice send out no light twice.
TEST(SharedPlaces, ARoomWhoseFacesOccurTwiceIsTheRoom) {
    Scene once;
    add_object(once, Box{{0, 0, 0}, {4.2, 3.1, 2.6}}, diffuse(0.7));
    add_lamp(once);
    Scene twice = once;
    add_object(twice, Box{{0, 0, 0}, {4.2, 3.1, 2.6}}, diffuse(0.7));
    const auto points = points_at(0.3, 0.4, 0.4, 0.7, 4);
    const MeasuredScene single(std::move(once), points);
    expect_same(MeasuredScene(std::move(twice), points), single);
}

/// The same where the second ones are other triangles, and turned over.
TEST(SharedPlaces, ARugInTheFloorOfTheSameColourChangesNothing) {
    Scene once;
    add_object(once, Box{{0, 0, 0}, {4.2, 3.1, 2.6}}, diffuse(0.7));
    add_lamp(once);
    Scene with_rug = once;
    add_object(with_rug, Rectangle{{0.5, 0.4, 0}, {0.3, 2.1, 0}, {3.1, -0.2, 0}}, diffuse(0.7));
    const auto points = points_at(0.3, 0.4, 0.4, 0.7, 4);
    const MeasuredScene single(std::move(once), points);
    expect_same(MeasuredScene(std::move(with_rug), points), single);
}

TEST(SharedPlaces, HaveOneOwner) {
    Scene scene;
    add_object(scene, Rectangle{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, diffuse(0.5));
    add_object(scene, Rectangle{{1, 0, 0}, {0, 2, 0}, {2, 0, 0}}, diffuse(0.5));  // faces down
    add_object(scene, Disk{{0.3, 0.3, 0}, {0, 0, 1}, 0.2}, diffuse(0.5));
    const rays::RayCaster caster(scene);
    const patches::Patches patches = patches::make_patches(scene, 10);
    const auto is_disk = [](ObjectId object, MaterialId) { return index_of(object) == 2; };
    SharedPlaces places(scene, caster, patches, is_disk);
    const std::uint32_t below = patches.first_of_object[1];
    ASSERT_EQ(below, 2u);
    for (std::uint32_t patch = 0; patch < 4; ++patch) {
        for (const math::Barycentric& at :
             {math::Barycentric{0.6, 0.2, 0.2}, {0.2, 0.6, 0.2}, {0.2, 0.2, 0.6}}) {
            const Vec3 position = patches.position(patch, at);
            if (length(position - Vec3{0.3, 0.3, 0}) < 0.25) continue;
            const bool is_shared = position.x > 1 && position.x < 2;
            const bool is_first = patch < below;
            const std::uint32_t side = is_first ? patch : patches.other_side(patch);  // faces up
            EXPECT_EQ(places.owns(side, at), is_first || !is_shared);
            const auto owner = places.owner_of(side, at);
            ASSERT_NE(owner.side, patches::kNoSide);
            EXPECT_GT(dot(patches.normal_of(owner.side), patches.normal_of(side)), 0.99);
            EXPECT_LT(length(patches.position(patches.patch_of(owner.side), owner.at) - position), 1e-5);
        }
    }
    EXPECT_TRUE(places.is_traced_at({0.3, 0.35, 0}));
    EXPECT_FALSE(places.is_traced_at({0.7, 0.7, 0}));
    // What no light reaches comes first.
    places.set_lit({0, 1});
    const math::Barycentric middle{1. / 3, 1. / 3, 1. / 3};
    for (std::uint32_t patch = 0; patch < 2; ++patch) {
        EXPECT_EQ(places.owns(patch, middle), patches.position(patch, middle).x < 1);
    }
}

}  // namespace
}  // namespace stilb::estimators
