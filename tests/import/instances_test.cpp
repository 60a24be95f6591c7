// Large meshes that several objects have are stored once.
#include <gtest/gtest.h>

#include <set>

#include "gltf_text.h"
#include "io/import/scene_folder.h"
#include "io/mesh/mesh_file.h"
#include "io/scene_text.h"
#include "io/text/table.h"
#include "run/run.h"
#include "support/scene_builder.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

class InstancesTest : public testing::Test {
  protected:
    const TestFolder folder;
};

/// 81,920 triangles.
Mesh ball() { return icosphere({{}, 0.3}, 6); }

std::set<const Mesh*> shared_meshes(const Scene& scene) {
    std::set<const Mesh*> meshes;
    for (const Object& object : scene.objects) {
        if (const auto* instance = std::get_if<Instance>(&object.shape)) meshes.insert(instance->mesh.get());
    }
    return meshes;
}

std::size_t instances_in(const Scene& scene) {
    return static_cast<std::size_t>(std::ranges::count_if(
        scene.objects, [](const Object& object) { return std::holds_alternative<Instance>(object.shape); }));
}

/// The same scene without instances.
SceneFile with_copies(SceneFile file) {
    for (Object& object : file.scene.objects) {
        if (const auto* instance = std::get_if<Instance>(&object.shape))
            object.shape = triangulated(*instance);
    }
    return file;
}

std::vector<run::Reading> readings_of(const SceneFile& file, std::string_view method, std::uint64_t seed) {
    RunOptions options;
    options.method = method;
    options.paths = 16384;
    options.seed = seed;
    return run::measure(file.scene, file.sensors, options).sensors.at(0).readings;
}

void expect_same_light(const SceneFile& a, const SceneFile& b, std::string_view method) {
    const auto of_a = readings_of(a, method, 1), of_b = readings_of(b, method, 2);
    ASSERT_EQ(of_a.size(), of_b.size());
    for (std::size_t i = 0; i < of_a.size(); ++i) {
        const auto &x = of_a[i].estimate, &y = of_b[i].estimate;
        const double error = std::hypot(x.upper - x.lower, y.upper - y.lower);
        EXPECT_NEAR(x.value, y.value, error) << method;
        EXPECT_LT(error, 0.05 * x.value) << method;
    }
}

const std::vector<std::string> kInstancePoints{
    "sensors.desk={type=\"illuminance\", positions=[[1, 1, 0.05], [2, 1.5, 0.05], [2.2, 1, 0.4]], normal=[0, "
    "0, 1]}"};

/// A room with a light, and three balls: the second mirrored and enlarged, the third stretched.
GltfText room_with_balls() {
    GltfText gltf;
    gltf.add_material(
        R"("name": "wall", "pbrMetallicRoughness": {"baseColorFactor": [0.6, 0.5, 0.4, 1], "metallicFactor": 0},
           "extensions": {"KHR_materials_specular": {"specularFactor": 0}})");
    Mesh room = triangulated(Box{{0, 0, -3}, {4, 2.5, 0}});
    gltf.add_node(fmt::format(R"("name": "room", "mesh": {})", gltf.add_mesh(room, 0)));
    const int mesh = gltf.add_mesh(ball(), 0);
    gltf.add_node(fmt::format(R"("name": "ball", "mesh": {}, "translation": [1, 0.5, -2])", mesh));
    gltf.add_node(fmt::format(
        R"("name": "ball", "mesh": {}, "translation": [3, 0.5, -1], "scale": [-1.5, 1.5, 1.5])", mesh));
    gltf.add_node(fmt::format(
        R"("name": "egg", "mesh": {}, "translation": [2, 1, -0.6], "rotation": [0.6, 0, 0, 0.8], "scale": [1, 2, 1])",
        mesh));
    gltf.extensions = R"("KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 100}]})";
    gltf.add_node(
        R"("name": "bulb", "translation": [1, 2, -1], "extensions": {"KHR_lights_punctual": {"light": 0}})");
    return gltf;
}

