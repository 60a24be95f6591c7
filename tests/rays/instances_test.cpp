// Instances behave as copies of their mesh.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "geometry/transform.h"
#include "math/sampling.h"
#include "rays/ray_caster.h"
#include "rays/shaft_query.h"
#include "support/closed_meshes.h"
#include "support/random_pairs.h"
#include "support/scene_builder.h"

namespace stilb::rays {
namespace {

geometry::Transform turned(double x, double y, double z, double size, double angle_deg) {
    geometry::Transform place = compose(geometry::Transform::rotation(normalized(Vec3{1, 2, 3}), angle_deg),
                                        geometry::Transform::scaling(size));
    place.translation = {x, y, z};
    return place;
}

/// Rotated, enlarged, mirrored, stretched and sheared.
std::vector<geometry::Transform> places() {
    const geometry::Transform mirrored{{-0.6, 0, 0}, {0, 0.6, 0}, {0, 0, 0.6}, {3, 1, 0.5}};
    const geometry::Transform sheared{{0.5, 0.1, 0}, {0.2, 0.7, 0.1}, {0, -0.2, 0.3}, {1, 2, 2}};
    return {turned(0.5, 0.5, 0.5, 1, 0), turned(2, 2, 0.8, 1.7, 40), mirrored, sheared,
            compose(turned(3, 3, 2.5, 1, 110), {{0.8, 0, 0}, {0, -0.8, 0}, {0, 0, 0.8}, {}})};
}

/// A smooth ball of two materials, away from the origin of its own coordinates.
Mesh two_coloured_ball() { return smooth_icosphere({{10, -5, 2}, 0.4}, 3); }
geometry::Transform to_middle() { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-10, 5, -2}}; }

struct Twins {
    Scene instances, copies;
};

Twins twins() {
    Twins twins;
    const auto mesh = std::make_shared<const Mesh>(two_coloured_ball());
    for (Scene* scene : {&twins.instances, &twins.copies}) {
        add_object(*scene, inward(Box{{-1, -1, -1}, {5, 5, 4}}), diffuse(0.5));
        std::vector<MaterialId> materials(mesh->triangles.size(), add_material(*scene, diffuse(0.3)));
        const MaterialId other = add_material(*scene, diffuse(0.7));
        for (std::size_t t = 0; t < materials.size(); t += 3) materials[t] = other;
        for (const geometry::Transform& place : places()) {
            const Instance instance{mesh, compose(place, to_middle())};
            const Shape shape = scene == &twins.instances ? Shape{instance} : triangulated(instance);
            scene->objects.push_back({"ball", shape, materials});
        }
    }
    return twins;
}

TEST(Instances, HaveTheAreaAndTheBoundsOfCopies) {
    const Twins scenes = twins();
    for (std::size_t i = 1; i < scenes.copies.objects.size(); ++i) {
        const Shape &instance = scenes.instances.objects[i].shape, &copy = scenes.copies.objects[i].shape;
        ASSERT_TRUE(std::holds_alternative<Instance>(instance));
        EXPECT_NEAR(area_m2(instance), area_m2(copy), 1e-12);
        EXPECT_LT(length(bounds_of(instance).min - bounds_of(copy).min), 1e-12);
        EXPECT_LT(length(bounds_of(instance).max - bounds_of(copy).max), 1e-12);
        const Shape further = transformed(instance, turned(1, 2, 3, 0.5, 70));
        EXPECT_NEAR(area_m2(further), area_m2(instance) / 4, 1e-12);
    }
}

TEST(Instances, AreMetAsCopies) {
    const Twins scenes = twins();
    const RayCaster instances(scenes.instances), copies(scenes.copies);
    RandomPairs random(5);
    std::vector<int> met(scenes.copies.objects.size());
    int others = 0;
    for (int i = 0; i < 40'000; ++i) {
        const auto [u1, u2] = random.next_pair();
        const Vec3 origin{4 * random.next(), 4 * random.next(), 3 * random.next()};
        const Vec3 direction = math::sample_sphere(u1, u2).direction;
        const auto a = instances.closest(origin, direction), b = copies.closest(origin, direction);
        ASSERT_TRUE(a && b);
        if (a->object != b->object || a->triangle != b->triangle) {  // at an edge
            ++others;
            continue;
        }
        ++met[index_of(a->object)];
        EXPECT_LT(length(a->position - b->position), 1e-5);
        EXPECT_LT(length(a->lifted - b->lifted), 1e-5);
        EXPECT_NEAR(a->lift_m, b->lift_m, 1e-9);
        EXPECT_GT(dot(a->normal, b->normal), 1 - 1e-9);
        EXPECT_GT(dot(a->shading_normal, b->shading_normal), 1 - 1e-7);
        EXPECT_EQ(a->on_front, b->on_front);
        EXPECT_EQ(index_of(a->material), index_of(b->material));
        EXPECT_NEAR(a->distance_m, b->distance_m, 1e-5);
    }
    EXPECT_LT(others, 40);
    for (const int count : met) EXPECT_GT(count, 200);
}

