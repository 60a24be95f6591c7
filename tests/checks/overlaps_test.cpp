#include "scene/overlaps.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "checks/checks.h"
#include "materials/diffuse.h"

namespace stilb::checks {
namespace {

constexpr MaterialId kWall{0}, kWood{1};

Scene room_with(const std::vector<Object>& objects) {
    Scene scene;
    scene.materials = {{"wall", Diffuse{Rgb::grey(0.5)}}, {"wood", Diffuse{Rgb::grey(0.3)}}};
    scene.objects.push_back({"room", Box{{0, 0, 0}, {4, 4, 3}}, {kWall}});
    scene.objects.insert(scene.objects.end(), objects.begin(), objects.end());
    scene.lights.push_back({"bulb", PointLight{{3, 3, 2.5}, Rgb::grey(100)}});
    return scene;
}

std::vector<std::string> warnings_of_overlaps(const Scene& scene, const std::vector<Sensor>& sensors = {}) {
    const rays::RayCaster caster(scene);
    return overlap_warnings(scene, caster, SceneFindings(scene).overlaps, sensors);
}

std::vector<Overlap> overlaps_of(const Scene& scene) {
    return scene::find_overlaps(scene, scene::OverlapsOf::all_surfaces, 1000);
}

Rectangle on_floor(double size) { return {{1, 1, 0}, {size, 0, 0}, {0, size, 0}}; }

TEST(Overlaps, ARugInTheFloor) {
    const auto warnings = warnings_of_overlaps(room_with({{"rug", on_floor(1), {kWood}}}));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("objects \"room\" and \"rug\" overlap in one plane"), std::string::npos)
        << warnings[0];
}

TEST(Overlaps, TheSharedPlaceIsNamed) {
    const auto overlaps = overlaps_of(room_with({{"rug", on_floor(1), {kWood}}}));
    ASSERT_FALSE(overlaps.empty());
    for (const Overlap& overlap : overlaps) {
        EXPECT_EQ(overlap.position.z, 0);
        EXPECT_GT(std::min(overlap.position.x, overlap.position.y), 1);
        EXPECT_LT(std::max(overlap.position.x, overlap.position.y), 2);
        EXPECT_EQ(std::abs(overlap.normal.z), 1);
    }
}

TEST(Overlaps, EqualTrianglesInASlantedPlane) {
    const Rectangle slanted{{1, 1, 1}, {0.3, 0.4, 0.5}, {-0.2, 0.7, 0.1}};
    const auto overlaps = overlaps_of(room_with({{"a", slanted, {kWall}}, {"b", slanted, {kWood}}}));
    EXPECT_EQ(overlaps.size(), 2u);
}

TEST(Overlaps, NoWarningWhereBothLookAlike) {
    EXPECT_TRUE(warnings_of_overlaps(room_with({{"rug", on_floor(1), {kWall}}})).empty());
}

TEST(Overlaps, EmittersNeverLookLikeOthers) {
    Scene scene = room_with({{"tile", on_floor(1), {kWall}}});
    scene.lights.push_back({"tile", AreaLight{ObjectId{1}, Rgb::grey(10)}});
    EXPECT_EQ(warnings_of_overlaps(scene).size(), 1u);
}

TEST(Overlaps, ALampInTheCeilingIsTaken) {
    Scene scene = room_with({{"panel", Rectangle{{1, 1, 3}, {0, 1, 0}, {1, 0, 0}}, {kWall}}});
    scene.lights.push_back({"panel", AreaLight{ObjectId{1}, Rgb::grey(10)}});
    for (int moved = 0; moved < 2; ++moved) {
        const auto warnings = warnings_of_overlaps(scene);
        ASSERT_EQ(warnings.size(), 1u);
        EXPECT_NE(warnings[0].find("\"panel\" lies in the plane of object \"room\", at "), std::string::npos)
            << warnings[0];
        EXPECT_NE(warnings[0].find("the lamp is taken"), std::string::npos) << warnings[0];
        scene::put_lamps_in_front(scene);  // found again afterwards
    }
}

TEST(Overlaps, PlanesThatDifferByRoundingOverlap) {
    // Whatever the height: no border between intervals may separate the two.
    for (int i = 0; i < 200; ++i) {
        const double z = 0.5 + 1.7e-6 * i;
        const Rectangle low{{1, 1, z}, {1, 0, 0}, {0, 1, 0}}, high{{1, 1, z + 1e-7}, {1, 0, 0}, {0, 1, 0}};
        EXPECT_FALSE(overlaps_of(room_with({{"a", low, {kWall}}, {"b", high, {kWood}}})).empty()) << z;
    }
}

/// A floor of n x n squares, of two materials in turns.
Object chequered(std::uint32_t n, double z) {
    Mesh mesh;
    std::vector<MaterialId> materials;
    for (std::uint32_t i = 0; i <= n; ++i) {
        for (std::uint32_t j = 0; j <= n; ++j) mesh.vertices.push_back({3.0 * i / n, 3.0 * j / n, z});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
            mesh.triangles.insert(mesh.triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
            materials.insert(materials.end(), 2, (i + j) % 2 == 0 ? kWall : kWood);
        }
    }
    return {"floor", mesh, materials};
}

TEST(Overlaps, EachPairOfManyTrianglesIsFoundOnce) {
    EXPECT_TRUE(overlaps_of(room_with({chequered(60, 0.5)})).empty());
    const Rectangle rug{{0.01, 0.01, 0.5}, {2.98, 0, 0}, {0, 2.98, 0}};
    // One half of the squares differs from the rug; its diagonal divides 60 of them.
    const auto overlaps = scene::find_overlaps(room_with({chequered(60, 0.5), {"rug", rug, {kWood}}}),
                                               scene::OverlapsOf::all_surfaces, 100'000);
    std::set<std::pair<std::uint32_t, double>> pairs;
    for (const Overlap& overlap : overlaps) pairs.insert({overlap.triangle, overlap.position.x});
    EXPECT_EQ(pairs.size(), overlaps.size());
    EXPECT_GE(overlaps.size(), 3600u);
    EXPECT_LE(overlaps.size(), 3600u + 2 * 60);
}

TEST(Overlaps, ACabinetMayStandOnTheFloor) {
    EXPECT_TRUE(warnings_of_overlaps(room_with({{"cabinet", Box{{1, 1, 0}, {2, 2, 2}}, {kWood}}})).empty());
}

TEST(Overlaps, CabinetsThatTouchMayStandOnTheFloor) {
    EXPECT_TRUE(warnings_of_overlaps(room_with({{"left", Box{{1, 1, 0}, {1.1, 2, 2}}, {kWood}},
                                                {"middle", Box{{1, 2, 0}, {1.1, 2.04, 1}}, {kWood}},
                                                {"right", Box{{1, 2.04, 0}, {1.1, 3, 2}}, {kWood}}}))
                    .empty());
}

TEST(Overlaps, AHouseMayStandOnTheGroundUnderTheSky) {
    Scene scene;
    scene.materials = {{"wall", Diffuse{Rgb::grey(0.5)}}, {"grass", Diffuse{Rgb::grey(0.3)}}};
    scene.objects.push_back({"ground", Rectangle{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}}, {kWood}});
    scene.objects.push_back({"house", Box{{0, 0, 0}, {8, 8, 6}}, {kWall}});
    scene.lights.push_back({"sky", EnvironmentLight{Rgb::grey(1000)}});
    const std::vector<Sensor> sensors{{"garden", IlluminancePoints{{{{-5, -5, 1}, {0, 0, 1}}}}}};
    EXPECT_TRUE(warnings_of_overlaps(scene, sensors).empty());
    // A path on the ground is seen by the sensor, and there nothing else is.
    scene.objects[1] = {"path", Rectangle{{0, 0, 0}, {2, 0, 0}, {0, 20, 0}}, {kWall}};
    EXPECT_EQ(warnings_of_overlaps(scene, sensors).size(), 1u);
}

TEST(Overlaps, NeighboursAndParallelsDoNotOverlap) {
    const Rectangle left{{1, 1, 1}, {1, 0, 0}, {0, 1, 0}}, right{{2, 1, 1}, {1, 0, 0}, {0, 1, 0}};
    const Rectangle above{{1, 1, 1.001}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_TRUE(
        overlaps_of(room_with({{"a", left, {kWood}}, {"b", right, {kWall}}, {"c", above, {kWall}}})).empty());
}

}  // namespace
}  // namespace stilb::checks
