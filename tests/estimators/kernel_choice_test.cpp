#include "estimators/local/kernel_choice.h"

#include <gtest/gtest.h>

#include "estimators/receivers.h"
#include "support/scene_builder.h"

namespace stilb::estimators {
namespace {

/// On a table at a height of 0.8 m, between two walls.
struct Table {
    Table() { add_object(scene, Box{{0, 0, 0}, {3, 3, 3}}, diffuse(0.5)); }
    KernelChoice::Sums sums_of(const KernelChoice& choice) const {
        const rays::RayCaster caster(scene);
        return choice.sums_for(receivers_of({{{0.1, 1.5, 0.8}, {0, 0, 1}}}, caster), 1);
    }

    Scene scene;
};

/// Most of the light of a surface that ends a little above the table comes from its upper part, although its
/// middle is below.
TEST(KernelChoice, SurfacesAcrossTheHorizonAreNotRare) {
    const Table table;
    const auto probability_of = [&](double radius_m) {
        KernelChoice choice(Vec3{});
        choice.add({0, 1.5, 0.79}, {1, 0, 0}, 1, radius_m);
        choice.add({3, 1.5, 2}, {-1, 0, 0}, 1, radius_m);
        const KernelChoice::Sums sums = table.sums_of(choice);
        return double{sums[0]} / double{sums[1]};
    };
    EXPECT_LT(probability_of(0), 0.06);  // the defensive share, halved
    EXPECT_GT(probability_of(0.1), 0.5);
}

/// Points far below the horizon remain rare, and points above it keep their weights.
TEST(KernelChoice, ASmallSurfaceCountsAsItsMiddle) {
    const Table table;
    KernelChoice points(Vec3{}), surfaces(Vec3{});
    for (const double z : {0.2, 1.5, 2.5}) {
        points.add({0, 1.5, z}, {1, 0, 0}, 1);
        surfaces.add({0, 1.5, z}, {1, 0, 0}, 1, 0.02);
    }
    const KernelChoice::Sums exact = table.sums_of(points), about = table.sums_of(surfaces);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(about[i] / about[2], exact[i] / exact[2], 0.01);
}

/// A point whose lobe points to the receiver has the light of its peak, one whose lobe points elsewhere that
/// of its base. Points without lobes beside them, in the same packet of sixteen, keep theirs.
TEST(KernelChoice, GlossyPointsAreChosenByTheirLobes) {
    const Table table;
    KernelChoice choice(Vec3{});
    const Vec3 position{3, 1.5, 2}, normal{-1, 0, 0}, to_table = normalized(Vec3{0.1, 1.5, 0.8} - position);
    for (int i = 0; i < 17; ++i) choice.add(position, normal, 1);
    choice.add(position, normal, 1, {to_table, 0.5, 20, 100});
    choice.add(position, normal, 1, {Vec3{0, 0, 1}, 0.5, 20, 100});
    const KernelChoice::Sums sums = table.sums_of(choice);
    const auto weight = [&](std::size_t i) { return double{sums[i]} - (i > 0 ? double{sums[i - 1]} : 0); };
    // A tenth of the weights is by light alone: 1 / 190 each.
    const double plain = weight(3) - 0.1 / 19;
    EXPECT_NEAR(plain, 0.9 / (17 + 20.5 + 0.5), 1e-4);
    EXPECT_NEAR(weight(16) - 0.1 / 19, plain, 1e-5);
    EXPECT_NEAR((weight(17) - 0.1 / 19) / plain, 20.5, 0.05);
    EXPECT_NEAR((weight(18) - 0.1 / 19) / plain, 0.5, 0.01);
}

}  // namespace
}  // namespace stilb::estimators