TEST_F(InstancesTest, NodesOfGltfShareAMeshAndMeasureAsCopies) {
    const SceneFile file = read_gltf(room_with_balls().text(), kInstancePoints);
    EXPECT_EQ(instances_in(file.scene), 3u);
    EXPECT_EQ(shared_meshes(file.scene).size(), 1u);
    for (const std::string_view method : {"auto", "path"}) expect_same_light(file, with_copies(file), method);
}

TEST_F(InstancesTest, AFolderHasTheMeshOnceAndReadsAsInstances) {
    const SceneFile file = read_gltf(room_with_balls().text(), kInstancePoints);
    const auto files = write_scene_folder(file, folder);
    EXPECT_EQ(files.size(), 3u);  // the scene, the room and the ball
    const SceneFile read = read_scene_file(files.front());
    EXPECT_EQ(instances_in(read.scene), 3u);
    EXPECT_EQ(shared_meshes(read.scene).size(), 1u);
    for (std::size_t i = 0; i < 4; ++i) {
        const Shape &one = file.scene.objects[i].shape, &other = read.scene.objects[i].shape;
        EXPECT_LT(length(bounds_of(one).min - bounds_of(other).min), 1e-12);
        EXPECT_LT(length(bounds_of(one).max - bounds_of(other).max), 1e-12);
    }
    expect_same_light(file, read, "auto");
}

TEST_F(InstancesTest, SmallMeshesAreCopied) {
    GltfText gltf;
    const int mesh = gltf.add_mesh(gltf_square(), -1);
    for (int i = 0; i < 3; ++i)
        gltf.add_node(fmt::format(R"("mesh": {}, "translation": [0, {}, 0])", mesh, i));
    EXPECT_EQ(instances_in(read_gltf(gltf.text()).scene), 0u);
}

TEST_F(InstancesTest, LampsHaveMeshesOfTheirOwn) {
    GltfText gltf = room_with_balls();
    gltf.materials.front().insert(1, R"("emissiveFactor": [1, 1, 1], )");
    const SceneFile file = read_gltf(gltf.text());
    EXPECT_EQ(instances_in(file.scene), 0u);
    EXPECT_EQ(file.scene.lights.size(), 5u);
}

TEST_F(InstancesTest, ObjectsOfASceneFileShareMaterialsAndParts) {
    const Mesh mesh = ball();
    std::vector<std::uint32_t> parts(mesh.triangles.size());
    for (std::size_t t = 0; t < parts.size(); ++t) parts[t] = static_cast<std::uint32_t>(t % 2);
    const std::vector<std::string> names{"glass", "wood"};
    write_file(folder / "ball.obj", to_obj(mesh, parts, names));
    std::string toml =
        "materials.a = {type = \"diffuse\", reflectance = 0.5}\n"
        "materials.b = {type = \"diffuse\", reflectance = 0.2}\n";
    for (int i = 0; i < 3; ++i)
        toml += fmt::format(
            "[objects.ball{0}]\nshape = \"mesh\"\nfile = \"ball.obj\"\ntranslate = [{0}, 0, 0]\n"
            "materials = {{glass = \"a\", wood = \"{1}\"}}\n",
            i, i == 2 ? "a" : "b");
    // A lamp of some faces takes the ball out of the instances.
    toml += "[lights.lamp]\ntype = \"area\"\nobject = \"ball1\"\nmaterial = \"glass\"\nluminance = 100\n";
    const Scene scene = read_scene_text(toml, folder).scene;
    ASSERT_EQ(scene.objects.size(), 4u);
    EXPECT_EQ(instances_in(scene), 2u);
    EXPECT_EQ(shared_meshes(scene).size(), 1u);
    EXPECT_EQ(scene.objects[3].cut_from, ObjectId{1});
    EXPECT_EQ(scene.objects[0].materials[1], MaterialId{1});
    EXPECT_EQ(scene.objects[2].materials[1], MaterialId{0});
    EXPECT_NEAR(area_m2(scene.objects[1].shape) + area_m2(scene.objects[3].shape), area_m2(Shape{mesh}),
                1e-9);
}

}  // namespace
}  // namespace stilb::io
