#include "io/scene/scene_file.h"

#include "io/scene_text.h"
#include "materials/black.h"
#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

constexpr const char* kRoom = R"(
[scene]
name = "A room"

[materials.wall]
type = "diffuse"
reflectance = [0.7, 0.6, 0.5]

[materials.floor]
type = "phong"
diffuse = 0.35
specular = 0.10
exponent = 60

[materials.mirror]
type = "mirror"
reflectance = 0.9

[materials.black]
type = "black"

[objects.room]
shape = "box"
min = [0, 0, 0]
max = [4, 3, 2.5]
material = "wall"

[objects.carpet]
shape = "rectangle"
corner = [1, 1, 0.01]
edge_u = [1, 0, 0]
edge_v = [0, 1, 0]
material = "floor"

[objects.ball]
shape = "sphere"
center = [3, 2, 1]
radius = 0.2
material = "mirror"

[objects.panel]
shape = "disk"
center = [2, 1, 2.4]
normal = [0, 0, -1]
radius = 0.5
material = "black"

[lights.panel]
type = "area"
object = "panel"
flux = 3200

[lights.bulb]
type = "point"
position = [2, 2, 2]
flux = 800

[sensors.desk]
type = "grid"
corner = [0.5, 0.5, 0.75]
edge_u = [2, 0, 0]
edge_v = [0, 1, 0]
count = [4, 2]

[sensors.task]
type = "illuminance"
position = [1, 1, 0.75]
normal = [0, 0, 1]

[run]
method = "local"
error = "1%"
time = 60
paths = 1e6
bounces = 10
patch = 0.5
seed = 7
threads = 2
)";

TEST(SceneFile, ReadsARoom) {
    const SceneFile file = read_scene_text(kRoom);
    const Scene& scene = file.scene;
    EXPECT_EQ(scene.name, "A room");
    ASSERT_EQ(scene.materials.size(), 4u);
    EXPECT_EQ(scene.materials[0].material.get_if<Diffuse>()->reflectance, (Rgb{{0.7, 0.6, 0.5}}));
    const auto& phong = *scene.materials[1].material.get_if<Phong>();
    EXPECT_EQ(phong.diffuse, Rgb::grey(0.35));
    EXPECT_EQ(phong.specular, Rgb::grey(0.10));
    EXPECT_EQ(phong.exponent, 60);
    EXPECT_EQ(scene.materials[2].material.get_if<Mirror>()->reflectance, Rgb::grey(0.9));
    EXPECT_TRUE(scene.materials[3].material.is<Black>());

    ASSERT_EQ(scene.objects.size(), 4u);
    EXPECT_EQ(std::get<Box>(scene.objects[0].shape).max, (Vec3{4, 3, 2.5}));
    EXPECT_EQ(std::get<Rectangle>(scene.objects[1].shape).edge_v, (Vec3{0, 1, 0}));
    EXPECT_EQ(std::get<Sphere>(scene.objects[2].shape).radius, 0.2);
    EXPECT_EQ(std::get<Disk>(scene.objects[3].shape).normal, (Vec3{0, 0, -1}));
    for (std::uint32_t i = 0; i < 4; ++i) {
        EXPECT_EQ(scene.objects[i].materials, std::vector<MaterialId>{MaterialId{i}})
            << scene.objects[i].name;
    }
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(std::get<AreaLight>(scene.lights[0].source).object, ObjectId{3});
    EXPECT_TRUE(file.warnings.empty()) << file.warnings[0].text;
}

TEST(SceneFile, KeepsTheOrderOfTheFile) {
    const SceneFile file = read_scene_text(kRoom);
    EXPECT_EQ(file.scene.objects[0].name, "room");
    EXPECT_EQ(file.scene.objects[1].name, "carpet");
    EXPECT_EQ(file.scene.lights[0].name, "panel");
    EXPECT_EQ(file.scene.lights[1].name, "bulb");
    EXPECT_EQ(file.sensors[0].name, "desk");
    EXPECT_EQ(file.sensors[1].name, "task");
}

