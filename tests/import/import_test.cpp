// Imported scenes measure the same as scenes in TOML, and as the folders that import writes of them.
#include <gtest/gtest.h>

#include <algorithm>

#include "gltf_text.h"
#include "import_folder.h"
#include "io/import/obj/obj_scene.h"
#include "io/import/scene_folder.h"
#include "io/scene_text.h"
#include "materials/phong.h"
#include "materials/plastic.h"

namespace stilb::io {
namespace {

using ImportTest = ImportFolderTest;

const std::vector<std::string> kPoints{
    "sensors.desk={type=\"illuminance\", positions=[[1, 1, 0.75], [2, 1.5, 0.75], [3, 2, 0.75]], normal=[0, "
    "0, 1]}"};

constexpr std::string_view kImportedRoom = R"(
[materials.wall]
type = "diffuse"
reflectance = [0.6, 0.5, 0.4]
[materials.steel]
type = "rough"
reflectance = 0.7
roughness = 0.16
[objects.room]
shape = "box"
min = [0, 0, 0]
max = [4, 3, 2.5]
material = "wall"
[objects.table]
shape = "box"
min = [1.5, 1, 0.6]
max = [2.5, 2, 0.7]
material = "steel"
[lights.bulb]
type = "point"
position = [1, 1, 2]
intensity = 100
color = [1, 0.8, 0.6]
[sensors.desk]
type = "illuminance"
positions = [[1, 1, 0.75], [2, 1.5, 0.75], [3, 2, 0.75]]
normal = [0, 0, 1]
)";

Vec3 to_gltf(const Vec3& v) { return {v.x, v.z, -v.y}; }

Mesh box_in_gltf(const Vec3& min, const Vec3& max) {
    Mesh mesh = triangulated(Box{min, max});
    for (Vec3& vertex : mesh.vertices) vertex = to_gltf(vertex);
    return mesh;
}

/// kImportedRoom as glTF; the light's intensity is luminous for white, so its colour has a luminance of 1
/// here.
GltfText room_in_gltf() {
    GltfText gltf;
    gltf.add_material(
        R"("name": "wall", "pbrMetallicRoughness": {"baseColorFactor": [0.6, 0.5, 0.4, 1], "metallicFactor": 0},
           "extensions": {"KHR_materials_specular": {"specularFactor": 0}})");
    gltf.add_material(
        R"("name": "steel", "pbrMetallicRoughness": {"baseColorFactor": [0.7, 0.7, 0.7, 1], "roughnessFactor": 0.4})");
    gltf.add_node(
        fmt::format(R"("name": "room", "mesh": {})", gltf.add_mesh(box_in_gltf({0, 0, 0}, {4, 3, 2.5}), 0)));
    gltf.add_node(fmt::format(R"("name": "table", "mesh": {}, "translation": [1.5, 0.6, -1])",
                              gltf.add_mesh(box_in_gltf({0, 0, 0}, {1, 1, 0.1}), 1)));
    const double white = Rgb{{1, 0.8, 0.6}}.luminance();
    gltf.extensions = fmt::format(
        R"("KHR_lights_punctual": {{"lights": [{{"type": "point", "intensity": {}, "color": [1, 0.8, 0.6]}}]}})",
        100 / white);
    gltf.add_node(
        R"("name": "bulb", "translation": [1, 2, -1], "extensions": {"KHR_lights_punctual": {"light": 0}})");
    return gltf;
}

TEST_F(ImportTest, GltfMeasuresAsTheSameSceneInToml) {
    expect_same_light(read_gltf(room_in_gltf().text(), kPoints), read_scene_text(std::string(kImportedRoom)));
}

TEST_F(ImportTest, AFolderMeasuresAsItsGltfFile) {
    GltfText gltf = room_in_gltf();
    // Lamps that are faces of a mesh, from both sides; a smooth ball of two triangles; a spot; the sun.
    gltf.add_material(R"("name": "lamp", "doubleSided": true, "emissiveFactor": [1, 0.9, 0.8],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 500}})");
    Mesh panel = gltf_square();
    panel.normals = {{0.1, 1, 0}, {0, 1, 0.1}, {-0.1, 1, 0}, {0, 1, 0}};
    gltf.add_node(
        fmt::format(R"("name": "panel", "mesh": {}, "translation": [2, 2.4, -1.5], "scale": [0.3, 1, 0.3])",
                    gltf.add_mesh(panel, 2)));
    gltf.extensions.insert(gltf.extensions.find("[{") + 1,
                           R"({"type": "spot", "intensity": 50, "spot": {"outerConeAngle": 0.7}},
                              {"type": "directional", "intensity": 100}, )");
    gltf.nodes[2].replace(gltf.nodes[2].find("\"light\": 0"), 10, "\"light\": 2");
    gltf.add_node(R"("name": "spot", "translation": [3, 2.4, -2], "rotation": [-0.6, 0.1, 0, 0.79],
                     "extensions": {"KHR_lights_punctual": {"light": 0}})");
    gltf.add_node(R"("name": "sun", "extensions": {"KHR_lights_punctual": {"light": 1}})");
    gltf.cameras.push_back(R"({"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}})");
    gltf.add_node(R"("name": "view", "camera": 0, "translation": [1, 2, -1])");
    std::vector<std::string> overrides = kPoints;
    overrides.emplace_back("run.maintenance=0.8");
    const SceneFile file = read_gltf(gltf.text(), overrides);
    ASSERT_EQ(file.scene.lights.size(), 5u);
    const auto files = write_scene_folder(file, folder / "room");
    const SceneFile read = read_scene_file(files.front());
    ASSERT_EQ(read.scene.objects.size(), file.scene.objects.size());
    ASSERT_EQ(read.sensors.size(), 2u);
    EXPECT_EQ(read.scene.lights[0].maintenance, 0.8);
    expect_same_readings(file, read);
}

