// The reader of glTF: nodes, meshes and cameras, and files that are wrong.
#include "io/import/gltf/gltf_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gltf_text.h"

namespace stilb::io {
namespace {

const Mesh& mesh_of(const SceneFile& file, std::size_t object = 0) {
    return std::get<Mesh>(file.scene.objects.at(object).shape);
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-6) {
    EXPECT_LE(length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

Vec3 front_of(const Mesh& mesh) {
    const auto& [a, b, c] = mesh.triangles.front();
    return normalized(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
}

std::string joined_warnings(const SceneFile& file) {
    std::string text;
    for (const std::string& warning : texts_of(file.warnings)) text += warning + "\n";
    return text;
}

bool contains(const std::string& text, std::string_view part) { return text.find(part) != text.npos; }

TEST(GltfScene, TurnsYUpToZUp) {
    GltfText gltf;
    gltf.add_node(fmt::format(R"("name": "floor", "mesh": {}, "translation": [1, 2, 3])",
                              gltf.add_mesh(gltf_square(), -1)));
    const SceneFile file = read_gltf(gltf.text());
    ASSERT_EQ(file.scene.objects.size(), 1u);
    EXPECT_EQ(file.scene.objects[0].name, "floor");
    expect_near(mesh_of(file).vertices[0], {0, -2, 2});
    expect_near(front_of(mesh_of(file)), {0, 0, 1});
    EXPECT_NEAR(area_m2(file.scene.objects[0].shape), 4, 1e-6);
}

TEST(GltfScene, ScalesAndTurnsAsItIsTold) {
    GltfText gltf;
    gltf.add_node(fmt::format(R"("mesh": {}, "translation": [1, 2, 3])", gltf.add_mesh(gltf_square(), -1)));
    const SceneFile file = read_gltf(gltf.text(), {"import.scale=0.5", "import.up=z"});
    expect_near(mesh_of(file).vertices[0], {0, 1, 1});
}

TEST(GltfScene, ComposesTransformsOfParents) {
    GltfText gltf;
    const double s = std::numbers::sqrt2 / 2;
    const int mesh = gltf.add_mesh(gltf_square(), -1);
    // A quarter turn about y of glTF, which is z here; then a translation; the child is scaled.
    gltf.add_node(
        fmt::format(R"("children": [1, 2], "rotation": [0, {0}, 0, {0}], "translation": [10, 0, 0])", s));
    gltf.add_node(fmt::format(R"("mesh": {}, "scale": [2, 1, 3], "translation": [1, 0, 0])", mesh));
    // The same as a matrix, column by column.
    gltf.add_node(
        fmt::format(R"("mesh": {}, "matrix": [2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 3, 0, 1, 0, 0, 1])", mesh));
    const SceneFile file = read_gltf(gltf.text());
    ASSERT_EQ(file.scene.objects.size(), 2u);
    // (-1, 0, -1) -> (-1, 0, -3) -> turned: x' = z, z' = -x -> (-3, 0, 1) -> (7, 0, 1) -> z up: (7, -1, 0)
    for (std::size_t i = 0; i < 2; ++i) expect_near(mesh_of(file, i).vertices[0], {7, -1, 0});
    EXPECT_NEAR(area_m2(file.scene.objects[0].shape), 24, 1e-5);
}

TEST(GltfScene, KeepsFrontsUnderMirroredTransforms) {
    GltfText gltf;
    gltf.add_node(fmt::format(R"("mesh": {}, "scale": [-1, 1, 1])", gltf.add_mesh(gltf_square(), -1)));
    expect_near(front_of(mesh_of(read_gltf(gltf.text()))), {0, 0, 1});
}

TEST(GltfScene, ReadsNodesOfItsSceneOnly) {
    GltfText gltf;
    const int mesh = gltf.add_mesh(gltf_square(), -1);
    gltf.add_node(fmt::format(R"("name": "here", "mesh": {})", mesh));
    gltf.add_node(fmt::format(R"("name": "elsewhere", "mesh": {})", mesh));
    gltf.scene_nodes = "0";
    const SceneFile file = read_gltf(gltf.text());
    ASSERT_EQ(file.scene.objects.size(), 1u);
    EXPECT_EQ(file.scene.objects[0].name, "here");
}

TEST(GltfScene, MakesNamesDifferentAndFitForFiles) {
    GltfText gltf;
    const int mesh = gltf.add_mesh(gltf_square(), -1);
    for (const char* name : {"a/b", "a/b", ""})
        gltf.add_node(fmt::format(R"("name": "{}", "mesh": {})", name, mesh));
    const SceneFile file = read_gltf(gltf.text());
    EXPECT_EQ(file.scene.objects[0].name, "a_b");
    EXPECT_EQ(file.scene.objects[1].name, "a_b_2");
    EXPECT_EQ(file.scene.objects[2].name, "object");
}

TEST(GltfScene, ReadsStripsAndFans) {
    for (const int mode : {5, 6}) {
        GltfText gltf;
        const std::vector<Vec3> strip{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 0, 1}};
        const std::vector<Vec3> fan{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}};
        const int positions = gltf.add_vectors(mode == 5 ? strip : fan);
        gltf.meshes.push_back(fmt::format(
            R"({{"primitives": [{{"attributes": {{"POSITION": {}}}, "mode": {}}}]}})", positions, mode));
        gltf.add_node(R"("mesh": 0)");
        const SceneFile file = read_gltf(gltf.text());
        EXPECT_NEAR(area_m2(file.scene.objects[0].shape), 1, 1e-6);
        const Mesh& mesh = mesh_of(file);
        for (const auto& [a, b, c] : mesh.triangles) {
            const Vec3 up = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
            expect_near(normalized(up), {0, 0, 1});
        }
    }
}

TEST(GltfScene, LeavesOutLinesAndSaysSo) {
    GltfText gltf;
    gltf.add_node(fmt::format(R"("mesh": {})", gltf.add_mesh(gltf_square(), -1)));
    gltf.meshes[0].insert(gltf.meshes[0].find("\"indices\""), "\"mode\": 1, ");
    gltf.add_node(fmt::format(R"("mesh": {})", gltf.add_mesh(gltf_square(), -1)));
    const SceneFile file = read_gltf(gltf.text());
    EXPECT_EQ(file.scene.objects.size(), 1u);
    EXPECT_TRUE(contains(joined_warnings(file), "points and lines have no surface")) << joined_warnings(file);
}

TEST(GltfScene, ReadsQuantizedPositions) {
    GltfText gltf;
    // KHR_mesh_quantization: normalized shorts, with the scale in the node.
    const std::vector<std::int16_t> corners{-32767, 0, -32767, 0, -32767, 0, 32767,  0,
                                            32767,  0, 32767,  0, 32767,  0, -32767, 0};
    const int view = gltf.add_view(corners.data(), corners.size() * 2);
    gltf.views.back().insert(gltf.views.back().size() - 1, ", \"byteStride\": 8");
    gltf.accessors.push_back(fmt::format(
        R"({{"bufferView": {}, "componentType": 5122, "normalized": true, "count": 4, "type": "VEC3"}})",
        view));
    const std::vector<std::uint8_t> indices{0, 1, 2, 0, 2, 3};
    gltf.add_accessor(indices, 1, 5121);
    gltf.meshes.push_back(R"({"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]})");
    gltf.add_node(R"("mesh": 0, "scale": [2, 2, 2])");
    const SceneFile file = read_gltf(gltf.text());
    EXPECT_NEAR(area_m2(file.scene.objects[0].shape), 16, 1e-9);
    expect_near(mesh_of(file).vertices[0], {-2, 2, 0}, 1e-12);
}

TEST(GltfScene, ReadsSparseAccessors) {
    GltfText gltf;
    const int mesh = gltf.add_mesh(gltf_square(), -1);
    const std::vector<std::uint16_t> index{2};
    const std::vector<float> value{3, 0, 3};
    const int indices = gltf.add_view(index.data(), 2), values = gltf.add_view(value.data(), 12);
    gltf.accessors[0].insert(
        gltf.accessors[0].size() - 1,
        fmt::format(R"(, "sparse": {{"count": 1, "indices": {{"bufferView": {}, "componentType":
        5123}}, "values": {{"bufferView": {}}}}})",
                    indices, values));
    gltf.add_node(fmt::format(R"("mesh": {})", mesh));
    expect_near(mesh_of(read_gltf(gltf.text())).vertices[2], {3, -3, 0});
}

