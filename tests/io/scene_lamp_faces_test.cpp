// Area lights that are some faces of a mesh.
#include <fstream>

#include "io/scene_text.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

/// A cube of 1 m in two groups: its upper face of material "glass", one square of its side of material
/// "button".
constexpr const char* kCube = R"(v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
g housing
usemtl steel
f 4 3 2 1
f 1 2 6 5
f 2 3 7 6
g head
usemtl button
f 3 4 8 7
usemtl steel
f 4 1 5 8
usemtl glass
f 5 6 7 8
)";

class SceneLampFaces : public testing::Test {
  protected:
    void SetUp() override { std::ofstream(directory_ / "cube.obj") << kCube; }

    /// Ten lines before the first light.
    static std::string cube(const std::string& lights) {
        return R"([materials.grey]
type = "diffuse"
reflectance = 0.5
[materials.glow]
type = "black"
[objects.cube]
shape = "mesh"
file = "cube.obj"
material = "grey"
materials = { glass = "glow" }
)" + lights;
    }
    static std::string light(const std::string& name, const std::string& keys) {
        return "[lights." + name + "]\ntype = \"area\"\nobject = \"cube\"\n" + keys + "\n";
    }
    SceneFile read(const std::string& lights) const { return read_scene_text(cube(lights), directory_); }
    std::string refused(const std::string& lights) const { return refusal(cube(lights), directory_); }

    static std::size_t triangles_of(const Object& object) {
        return std::get<Mesh>(object.shape).triangles.size();
    }

    const TestFolder directory_;
};

TEST_F(SceneLampFaces, AreAnObjectOfTheirOwn) {
    const SceneFile file = read(light("a", "material = \"glass\"\nflux = 100"));
    ASSERT_EQ(file.scene.objects.size(), 2u);
    const Object &body = file.scene.objects[0], &lamp = file.scene.objects[1];
    EXPECT_EQ(lamp.name, "cube (glass)");
    EXPECT_EQ(lamp.cut_from, ObjectId{0});
    EXPECT_EQ(triangles_of(lamp), 2u);
    EXPECT_EQ(triangles_of(body), 10u);
    for (const Vec3& vertex : std::get<Mesh>(lamp.shape).vertices) EXPECT_EQ(vertex.z, 1);
    for (const MaterialId material : lamp.materials) EXPECT_EQ(material, MaterialId{1});
    for (const MaterialId material : body.materials) EXPECT_EQ(material, MaterialId{0});
    const auto& source = std::get<AreaLight>(file.scene.lights.at(0).source);
    EXPECT_EQ(source.object, ObjectId{1});
    EXPECT_NEAR(source.luminance_cd_m2.luminance(), 100 / kPi, 1e-9) << "over 1 m2";
}

TEST_F(SceneLampFaces, ByAMaterialOfTheSceneOrAGroupOfTheFile) {
    const SceneFile by_material = read(light("a", "material = \"glow\"\nluminance = 100"));
    EXPECT_EQ(by_material.scene.objects.at(1).name, "cube (glow)");
    EXPECT_EQ(triangles_of(by_material.scene.objects[1]), 2u);
    const SceneFile by_group = read(light("a", "mesh_group = \"head\"\nflux = 30\ngroup = \"evening\""));
    EXPECT_EQ(triangles_of(by_group.scene.objects.at(1)), 6u);
    EXPECT_EQ(by_group.scene.lights[0].group, "evening");
    EXPECT_NEAR(flux_lm(by_group.scene, by_group.scene.lights[0]).luminance(), 30, 1e-9);
}