/// 0.1 mm behind it, or a thousandth of a small lamp's diagonal.
TEST_F(ImportTest, TheBackOfATwoSidedLampIsAsNearAsTheLampIsSmall) {
    for (const double scale : {0.3, 0.01}) {
        GltfText gltf = room_in_gltf();
        gltf.add_material(R"("name": "lamp", "doubleSided": true, "emissiveFactor": [1, 1, 1],
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 500}})");
        gltf.add_node(
            fmt::format(R"("name": "panel", "mesh": {}, "translation": [2, 2.4, -1.5], "scale": [{}, 1, {}])",
                        gltf.add_mesh(gltf_square(), 2), scale, scale));
        const Scene scene = read_gltf(gltf.text(), kPoints).scene;
        const auto bounds = [&](const std::string& name) {
            return bounds_of(std::ranges::find(scene.objects, name, &Object::name)->shape);
        };
        const Bounds front = bounds("panel"), back = bounds("panel (back)");
        const double diagonal_m = length(front.max - front.min);
        EXPECT_EQ(1e-3 * diagonal_m < 1e-4, scale < 0.1);
        EXPECT_NEAR(std::abs(back.min.z - front.min.z), std::min(1e-4, 1e-3 * diagonal_m), 1e-6) << scale;
    }
}

/// The faces of a mesh in the plane y = height of glTF, and the others.
struct Parts {
    Mesh level, rest;
};
Parts parts_of(const Mesh& mesh, double height) {
    Parts parts{mesh, mesh};
    parts.level.triangles.clear(), parts.rest.triangles.clear();
    for (const Triangle& t : mesh.triangles) {
        const auto is_level = [&](std::uint32_t v) { return mesh.vertices[v].y == height; };
        (std::ranges::all_of(t, is_level) ? parts.level : parts.rest).triangles.push_back(t);
    }
    return parts;
}

TEST_F(ImportTest, CeilingsShineIntoTheirRooms) {
    // The fronts of the room's faces are outside, as modellers leave them; so the material has two sides.
    GltfText gltf = room_in_gltf();
    gltf.add_material(R"("name": "lamp", "doubleSided": true, "emissiveFactor": [1, 1, 1],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 500}})");
    const Parts room = parts_of(box_in_gltf({0, 0, 0}, {4, 3, 2.5}), 2.5);
    gltf.nodes[0] = fmt::format(R"({{"name": "room", "mesh": {}}})",
                                gltf.join_meshes(gltf.add_mesh(room.rest, 0), gltf.add_mesh(room.level, 2)));
    gltf.nodes.pop_back();
    const SceneFile file = read_gltf(gltf.text());
    ASSERT_EQ(file.scene.lights.size(), 1u);
    ASSERT_EQ(file.scene.objects.size(), 3u);  // no back
    const Mesh& ceiling = std::get<Mesh>(file.scene.objects[2].shape);
    const auto& [a, b, c] = ceiling.triangles[0];
    EXPECT_LT(cross(ceiling.vertices[b] - ceiling.vertices[a], ceiling.vertices[c] - ceiling.vertices[a]).z,
              0);
}