TEST(GltfScene, KeepsNormalsOfSmoothMeshesOnly) {
    Mesh square = gltf_square();
    square.normals.assign(4, {0, 1, 0});
    GltfText flat;
    flat.add_node(fmt::format(R"("mesh": {})", flat.add_mesh(square, -1)));
    EXPECT_TRUE(mesh_of(read_gltf(flat.text())).normals.empty());
    square.normals[0] = normalized(Vec3{0.2, 1, 0});
    GltfText smooth;
    smooth.add_node(fmt::format(R"("mesh": {}, "scale": [1, 2, 1])", smooth.add_mesh(square, -1)));
    const Mesh mesh = mesh_of(read_gltf(smooth.text()));
    ASSERT_EQ(mesh.normals.size(), 4u);
    expect_near(mesh.normals[0], normalized(Vec3{0.4, 0, 1}));
}

TEST(GltfScene, MakesCamerasOfItsCameras) {
    GltfText gltf;
    gltf.add_node(fmt::format(R"("mesh": {})", gltf.add_mesh(gltf_square(), -1)));
    gltf.cameras.push_back(
        R"({"type": "perspective", "perspective": {"yfov": 0.5, "aspectRatio": 2, "znear": 0.1}})");
    gltf.add_node(R"("name": "view", "camera": 0, "translation": [1, 2, 3])");
    const SceneFile file = read_gltf(gltf.text());
    ASSERT_EQ(file.sensors.size(), 1u);
    const Camera& camera = *file.sensors[0].camera();
    expect_near(camera.position, {1, -3, 2});
    expect_near(normalized(camera.target - camera.position), {0, 1, 0});  // -z of glTF
    expect_near(camera.up, {0, 0, 1});
    EXPECT_NEAR(camera.fov_deg, 2 * std::atan(2 * std::tan(0.25)) * 180 / kPi, 1e-9);
    EXPECT_EQ(camera.resolution, (std::array{1280, 640}));
}