TEST_F(SceneLampFaces, SeveralLampsOfOneMesh) {
    const SceneFile file =
        read(light("a", "material = \"button\"\nflux = 1") + light("b", "material = \"glass\"\nflux = 2") +
             light("c", "mesh_group = \"head\"\nflux = 3"));
    ASSERT_EQ(file.scene.objects.size(), 4u);
    EXPECT_EQ(triangles_of(file.scene.objects[0]), 6u);
    const auto& glass = std::get<Mesh>(file.scene.objects[2].shape);
    for (const Vec3& vertex : glass.vertices) EXPECT_EQ(vertex.z, 1);
    const auto& rest = std::get<Mesh>(file.scene.objects[3].shape);
    EXPECT_EQ(rest.triangles.size(), 2u) << "of the group, what the others left";
    for (const Vec3& vertex : rest.vertices) EXPECT_EQ(vertex.x, 0);
}

TEST_F(SceneLampFaces, AllFacesAreTheObjectItself) {
    const SceneFile file = read_scene_text(
        "[materials.m]\ntype = \"black\"\n[objects.o]\nshape = \"polygons\"\nmaterial = \"m\"\nvertices = "
        "[[0,0,0], [1,0,0], [0,1,0]]\nfaces = [[0, 1, 2]]\n[lights.a]\ntype = \"area\"\nobject = "
        "\"o\"\nmaterial "
        "= \"m\"\nflux = 1");
    EXPECT_EQ(file.scene.objects.size(), 1u);
    EXPECT_EQ(std::get<AreaLight>(file.scene.lights.at(0).source).object, ObjectId{0});
}

TEST_F(SceneLampFaces, RefusesUnknownParts) {
    EXPECT_EQ(
        refused(light("a", "material = \"glas\"\nflux = 1")),
        "s.toml:14: lights.a.material: the mesh \"cube\" has no material \"glas\". Did you mean \"glass\"? "
        "Allowed: steel, button, glass, grey, glow.");
    EXPECT_EQ(
        refused(light("a", "mesh_group = \"glass\"\nflux = 1")),
        "s.toml:14: lights.a.mesh_group: the mesh \"cube\" has no group \"glass\". Allowed: housing, head.");
    EXPECT_EQ(
        refused(light("a", "material = \"glass\"\nmesh_group = \"head\"\nflux = 1")),
        "s.toml:15: lights.a.mesh_group: contradicts \"material\", which is given too. Allowed: one of the "
        "two.");
}

TEST_F(SceneLampFaces, RefusesFacesThatShineAlready) {
    const std::string glass = light("a", "material = \"glass\"\nflux = 1");
    for (const std::string again : {"material = \"glass\"", "material = \"glow\""}) {
        const std::string message = refused(glass + light("b", again + "\nflux = 1"));
        EXPECT_NE(message.find("s.toml:19: lights.b.material: "), std::string::npos) << message;
    }
    EXPECT_EQ(
        refused(glass + light("b", "material = \"glass\"\nflux = 1")),
        "s.toml:19: lights.b.material: the faces of \"glass\" shine already, as another light. Allowed: one "
        "light for each face.");
    EXPECT_EQ(refused(glass + light("b", "flux = 1")),
              "s.toml:18: lights.b.object: some of its faces are another light, \"cube (glass)\". Allowed: "
              "\"material\" or \"mesh_group\", which pick faces for each light of the object.");
    EXPECT_EQ(
        refused(light("a", "flux = 1") + light("b", "material = \"glass\"\nflux = 1")),
        "s.toml:17: lights.b.object: \"cube\" is already the emitter of the light \"a\". Allowed: one area "
        "light per object.");
}

TEST_F(SceneLampFaces, RefusesShapesWithoutFaces) {
    const std::string ball =
        "[objects.ball]\nshape = \"sphere\"\ncenter = [0, 0, 5]\nradius = 1\nmaterial = \"grey\"\n";
    EXPECT_EQ(refused(ball + "[lights.a]\ntype = \"area\"\nobject = \"ball\"\nmaterial = \"grey\"\nflux = 1"),
              "s.toml:19: lights.a.material: picks faces of a mesh, but \"ball\" is none. Allowed: an object "
              "of shape "
              "\"mesh\" or \"polygons\"; or leave this key out, and the whole object shines.");
}

}  // namespace
}  // namespace stilb::io