TEST_F(ImportTest, LampsInAMeshStayFacesOfIt) {
    GltfText gltf = room_in_gltf();
    gltf.add_material(R"("name": "lamp", "emissiveFactor": [1, 1, 1],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 500}})");
    const Parts box = parts_of(box_in_gltf({0, 0, 0}, {1, 1, 0.1}), 0);
    gltf.add_node(fmt::format(R"("name": "luminaire", "mesh": {}, "translation": [1.5, 2.3, -1])",
                              gltf.join_meshes(gltf.add_mesh(box.rest, 1), gltf.add_mesh(box.level, 2))));
    const SceneFile file = read_gltf(gltf.text(), kPoints);
    ASSERT_EQ(file.scene.objects.size(), 4u);
    EXPECT_EQ(file.scene.objects[3].name, "luminaire (lamp)");
    EXPECT_EQ(file.scene.objects[3].cut_from, ObjectId{2});
    const SceneFile read = read_scene_file(write_scene_folder(file, folder / "room").front());
    ASSERT_EQ(read.scene.objects.size(), 4u);
    EXPECT_EQ(read.scene.objects[3].cut_from, ObjectId{2});
    expect_same_readings(file, read);
}

TEST_F(ImportTest, RefusesToReplaceAScene) {
    write("scene.toml", "[scene]\nname = \"mine\"\n");
    const SceneFile file = read_gltf(room_in_gltf().text());
    try {
        write_scene_folder(file, folder);
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("was not written by stilb import"), std::string::npos);
    }
    // Its own scenes it replaces.
    write_scene_folder(file, folder / "room");
    write_scene_folder(file, folder / "room");
}

TEST_F(ImportTest, ObjectsInTomlTakeMeshesFromGltf) {
    GltfText gltf = room_in_gltf();
    write("room.gltf", gltf.text());
    std::string toml(kImportedRoom);
    const std::size_t box = toml.find("shape = \"box\""), table = toml.find("[objects.table]");
    toml.replace(
        box, table - box,
        "shape = \"mesh\"\nfile = \"room.gltf\"\nmaterials = { room = \"wall\", steel = \"steel\" }\n");
    toml.erase(toml.find("[objects.table]"), toml.find("[lights.bulb]") - toml.find("[objects.table]"));
    expect_same_light(read_scene_text(toml, folder), read_scene_text(std::string(kImportedRoom)));
}

// OBJ

/// The room in centimetres and y upwards, its faces as CAD programs write them.
std::string room_in_obj() {
    std::string text = "mtllib room.mtl\n";
    std::size_t first = 1;
    const auto add = [&](const std::string& name, const std::string& material, const Vec3& min,
                         const Vec3& max) {
        const Mesh box = box_in_gltf(min, max);
        text += fmt::format("o {}\nusemtl {}\n", name, material);
        for (const Vec3& v : box.vertices)
            text += fmt::format("v {} {} {}\n", 100 * v.x, 100 * v.y, 100 * v.z);
        for (const auto& [a, b, c] : box.triangles)
            text += fmt::format("f {} {} {}\n", first + a, first + b, first + c);
        first += box.vertices.size();
    };
    add("room", "wall", {0, 0, 0}, {4, 3, 2.5});
    add("table", "wood", {1.5, 1, 0.6}, {2.5, 2, 0.7});
    add("lamp", "light", {1.9, 1.4, 2.3}, {2.1, 1.6, 2.4});
    return text;
}

constexpr std::string_view kMtl =
    "newmtl wall\nKd 0.6 0.5 0.4\nKs 0.5 0.5 0.5\nillum 1\n"
    "newmtl wood\nKd 0.4 0.3 0.2\nKs 0.1 0.1 0.1\nNs 60\nillum 2\n"
    "newmtl light\nKd 0 0 0\nKe 1000 800 600\n";

TEST_F(ImportTest, ObjWithMtlMeasuresAsTheSameSceneInToml) {
    write("room.mtl", std::string(kMtl));
    const SceneFile file = read_obj_scene(write("room.obj", room_in_obj()), kPoints);
    std::string toml(kImportedRoom.substr(0, kImportedRoom.find("[lights.bulb]")));
    toml += R"(
[materials.black]
type = "black"
[objects.lamp]
shape = "box"
min = [1.9, 1.4, 2.3]
max = [2.1, 1.6, 2.4]
material = "black"
[lights.lamp]
type = "area"
object = "lamp"
luminance = 828.08
color = [1000, 800, 600]
)" + std::string(kImportedRoom.substr(kImportedRoom.find("[sensors.desk]")));
    toml.replace(toml.find("type = \"rough\"\nreflectance = 0.7\nroughness = 0.16"), 48,
                 "type = \"phong\"\ndiffuse = [0.4, 0.3, 0.2]\nspecular = 0.1\nexponent = 60");
    EXPECT_NEAR(area_m2(file.scene.objects.at(0).shape), 59, 1e-6);
    EXPECT_EQ(file.scene.objects[1].name, "table");
    expect_same_light(file, read_scene_text(toml));
    const SceneFile read = read_scene_file(write_scene_folder(file, folder / "out").front());
    expect_same_readings(file, read);
}