TEST(GltfScene, TakesSensorsAndOptionsBesideTheFile) {
    GltfText gltf;
    gltf.add_node(fmt::format(R"("mesh": {})", gltf.add_mesh(gltf_square(), -1)));
    const SceneFile file =
        read_gltf(gltf.text(),
                  {"sensors.p={type=\"illuminance\", position=[0, 0, 1], normal=[0, 0, 1]}", "run.seed=7"});
    ASSERT_EQ(file.sensors.size(), 1u);
    EXPECT_EQ(file.sensors[0].name, "p");
    EXPECT_EQ(file.run.seed, 7u);
    EXPECT_TRUE(contains(joined_warnings(file), "no light: the scene is dark")) << joined_warnings(file);
    try {
        read_gltf(gltf.text(), {"materials.wall.reflectance=0.5"});
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_TRUE(contains(error.what(), "stilb import")) << error.what();
    }
}

GltfText square_scene() {
    GltfText gltf;
    gltf.add_node(fmt::format(R"("mesh": {})", gltf.add_mesh(gltf_square(), -1)));
    return gltf;
}

/// What a surface has beside its shape does not matter where it is wrong.
TEST(GltfScene, NormalsThatAreNoNumbersCountAsMissing) {
    Mesh square = gltf_square();
    square.normals.assign(4, normalized(Vec3{0.2, 1, 0}));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double wrong : {nan, std::numeric_limits<double>::infinity(), 0.0}) {
        square.normals[3] = {wrong, wrong, wrong};
        GltfText gltf;
        gltf.add_node(fmt::format(R"("mesh": {})", gltf.add_mesh(square, -1)));
        const Mesh mesh = mesh_of(read_gltf(gltf.text()));
        ASSERT_EQ(mesh.normals.size(), 4u);
        EXPECT_EQ(mesh.normals[3], Vec3{});
        expect_near(mesh.normals[0], normalized(Vec3{0.2, 0, 1}));
    }
}

