#include "rays/shaft_query.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "materials/thin_dielectric.h"
#include "math/random.h"
#include "rays/ray_caster.h"
#include "support/scene_builder.h"

namespace stilb::rays {
namespace {

constexpr std::array<Vec3, 4> kBelow{Vec3{0, 0, 0.001}, {1, 0, 0.001}, {1, 1, 0.001}, {0, 1, 0.001}};
constexpr std::array<Vec3, 4> kAbove{Vec3{2, 0, 2}, {3, 0, 2}, {3, 1, 2}, {2, 1, 2}};

Scene room() {
    Scene scene;
    add_object(scene, Box{{-1, -1, 0}, {4, 3, 2.5}}, diffuse(0.5));
    return scene;
}

bool is_empty(const Scene& scene, std::span<const Vec3> from = kBelow, std::span<const Vec3> to = kAbove) {
    return ShaftQuery(scene, scene::lift_of(scene).center()).is_empty(from, to, std::nullopt);
}

/// A triangle of the given size that faces along z.
Shape splinter(const Vec3& at, double size) {
    return Mesh{{at, at + Vec3{size, 0, 0}, at + Vec3{0, size, 0}}, {{0, 1, 2}}};
}

TEST(ShaftQuery, ARoomWithNothingInsideIsEmptyUpToItsWalls) {
    EXPECT_TRUE(is_empty(room()));
    EXPECT_TRUE(is_empty(Scene{}));
}

TEST(ShaftQuery, TinyOccludersAreNeverMissed) {
    for (std::uint64_t i = 0; i < 300; ++i) {
        math::SampleStream stream(math::RandomKey{1}, i, 0);
        const auto [a, b] = stream.next_two();
        const auto [c, d] = stream.next_two();
        const Vec3 from{a, b, 0.001}, to{2 + c, d, 2};
        const double t = 0.05 + 0.9 * stream.next();
        Scene scene = room();
        add_object(scene, splinter(from + t * (to - from), 1e-5), diffuse(0.5));
        EXPECT_FALSE(is_empty(scene)) << i;
    }
}

TEST(ShaftQuery, SurfacesBesideBelowAndBehindDoNotCount) {
    for (const Vec3& at :
         {Vec3{2.5, 0.5, 0.5}, {0.2, 0.5, 1.8}, {0.5, 1.5, 0.5}, {0.5, 0.5, -0.5}, {2.5, 0.5, 2.2}}) {
        Scene scene = room();
        add_object(scene, splinter(at, 0.1), diffuse(0.5));
        EXPECT_TRUE(is_empty(scene)) << at.x << " " << at.y << " " << at.z;
    }
}

TEST(ShaftQuery, ATriangleThatTheHullTouchesCounts) {
    Scene scene = room();
    add_object(scene, Rectangle{{-1, -1, 0.001}, {5, 0, 0}, {0, 4, 0}}, diffuse(0.5));
    EXPECT_FALSE(is_empty(scene));
}

TEST(ShaftQuery, PanesAndCurvedSurfacesCount) {
    Scene pane = room();
    add_object(pane, Rectangle{{-1, -1, 1}, {5, 0, 0}, {0, 4, 0}}, ThinDielectric{});
    EXPECT_FALSE(is_empty(pane));
    Scene ball = room();
    const ObjectId object = add_object(ball, Sphere{{1.5, 0.5, 1}, 0.05}, diffuse(0.5));
    EXPECT_FALSE(is_empty(ball));
    EXPECT_TRUE(ShaftQuery(ball, {}).is_empty(kBelow, kAbove, object));
    Scene aside = room();
    add_object(aside, Sphere{{3, 0.5, 0.5}, 0.1}, diffuse(0.5));
    EXPECT_TRUE(is_empty(aside));
}

/// Random clutter, random shafts: no ray within an empty one is stopped.
TEST(ShaftQuery, RaysAgree) {
    int empty = 0, stopped = 0;
    for (std::uint64_t i = 0; i < 60; ++i) {
        math::SampleStream stream(math::RandomKey{2}, i, 0);
        const auto next = [&] { return stream.next(); };
        Scene scene = room();
        for (int k = 0; k < 12; ++k) {
            const Vec3 at{5 * next() - 1, 4 * next() - 1, 2.4 * next()};
            const Vec3 u{next() - 0.5, next() - 0.5, next() - 0.5},
                v{next() - 0.5, next() - 0.5, next() - 0.5};
            add_object(scene, Rectangle{at, 0.6 * u, 0.6 * v}, diffuse(0.5));
        }
        const RayCaster caster(scene);
        const ShaftQuery query(scene, caster.center());
        for (int shaft = 0; shaft < 100; ++shaft) {
            std::vector<Vec3> from, to;
            const Vec3 a{4.5 * next() - 0.9, 3.5 * next() - 0.9, 2 * next() + 0.1},
                b{4.5 * next() - 0.9, 3.5 * next() - 0.9, 2 * next() + 0.1};
            for (int k = 0; k < 6; ++k) {
                from.push_back(a + 0.2 * Vec3{next(), next(), next()});
                to.push_back(b + 0.2 * Vec3{next(), next(), next()});
            }
            if (!query.is_empty(from, to, std::nullopt)) continue;
            ++empty;
            for (const Vec3& p : from) {
                for (const Vec3& q : to) stopped += caster.occluded(p, q);
            }
        }
    }
    EXPECT_GT(empty, 600);
    EXPECT_EQ(stopped, 0);
}

}  // namespace
}  // namespace stilb::rays