TEST(Instances, InPacketsHaveTheHitsOfSingleRays) {
    const Twins scenes = twins();
    const RayCaster caster(scenes.instances);
    RandomPairs random(6);
    int smooth = 0, compared = 0;
    for (int round = 0; round < 1000; ++round) {
        RayHitPacket packet;
        LaneMask lanes;
        lanes.fill(-1);
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            const auto [u1, u2] = random.next_pair();
            const Vec3 origin{4 * random.next(), 4 * random.next(), 3 * random.next()};
            packet.ray.set(i, origin - caster.center(), math::sample_sphere(u1, u2).direction,
                           std::numeric_limits<float>::infinity());
        }
        caster.closest(packet, lanes, Coherence::scattered);
        SurfacePacket surfaces;
        caster.surfaces(packet, surfaces);
        for (std::size_t i = 0; i < kPacketWidth; ++i) {
            const Hit hit = caster.hit(packet, i);
            ASSERT_EQ(surfaces.object[i], index_of(hit.object));
            EXPECT_LT(length(surfaces.position.at(i) + caster.center() - hit.position), 2e-6);
            EXPECT_LT(length(surfaces.lifted.at(i) + caster.center() - hit.lifted), 2e-6);
            EXPECT_GT(dot(surfaces.normal.at(i), hit.normal), 1 - 1e-6);
            EXPECT_EQ(surfaces.material[i], index_of(hit.material));
            EXPECT_EQ(surfaces.is_on_front[i] != 0, hit.on_front);
            ++compared;
            if (index_of(hit.object) > 0 && surfaces.is_smooth[i] != 0) ++smooth;
        }
    }
    EXPECT_EQ(compared, 16'000);
    EXPECT_GT(smooth, 1000);
}

TEST(Instances, HideWhatCopiesHide) {
    const Twins scenes = twins();
    const RayCaster instances(scenes.instances), copies(scenes.copies);
    const ShaftQuery of_instances(scenes.instances, instances.center()),
        of_copies(scenes.copies, copies.center());
    RandomPairs random(7);
    int hidden = 0, different = 0, certain = 0;
    for (int i = 0; i < 20'000; ++i) {
        const auto point = [&] { return Vec3{4 * random.next(), 4 * random.next(), 3 * random.next()}; };
        const std::array from{point()}, to{point()};
        const bool is_hidden = copies.occluded(from[0], to[0]);
        hidden += is_hidden ? 1 : 0;
        different += instances.occluded(from[0], to[0]) == is_hidden ? 0 : 1;
        const bool is_certain = of_instances.is_empty(from, to, std::nullopt);
        certain += is_certain ? 1 : 0;
        EXPECT_FALSE(is_certain && is_hidden);
        EXPECT_FALSE(is_certain && !of_copies.is_empty(from, to, std::nullopt));
    }
    EXPECT_GT(hidden, 2000);
    EXPECT_GT(certain, 5000);
    EXPECT_LT(different, 20);
}

class ClosedInstances : public testing::TestWithParam<Queries> {};

TEST_P(ClosedInstances, LoseNoRay) {
    const auto mesh = std::make_shared<const Mesh>(rough_sphere(2).mesh);
    const Vec3 far{300, -200, 100};  // of the mesh's own coordinates
    auto moved = std::make_shared<Mesh>(*mesh);
    for (Vec3& vertex : moved->vertices) vertex += far;
    for (const geometry::Transform& place : places()) {
        geometry::Transform to_world = place;
        to_world.translation -= to_world.direction(far);
        Scene scene;
        add_object(scene, Instance{moved, to_world}, diffuse(0.5));
        EXPECT_EQ(lost_rays(scene, place.translation, GetParam(), 200'000, 3), 0u);
    }
}

INSTANTIATE_TEST_SUITE_P(Queries, ClosedInstances, testing::Values(Queries::single, Queries::packets),
                         [](const auto& query) {
                             return query.param == Queries::single ? "Single" : "Packets";
                         });

}  // namespace
}  // namespace stilb::rays
