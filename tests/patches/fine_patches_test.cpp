// Patches that are finer where a limit asks for it.
#include <gtest/gtest.h>

#include <map>

#include "materials/diffuse.h"
#include "patches/patches.h"
#include "patches/refinement.h"
#include "support/scene_builder.h"

namespace stilb::patches {
namespace {

constexpr double kSize_m = 1;

Scene room() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.5}}, Diffuse{Rgb::grey(0.5)});
    add_object(scene, Sphere{{2, 1.5, 1}, 0.5}, Diffuse{Rgb::grey(0.5)});
    return scene;
}

/// Short edges near the corner at the origin.
double limit_near_origin(std::uint32_t, const std::array<Vec3, 3>& corners) {
    return std::max(0.1, 0.3 * length((1. / 3) * (corners[0] + corners[1] + corners[2])));
}

double area_m2(const Patches& patches) {
    double sum = 0;
    for (const float area : patches.areas_m2) sum += double{area};
    return sum;
}

TEST(FinePatches, AreThoseOfTheCoarseOnesWithoutALimit) {
    const Scene scene = room();
    const Patches coarse = make_patches(scene, kSize_m);
    const FinePatches fine = make_fine_patches(
        scene, kSize_m, [](std::uint32_t, const std::array<Vec3, 3>&) { return 10.0; }, 1000);
    EXPECT_EQ(fine.patches.corners, coarse.corners);
    EXPECT_EQ(fine.patches.first_of_object, coarse.first_of_object);
    for (std::uint32_t p = 0; p < fine.parents.size(); ++p) EXPECT_EQ(fine.parents[p], p);
}

TEST(FinePatches, LieInTheirParents) {
    const Scene scene = room();
    const Patches coarse = make_patches(scene, kSize_m);
    const FinePatches fine = make_fine_patches(scene, kSize_m, limit_near_origin, 100'000);
    ASSERT_GT(fine.patches.count(), 2 * coarse.count());
    std::map<std::uint32_t, double> areas_m2;
    for (std::uint32_t p = 0; p < fine.patches.count(); ++p) {
        const std::uint32_t parent = fine.parents[p];
        areas_m2[parent] += double{fine.patches.areas_m2[p]};
        EXPECT_EQ(fine.patches.materials[p], coarse.materials[parent]);
        EXPECT_EQ(fine.patches.object_of(p), coarse.object_of(parent));
        EXPECT_GT(dot(fine.patches.normal_of(p), coarse.normal_of(parent)), 0.9);
    }
    for (std::uint32_t p = 0; p < coarse.first_of_object[1]; ++p)
        EXPECT_NEAR(areas_m2[p], double{coarse.areas_m2[p]}, 1e-5);
    EXPECT_GE(area_m2(fine.patches), area_m2(coarse) - 1e-4) << "finer spheres are larger";
}

TEST(FinePatches, HaveNoEdgeAboveTheLimit) {
    const FinePatches fine = make_fine_patches(room(), kSize_m, limit_near_origin, 100'000);
    for (std::uint32_t p = 0; p < fine.patches.count(); ++p) {
        std::array<Vec3, 3> corners;
        for (std::size_t i = 0; i < 3; ++i)
            corners[i] = fine.patches.center + Vec3(fine.patches.vertices[fine.patches.corners[p][i]]);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_LE(length(corners[(i + 1) % 3] - corners[i]), 1.0001 * limit_near_origin(p, corners));
    }
}

/// No T-junctions: each edge of the box's sides is shared by two patches, or lies on the side's rim.
TEST(FinePatches, NeighboursShareTheirEdges) {
    const FinePatches fine = make_fine_patches(room(), kSize_m, limit_near_origin, 100'000);
    std::map<std::uint64_t, int> uses;
    for (std::uint32_t p = 0; p < fine.patches.first_of_object[1]; ++p) {
        const Triangle& t = fine.patches.corners[p];
        for (std::size_t i = 0; i < 3; ++i) ++uses[edge_key(t[i], t[(i + 1) % 3])];
    }
    const auto on_rim = [&](std::uint32_t vertex) {
        const Vec3 v = fine.patches.center + Vec3(fine.patches.vertices[vertex]);
        const int planes = (std::abs(v.x) < 1e-5 || std::abs(v.x - 4) < 1e-5) +
                           (std::abs(v.y) < 1e-5 || std::abs(v.y - 3) < 1e-5) +
                           (std::abs(v.z) < 1e-5 || std::abs(v.z - 2.5) < 1e-5);
        return planes >= 2;
    };
    for (const auto& [edge, count] : uses) {
        const auto a = static_cast<std::uint32_t>(edge >> 32), b = static_cast<std::uint32_t>(edge);
        EXPECT_EQ(count, on_rim(a) && on_rim(b) && count == 1 ? 1 : 2);
    }
}

TEST(FinePatches, AreNotTooMany) {
    const FinePatches fine = make_fine_patches(
        room(), kSize_m, [](std::uint32_t, const std::array<Vec3, 3>&) { return 0.01; }, 2000);
    EXPECT_LT(fine.patches.count(), 12'000u) << "one more halving of an object may exceed the number";
}

}  // namespace
}  // namespace stilb::patches
