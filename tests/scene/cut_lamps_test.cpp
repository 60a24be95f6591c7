#include "scene/cut_lamps.h"

#include <gtest/gtest.h>

#include "geometry/mesh_topology.h"
#include "materials/black.h"

namespace stilb::scene {
namespace {

/// A box with a material for each of its twelve triangles.
Scene scene_of_box() {
    Scene scene;
    std::vector<MaterialId> materials;
    for (std::uint32_t t = 0; t < 12; ++t) {
        scene.materials.push_back({std::to_string(t), Black{}});
        materials.push_back(MaterialId{t});
    }
    scene.objects.push_back({"box", triangulated(Box{{0, 0, 0}, {4, 3, 2.5}}), materials});
    return scene;
}

double area_of(const Scene& scene, ObjectId object) { return area_m2(scene.object(object).shape); }

TEST(CutLamps, TakeTheirTrianglesAndMaterialsAlong) {
    Scene scene = scene_of_box();
    const double area = area_of(scene, ObjectId{0});
    const ObjectId lamp = cut_out(scene, ObjectId{0}, std::vector<std::uint32_t>{3, 7}, "box (lamp)");
    EXPECT_EQ(lamp, ObjectId{1});
    EXPECT_EQ(scene.object(lamp).name, "box (lamp)");
    EXPECT_EQ(scene.object(lamp).materials, (std::vector{MaterialId{3}, MaterialId{7}}));
    EXPECT_EQ(scene.object(ObjectId{0}).materials.size(), 10u);
    EXPECT_EQ(scene.object(ObjectId{0}).materials[3], MaterialId{4});
    EXPECT_EQ(scene.object(ObjectId{0}).name, "box");
    EXPECT_NEAR(area_of(scene, ObjectId{0}) + area_of(scene, lamp), area, 1e-12);
}

TEST(CutLamps, SeveralOfOneMeshMakeItWholeAgain) {
    Scene scene = scene_of_box();
    cut_out(scene, ObjectId{0}, std::vector<std::uint32_t>{0, 1, 2}, "a");
    cut_out(scene, ObjectId{0}, std::vector<std::uint32_t>{8}, "b");
    EXPECT_EQ(cut_from(scene, ObjectId{0}), (std::vector{ObjectId{1}, ObjectId{2}}));
    EXPECT_EQ(scene.objects[2].materials, std::vector{MaterialId{11}}) << "number 8 of the remaining ones";
    const auto& rest = std::get<Mesh>(scene.objects[0].shape);
    EXPECT_GT(geometry::find_components(rest).total_open_edges(), 0u);
    const Mesh whole = whole_mesh(scene, ObjectId{0});
    EXPECT_EQ(whole.triangles.size(), 12u);
    EXPECT_EQ(geometry::find_components(whole).total_open_edges(), 0u);
}

}  // namespace
}  // namespace stilb::scene