TEST(GltfScene, NormalsThatCannotBeReadAreLeftOut) {
    GltfText gltf;
    Mesh square = gltf_square();
    square.normals.assign(3, {0, 1, 0});  // for four vertices
    gltf.add_node(fmt::format(R"("mesh": {})", gltf.add_mesh(square, -1)));
    const SceneFile file = read_gltf(gltf.text());
    EXPECT_TRUE(mesh_of(file).normals.empty());
    EXPECT_TRUE(contains(joined_warnings(file), "its NORMAL is left out (it has 3 elements for 4 vertices)."))
        << joined_warnings(file);
}

TEST(GltfScene, NormalsThatLeanAwayAreLeftOut) {
    for (const double angle_deg : {44.0, 46.0}) {
        Mesh square = gltf_square();
        const double angle = angle_deg * kPi / 180;
        square.normals.assign(4, {std::sin(angle), std::cos(angle), 0});
        GltfText gltf;
        gltf.add_node(fmt::format(R"("mesh": {})", gltf.add_mesh(square, -1)));
        const SceneFile file = read_gltf(gltf.text());
        EXPECT_EQ(mesh_of(file).normals.empty(), angle_deg > 45);
        EXPECT_EQ(contains(joined_warnings(file), "normals of some triangles lean"), angle_deg > 45);
    }
}

// EXT_mesh_gpu_instancing

/// The square of square_scene(), repeated. `attributes`: of the extension.
GltfText repeated_square(const std::string& attributes, GltfText gltf) {
    gltf.nodes[0] = fmt::format(
        R"({{"mesh": 0, "name": "tile", "translation": [0, 1, 0], "extensions":
            {{"EXT_mesh_gpu_instancing": {{"attributes": {{{}}}}}}}}})",
        attributes);
    return gltf;
}

TEST(GltfScene, RepeatsMeshesAsTheirExtensionSays) {
    GltfText gltf = square_scene();
    const int places = gltf.add_vectors({{0, 0, 0}, {5, 0, 0}, {0, 0, 7}});
    const int sizes = gltf.add_vectors({{1, 1, 1}, {2, 1, 1}, {1, 1, 1}});
    const float half = std::sqrt(0.5f);  // the last one by 90 degrees about x
    const int turns =
        gltf.add_accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, half, 0, 0, half}, 4, 5126);
    const SceneFile file = read_gltf(
        repeated_square(
            fmt::format(R"("TRANSLATION": {}, "SCALE": {}, "ROTATION": {})", places, sizes, turns), gltf)
            .text());
    ASSERT_EQ(file.scene.objects.size(), 3u);
    EXPECT_EQ(file.scene.objects[0].name, "tile");
    EXPECT_EQ(file.scene.objects[2].name, "tile_3");
    expect_near(mesh_of(file, 0).vertices[0], {-1, 1, 1});
    expect_near(mesh_of(file, 1).vertices[0], {5 - 2, 1, 1});
    // Turned: its front, y of glTF, points along z of glTF, which is -y here.
    expect_near(front_of(mesh_of(file, 2)), {0, -1, 0});
    expect_near(mesh_of(file, 2).vertices[0], {-1, -7, 1 + 1}, 1e-6);
}

TEST(GltfScene, RepeatsNeitherLightsNorCameras) {
    GltfText gltf = square_scene();
    const int places = gltf.add_vectors({{0, 0, 0}, {5, 0, 0}});
    gltf.cameras.push_back(
        R"({"type": "perspective", "perspective": {"yfov": 0.5, "aspectRatio": 2, "znear": 0.1}})");
    gltf = repeated_square(fmt::format(R"("TRANSLATION": {})", places), gltf);
    gltf.nodes[0].insert(1, R"("camera": 0, )");
    const SceneFile file = read_gltf(gltf.text());
    EXPECT_EQ(file.scene.objects.size(), 2u);
    EXPECT_EQ(file.sensors.size(), 1u);
}