TEST_F(ImportTest, ObjSaysWhichUnitItChose) {
    write("room.mtl", std::string(kMtl));
    const SceneFile file = read_obj_scene(write("room.obj", room_in_obj()));
    std::string warnings;
    for (const std::string& warning : texts_of(file.warnings)) warnings += warning + "\n";
    EXPECT_NE(
        warnings.find(
            "It is taken as 4 x 3 m large and 2.5 m high: scale = 0.01 (centimetres), because the model is "
            "then as high as one storey (2.2 to 4 m); up = \"y\", because the model begins at y "
            "= 0, "
            "as things that stand on the ground do. If that is wrong: --set import.scale=METRES, --set "
            "import.up=z"),
        std::string::npos)
        << warnings;
    const SceneFile given =
        read_obj_scene(folder / "room.obj", std::vector<std::string>{"import.scale=0.02", "import.up=z"});
    EXPECT_NEAR(area_m2(given.scene.objects.at(0).shape), 59 * 4, 1e-6);
}

/// A box that is given with z upwards, in a file with y upwards.
std::string box_in_obj(const std::string& name, const std::string& material, const Vec3& min,
                       const Vec3& max) {
    const Mesh box = box_in_gltf(min, max);
    std::string text = fmt::format("o {}\nusemtl {}\n", name, material);
    for (const Vec3& v : box.vertices) text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
    const auto count = static_cast<int>(box.vertices.size());
    for (const auto& [a, b, c] : box.triangles)
        text += fmt::format("f {} {} {}\n", int(a) - count, int(b) - count, int(c) - count);
    return text;
}

/// Furniture has large fronts, which look like floors of a scene with z upwards.
TEST_F(ImportTest, ObjThatStandsOnTheGroundTellsItsUpwardAxis) {
    const std::string cupboards = box_in_obj("shelf", "a", {-165, 1.3, 0}, {-55, 41, 199.5}) +
                                  box_in_obj("sideboard", "a", {55, 1.3, 0}, {165, 37, 121}) +
                                  box_in_obj("board", "a", {-55, 1.1, 150}, {94, 33, 153});
    const SceneFile file = read_obj_scene(write("cupboards.obj", cupboards));
    const Bounds bounds = bounds_of(file.scene);
    EXPECT_NEAR(bounds.max.z - bounds.min.z, 1.995, 1e-9);  // centimetres, not inches
    EXPECT_NEAR(bounds.max.x - bounds.min.x, 3.3, 1e-9);
}

/// A stool of 98 cm, which is no room of 98 inches.
TEST_F(ImportTest, ObjThatIsNarrowIsFurniture) {
    const SceneFile file =
        read_obj_scene(write("stool.obj", box_in_obj("stool", "a", {0, 0, 0}, {42, 42, 98})));
    EXPECT_NEAR(bounds_of(file.scene).max.z - bounds_of(file.scene).min.z, 0.98, 1e-9);
    const SceneFile room =
        read_obj_scene(write("room.obj", box_in_obj("room", "a", {0, 0, 0}, {142, 130, 98})));
    EXPECT_NEAR(bounds_of(room.scene).max.z - bounds_of(room.scene).min.z, 98 * 0.0254, 1e-9);
}

TEST_F(ImportTest, ObjLongerThanTwoHundredMetresHasAnotherUnit) {
    const SceneFile file =
        read_obj_scene(write("hall.obj", box_in_obj("hall", "a", {0, 0, 0}, {800, 600, 300})));
    const Bounds bounds = bounds_of(file.scene);
    EXPECT_NEAR(bounds.max.x - bounds.min.x, 8, 1e-9);
}

/// Programs that write the same Ks for all materials do not mean a share of light, of dark ones neither.
TEST_F(ImportTest, ObjWithOneKsForAllMaterialsHasNoBlackMirrors) {
    write("a.mtl",
          "newmtl screen\nKd .06 .06 .06\nKs .5 .5 .5\nNs 96\nillum 2\nNi 1.5\n"
          "newmtl wood\nKd .6 .5 .4\nKs .5 .5 .5\nNs 20\nillum 2\n"
          "newmtl chrome\nKd .06 .06 .06\nKs .7 .7 .7\nNs 96\nillum 2\n");
    const SceneFile file =
        read_obj_scene(write("a.obj", "mtllib a.mtl\n" + box_in_obj("a", "screen", {0, 0, 0}, {1, 1, 1}) +
                                          box_in_obj("b", "wood", {2, 0, 0}, {3, 1, 1}) +
                                          box_in_obj("c", "chrome", {4, 0, 0}, {5, 1, 1})));
    const auto& materials = file.scene.materials;
    ASSERT_EQ(materials.size(), 3u);
    EXPECT_TRUE(materials[0].material.is<Plastic>());
    EXPECT_TRUE(materials[1].material.is<Plastic>());
    EXPECT_TRUE(materials[2].material.is<Phong>());
}

}  // namespace
}  // namespace stilb::io