TEST(SceneFile, ReadsRunOptions) {
    const RunOptions run = read_scene_text(kRoom).run;
    EXPECT_EQ(run.method, "local");
    EXPECT_EQ(run.error, 0.01);
    EXPECT_EQ(run.time_s, 60);
    EXPECT_EQ(run.paths, 1000000u);
    EXPECT_EQ(run.bounces, 10);
    EXPECT_EQ(run.patch_m, 0.5);
    EXPECT_EQ(run.seed, 7u);
    EXPECT_EQ(run.threads, 2);
}

TEST(SceneFile, LeavesRunOptionsAtTheirDefaults) {
    const RunOptions run = read_scene_text("[run]\nseed = 0").run;
    EXPECT_EQ(run.method, "auto");
    EXPECT_FALSE(run.error || run.time_s || run.paths || run.bounces || run.patch_m);
    EXPECT_EQ(run.seed, 0u);
    EXPECT_EQ(run.threads, 0);
}

TEST(SceneFile, RefusesWhatIsNotToml) {
    EXPECT_REFUSAL(
        "[run]\nseed = 1\nseed = 2",
        "s.toml:3: not valid TOML: Error while parsing key-value pair: cannot redefine existing integer "
        "'seed'");
    EXPECT_TRUE(refusal("[run\n").starts_with("s.toml:1: not valid TOML: "));
    EXPECT_TRUE(refusal("[run]\nseed = \xff").starts_with("s.toml:2: not valid TOML: "));
    EXPECT_TRUE(refusal("[objects.a]\n[objects.a]\n").starts_with("s.toml:2: not valid TOML: "));
}

TEST(SceneFile, RefusesEndlessNesting) {
    std::string key = "a";
    for (int i = 0; i < 1'000'000; ++i) key += ".a";
    EXPECT_REFUSAL("\n" + key + " = 1",
                   "s.toml:2: a key has more than 1000 parts. No key needs more than four.");
    EXPECT_TRUE(refusal("a = " + std::string(1'000'000, '[')).starts_with("s.toml:1: not valid TOML: "));
    std::string numbers = "0.1";
    for (int i = 0; i < 2000; ++i) numbers += ", 0.1";
    EXPECT_REFUSAL("[scene]\nname = [" + numbers + "]",
                   "s.toml:2: scene.name: found an array of 2001 where a text in quotation marks is needed.");
}

TEST(SceneFile, RefusesAnEmptyFile) {
    const std::string message =
        "s.toml: the scene file is empty. Needed: the sections materials, objects, lights and sensors.";
    EXPECT_REFUSAL("", message);
    EXPECT_REFUSAL("# nothing but a remark\n", message);
}

TEST(SceneFile, RefusesUnknownSections) {
    EXPECT_REFUSAL("\n[ligths.a]\ntype = \"point\"",
                   "s.toml:2: unknown key \"ligths\". Did you mean \"lights\"? Allowed: scene, defaults, "
                   "materials, objects, "
                   "lights, sensors, scenes, run.");
    EXPECT_REFUSAL("[scene]\ntitle = \"x\"", "s.toml:2: scene: unknown key \"title\". Allowed: name.");
    EXPECT_REFUSAL("run = 3", "s.toml:1: run: found the number 3 where a table is needed.");
    EXPECT_REFUSAL("[materials]\nwall = 0.5",
                   "s.toml:2: materials.wall: found the number 0.5 where a table is needed.");
    EXPECT_REFUSAL("[[objects]]\nshape = \"box\"",
                   "s.toml:1: objects: found an array of 1 where a table is needed.");
    EXPECT_REFUSAL("[scene]\nname = 1979-05-27",
                   "s.toml:2: scene.name: found a date or time where a text in quotation marks is needed.");
}

TEST(SceneFile, RefusesNamesThatCannotBeFileNames) {
    EXPECT_REFUSAL(
        "[sensors.\"../x\"]\n",
        "s.toml:1: sensors.\"../x\": \"../x\" cannot be a name (names become parts of file names). Allowed: "
        "any text without slashes and control characters.");
    EXPECT_TRUE(refusal("[lights.\"\"]\n").starts_with("s.toml:1: lights.\"\": \"\" cannot be a name"));
    EXPECT_TRUE(
        refusal("[lights.\"a\\nb\"]\n").starts_with("s.toml:1: lights.\"a\\x0ab\": \"a\\x0ab\" cannot"));
}