TEST(GltfScene, RefusesWrongRepetitions) {
    GltfText gltf = square_scene();
    const int two = gltf.add_vectors({{0, 0, 0}, {5, 0, 0}}),
              three = gltf.add_vectors({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}});
    EXPECT_EQ(
        gltf_refusal(
            repeated_square(fmt::format(R"("TRANSLATION": {}, "SCALE": {})", two, three), gltf).text()),
        "s.gltf: nodes[0].extensions.EXT_mesh_gpu_instancing.SCALE: it has 3 elements, another attribute 2.");
    const int far = gltf.add_vectors({{2e9, 0, 0}});
    EXPECT_EQ(
        gltf_refusal(repeated_square(fmt::format(R"("TRANSLATION": {})", far), gltf).text()),
        "s.gltf: nodes[0].extensions.EXT_mesh_gpu_instancing.TRANSLATION: an element has a number that is "
        "not from -1e9 to 1e9.");
}

// Wrong files

TEST(GltfScene, ReadsDataWhateverTheParametersOfItsUri) {
    const std::string text = square_scene().text();
    const auto with_header = [&](const std::string& header) {
        const std::size_t at = text.find("data:application"), comma = text.find(',', at);
        return text.substr(0, at) + header + text.substr(comma);
    };
    for (const std::string header :
         {"data:application/octet-stream;charset=utf-8;base64", "data:;base64",
          "data:application/x-my-own;a=b;base64", "data:application/gltf-buffer;base64"})
        EXPECT_EQ(read_gltf(with_header(header)).scene.objects.size(), 1u) << header;
    const std::string refusal = gltf_refusal(with_header("data:application/octet-stream"));
    EXPECT_LT(refusal.size(), 300u) << "no message has the data in it: " << refusal;
}

TEST(GltfScene, NamesVersion1) {
    const std::string message =
        "s.gltf: this is glTF 1.0, which differs from glTF 2.0, the version that is read. Export the scene "
        "as "
        "glTF 2.0.";
    EXPECT_EQ(gltf_refusal(R"({"asset": {"version": "1.0"}, "scenes": {"s": {"nodes": []}}})"), message);
    EXPECT_EQ(
        gltf_refusal(R"({"asset": {"version": "1.1"}, "buffers": {"b": {"byteLength": 4, "uri": "b.bin"}}})"),
        message);
    EXPECT_EQ(gltf_refusal(R"({"meshes" : {"m": {"primitives": []}}})"), message);
    EXPECT_NE(gltf_refusal(R"({"meshes": []})"), message);
    std::string binary = "glTF";
    binary += std::string("\1\0\0\0\x14\0\0\0\0\0\0\0\0\0\0\0", 16);
    EXPECT_EQ(gltf_refusal(binary), message);
}

TEST(GltfScene, RefusesWrongReferences) {
    GltfText gltf = square_scene();
    gltf.nodes[0] = R"({"mesh": 3})";
    EXPECT_EQ(gltf_refusal(gltf.text()), "s.gltf: nodes[0]: it refers to meshes[3], which does not exist.");

    gltf = square_scene();
    gltf.accessors[0].replace(gltf.accessors[0].find("\"count\": 4"), 10, "\"count\": 5");
    EXPECT_EQ(
        gltf_refusal(gltf.text()),
        "s.gltf: accessors[0] (meshes[0].primitives[0].POSITION): its 5 elements of 12 bytes do not fit into "
        "its bufferView of 48 bytes.");

    gltf = square_scene();
    gltf.views[0].replace(gltf.views[0].find("\"byteOffset\": 0"), 15, "\"byteOffset\": 99");
    EXPECT_EQ(gltf_refusal(gltf.text()),
              "s.gltf: bufferViews[0]: it has 48 bytes from byte 99 on, but its buffer has 72 bytes.");
}

TEST(GltfScene, RefusesIndicesBeyondTheVertices) {
    GltfText gltf;
    Mesh square = gltf_square();
    square.triangles[1][2] = 4;
    gltf.add_node(fmt::format(R"("mesh": {})", gltf.add_mesh(square, -1)));
    EXPECT_EQ(
        gltf_refusal(gltf.text()),
        "s.gltf: accessors[1] (meshes[0].primitives[0].indices): element 5 is 4, but there are 4 vertices.");
}

TEST(GltfScene, RefusesNumbersThatAreNotFinite) {
    GltfText gltf;
    Mesh square = gltf_square();
    square.vertices[2].y = std::numeric_limits<double>::quiet_NaN();
    gltf.add_node(fmt::format(R"("mesh": {})", gltf.add_mesh(square, -1)));
    EXPECT_EQ(gltf_refusal(gltf.text()),
              "s.gltf: accessors[0] (meshes[0].primitives[0].POSITION): element 2 is not a finite number.");
}

TEST(GltfScene, RefusesCyclesOfNodes) {
    GltfText gltf = square_scene();
    gltf.add_node(R"("children": [2])");
    gltf.add_node(R"("children": [1])");
    gltf.scene_nodes = "0, 1";
    EXPECT_EQ(
        gltf_refusal(gltf.text()),
        "s.gltf: nodes[1]: it is its own descendant, or a child of two nodes. Allowed: trees of nodes.");
}

TEST(GltfScene, RefusesMissingAndForeignFiles) {
    GltfText gltf = square_scene();
    std::string text = gltf.text();
    const auto replace_uri = [&](const std::string& uri) {
        const std::size_t at = text.find("data:application");
        return text.substr(0, at) + uri + text.substr(text.find('"', at));
    };
    EXPECT_TRUE(contains(gltf_refusal(replace_uri("missing.bin")), "File not found : missing.bin"))
        << gltf_refusal(replace_uri("missing.bin"));
    EXPECT_TRUE(contains(gltf_refusal(replace_uri("../secret.bin")), "lies outside of the scene's folder"))
        << gltf_refusal(replace_uri("../secret.bin"));
    // In another folder than that of the process, too, in which the parser looks as well.
    const std::string elsewhere = gltf_refusal(replace_uri("./missing.bin"), "no-such-folder/s.gltf");
    EXPECT_TRUE(contains(elsewhere, "File not found : ./missing.bin")) << elsewhere;
    const std::string outside = gltf_refusal(replace_uri("../secret.bin"), "no-such-folder/s.gltf");
    EXPECT_TRUE(contains(outside, "lies outside of the scene's folder")) << outside;
    // Absolute paths are taken below the scene's folder.
    EXPECT_TRUE(contains(gltf_refusal(replace_uri("/etc/hostname")), "File not found : /etc/hostname"))
        << gltf_refusal(replace_uri("/etc/hostname"));
}

TEST(GltfScene, RefusesWhatIsNoGltf) {
    EXPECT_TRUE(gltf_refusal("{\"asset\": ").starts_with("s.gltf: no glTF 2.0 that can be read: "))
        << gltf_refusal("{\"asset\": ");
    EXPECT_TRUE(gltf_refusal("glTF but no more").starts_with("s.gltf: no glTF 2.0 that can be read: "));
    EXPECT_EQ(gltf_refusal(R"({"asset": {"version": "2.0"}})"),
              "s.gltf: the scene has no surface: there is nothing to light.");
}

TEST(GltfScene, RefusesDeepNesting) {
    const std::string open(100'000, '['), close(100'000, ']');
    EXPECT_EQ(gltf_refusal(R"({"asset": {"version": "2.0"}, "extras": )" + open + close + "}"),
              "s.gltf: its JSON is nested more than 256 levels deep.");
}

TEST(GltfScene, RefusesRequiredExtensionsThatItCannotRead) {
    std::string text = square_scene().text();
    text.insert(1, R"("extensionsRequired": ["KHR_draco_mesh_compression"], )");
    EXPECT_TRUE(contains(gltf_refusal(text), "it needs the extension \"KHR_draco_mesh_compression\""))
        << gltf_refusal(text);
    // As exporters write it: the accessors have no buffer of their own.
    for (std::size_t at = text.find("\"bufferView\": "); at != text.npos; at = text.find("\"bufferView\": "))
        text.erase(at, text.find(',', at) + 2 - at);
    EXPECT_TRUE(contains(gltf_refusal(text), "it needs the extension \"KHR_draco_mesh_compression\""))
        << gltf_refusal(text);
}

}  // namespace
}  // namespace stilb::io