TEST(SceneFile, RefusesWrongRunOptions) {
    EXPECT_REFUSAL("[run]\nmethod = \"pth\"",
                   "s.toml:2: run.method: unknown method \"pth\". Did you mean \"path\"? Allowed: auto, "
                   "local, double-local, path, ray-bundle, radiosity, particles, light-paths, guided.");
    EXPECT_REFUSAL(
        "[run]\nmetod = \"auto\"",
        "s.toml:2: run: unknown key \"metod\". Did you mean \"method\"? Allowed: method, error, "
        "target, time, paths, "
        "bounces, patch, by, first_shot, window, resolution, visibility, directions, seed, threads, "
        "maintenance.");
    const std::string share = " is not allowed. Allowed: a share between 0 and 1, such as 0.01 or \"1%\".";
    EXPECT_REFUSAL("[run]\nerror = 0", "s.toml:2: run.error: 0" + share);
    EXPECT_REFUSAL("[run]\nerror = -0.1", "s.toml:2: run.error: -0.1" + share);
    EXPECT_REFUSAL("[run]\nerror = 1", "s.toml:2: run.error: 1" + share);
    EXPECT_REFUSAL("[run]\nerror = nan", "s.toml:2: run.error: nan" + share);
    EXPECT_REFUSAL("[run]\nerror = \"1 percent\"", "s.toml:2: run.error: \"1 percent\"" + share);
    EXPECT_REFUSAL("[run]\ntime = 0",
                   "s.toml:2: run.time: 0 is not allowed. Allowed: a time above 0 (from 0.001 to 1e9 s).");
    EXPECT_REFUSAL(
        "[run]\nseed = -1",
        "s.toml:2: run.seed: found the number -1. Allowed: a whole number from 0 to 9223372036854775807.");
    EXPECT_REFUSAL(
        "[run]\npaths = 0",
        "s.toml:2: run.paths: found the number 0. Allowed: a whole number from 1 to 9007199254740992.");
    EXPECT_REFUSAL("[run]\nbounces = 1.5",
                   "s.toml:2: run.bounces: found the number 1.5. Allowed: a whole number from 0 to 1000000.");
    EXPECT_REFUSAL("[run]\nthreads = \"all\"",
                   "s.toml:2: run.threads: found the text \"all\" where a whole number is needed.");
}

TEST(SceneFile, WarnsOfUnusedMaterialsAndOfDarkness) {
    const SceneFile file = read_scene_text("[materials.spare]\ntype = \"black\"");
    EXPECT_EQ(texts_of(file.warnings),
              (std::vector<std::string>{"s.toml:1: materials.spare: no object has this material.",
                                        "s.toml: no light: the scene is dark."}));
}

TEST(SceneFile, IsReadFromDisk) {
    const TestFolder folder;
    const std::filesystem::path path = folder.write("room.toml", kRoom);
    EXPECT_EQ(read_scene_file(path).scene.objects.size(), 4u);
    folder.write("room.toml", "[run]\nseed = -1");
    try {
        read_scene_file(path);
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with(path.string() + ":2: run.seed: ")) << error.what();
    }
    std::filesystem::remove(path);
    EXPECT_THROW(read_scene_file(path), InputError);
}

TEST(SceneFile, SaysWhatOtherFilesAre) {
    const TestFolder folder;
    for (const auto& [name, is, use] : {std::array{"room.OBJ", "an OBJ mesh", "an object"},
                                        {"lamp.ies", "an IES luminaire", "a light"},
                                        {"room.rad", "a Radiance scene", "Commands that take a scene"}}) {
        const auto path = folder.write(name, "words");
        try {
            read_scene_file(path);
            ADD_FAILURE() << "accepted";
        } catch (const InputError& error) {
            const std::string message = error.what();
            EXPECT_TRUE(message.starts_with(path.string() + ": not a scene but " + is + ". ")) << message;
            EXPECT_NE(message.find(use), std::string::npos) << message;
        }
    }
}

}  // namespace
}  // namespace stilb::io
