// The library as other programs see it: public headers only.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>

#include "stilb/stilb.h"
#include "support/test_folder.h"

namespace {

constexpr std::string_view kRoom = R"(
scene.name = "room"
[materials]
wall = { type = "diffuse", reflectance = 0.6 }
floor = { type = "phong", diffuse = [0.2, 0.3, 0.4], specular = 0.3, exponent = 20 }
[objects]
room = { shape = "box", min = [0, 0, 0], max = [4, 3, 2.5], material = "wall" }
floor.shape = "polygons"
floor.vertices = [[0, 0, 0.01], [4, 0, 0.01], [4, 3, 0.01], [0, 3, 0.01]]
floor.faces = [[0, 1, 2], [0, 2, 3]]
floor.material = "floor"
[lights]
bulb = { type = "point", position = [2, 1.5, 2.3], flux = 800 }
[sensors]
desk = { type = "grid", corner = [1, 1, 0.75], edge_u = [1.6, 0, 0], edge_v = [0, 0.8, 0], count = [4, 2] }
spot = { type = "luminance", position = [1, 1, 1.5], direction = [0, 0, -1] }
view = { type = "camera", position = [0.3, 0.3, 1.6], target = [2.5, 2, 0.8], fov = 70, resolution = [12, 8] }
)";

stilb::SceneBuilder room() {
    stilb::SceneBuilder builder("room");
    builder.material("wall", {{"type", "diffuse"}, {"reflectance", 0.6}})
        .material("floor",
                  {{"type", "phong"}, {"diffuse", {0.2, 0.3, 0.4}}, {"specular", 0.3}, {"exponent", 20}})
        .object("room", {{"shape", "box"}, {"min", {0, 0, 0}}, {"max", {4, 3, 2.5}}, {"material", "wall"}})
        .mesh("floor", {{0, 0, 0.01}, {4, 0, 0.01}, {4, 3, 0.01}, {0, 3, 0.01}}, {{0, 1, 2}, {0, 2, 3}},
              "floor")
        .light("bulb", {{"type", "point"}, {"position", {2, 1.5, 2.3}}, {"flux", 800}})
        .sensor("desk", {{"type", "grid"},
                         {"corner", {1, 1, 0.75}},
                         {"edge_u", {1.6, 0, 0}},
                         {"edge_v", {0, 0.8, 0}},
                         {"count", {4, 2}}})
        .sensor("spot", {{"type", "luminance"}, {"position", {1, 1, 1.5}}, {"direction", {0, 0, -1}}})
        .sensor("view", {{"type", "camera"},
                         {"position", {0.3, 0.3, 1.6}},
                         {"target", {2.5, 2, 0.8}},
                         {"fov", 70},
                         {"resolution", {12, 8}}});
    return builder;
}

stilb::Options few_samples() {
    stilb::Options options;
    options.paths = 4096;
    return options;
}

std::string message_of(const auto& action) {
    try {
        action();
    } catch (const stilb::InputError& error) {
        return error.what();
    }
    return "no error";
}

TEST(Library, BuiltScenesMeasureWhatReadScenesDo) {
    const stilb::Result built = stilb::measure(room().build(), few_samples());
    const stilb::Result read = stilb::measure(stilb::Scene::parse(kRoom), few_samples());
    ASSERT_EQ(built.sensors.size(), 2u) << "the camera is left out";
    for (const char* name : {"desk", "spot"}) {
        const stilb::SensorResult& a = built[name];
        const stilb::SensorResult& b = read[name];
        ASSERT_EQ(a.readings.size(), b.readings.size());
        for (std::size_t i = 0; i < a.readings.size(); ++i) {
            EXPECT_EQ(a.readings[i].value, b.readings[i].value);
            EXPECT_GT(a.readings[i].standard_error, 0);
            EXPECT_LT(a.readings[i].lower, a.readings[i].value);
            EXPECT_GT(a.readings[i].upper, a.readings[i].value);
            EXPECT_EQ(a.readings[i].position, b.readings[i].position);
        }
    }
    const stilb::SensorResult& desk = built["desk"];
    EXPECT_EQ(desk.count, (std::array{4, 2}));
    EXPECT_EQ(desk.unit, "lx");
    EXPECT_EQ(desk.type, "grid");
    EXPECT_NEAR(desk.readings[5].position[0], 1.6, 1e-12);
    EXPECT_NEAR(desk.readings[5].position[1], 1.6, 1e-12);
    EXPECT_LT(desk.minimum.value, desk.mean.value);
    EXPECT_NEAR(desk.uniformity.value, desk.minimum.value / desk.mean.value, 1e-12);
    EXPECT_EQ(built["spot"].unit, "cd/m2");
    EXPECT_EQ(built.samples, 4096u);
    EXPECT_NE(built.json().find("\"desk\""), std::string::npos);
}

TEST(Library, OptionsOfPatchesAreThoseOfTheProgram) {
    stilb::Options options = few_samples();
    options.method = "ray-bundle";
    options.patch_m = 1;
    options.paths = 64;
    const auto first_shot = [](const stilb::Result& result) {
        const std::string json = result.json();
        const std::string_view key = "\"variant\": \"";
        const std::size_t begin = json.find(key) + key.size();
        return json.substr(begin, json.find('"', begin) - begin);
    };
    EXPECT_EQ(first_shot(stilb::measure(room().build(), options)), "incoming");
    options.first_shot = "classical";
    options.resolution = 64;
    options.window = "cube";
    options.directions = "pair";
    EXPECT_EQ(first_shot(stilb::measure(room().build(), options)), "classical");
    options.method = "path";
    options.patch_m.reset();
    EXPECT_EQ(message_of([&] { stilb::measure(room().build(), options); }),
              "directions has no effect with method path. It belongs to: ray-bundle.");
    options.directions.reset();
    options.first_shot.reset();
    EXPECT_EQ(message_of([&] { stilb::measure(room().build(), options); }),
              "window has no effect with method path unless first_shot is given.");
    options.window = "cubes";
    EXPECT_NE(message_of([&] { stilb::measure(room().build(), options); }).find("Did you mean \"cube\""),
              std::string::npos);
    const auto scene = stilb::Scene::parse(std::string(kRoom) +
                                           "[run]\nmethod = \"ray-bundle\"\nfirst_shot = \"diffuse\"\n"
                                           "patch = 1\npaths = 64\n");
    EXPECT_EQ(scene.options().first_shot, "diffuse");
    EXPECT_EQ(first_shot(stilb::measure(scene)), "diffuse");
}

TEST(Library, ReplicatesAreTheBasisOfTheErrors) {
    const stilb::Result result = stilb::measure(room().build(), few_samples());
    const stilb::SensorResult& desk = result["desk"];
    const std::size_t readings = desk.readings.size(),
                      replicates = static_cast<std::size_t>(result.replicates);
    ASSERT_EQ(desk.replicates.size(), replicates * readings);
    for (std::size_t j = 0; j < readings; ++j) {
        double sum = 0, squares = 0;
        for (std::size_t r = 0; r < replicates; ++r) sum += desk.replicates[r * readings + j];
        const double mean = sum / static_cast<double>(replicates);
        for (std::size_t r = 0; r < replicates; ++r)
            squares += std::pow(desk.replicates[r * readings + j] - mean, 2);
        EXPECT_NEAR(mean, desk.readings[j].value, 1e-9 * mean);
        EXPECT_NEAR(std::sqrt(squares / static_cast<double>(replicates * (replicates - 1))),
                    desk.readings[j].standard_error, 1e-9 * mean);
    }
}

TEST(Library, HeadersHaveTheVersionOfTheProgram) {
    const std::string numbers = std::to_string(STILB_VERSION_MAJOR) + "." +
                                std::to_string(STILB_VERSION_MINOR) + "." +
                                std::to_string(STILB_VERSION_PATCH);
    EXPECT_EQ(STILB_VERSION, numbers);
    const stilb::Result result = stilb::measure(room().build(), few_samples());
    EXPECT_NE(result.json().find("\"stilb\": \"" + numbers + "\""), std::string::npos);
}

/// What no part of the library throws.
struct Fault {};

TEST(Library, ExceptionsOfProgressArriveAsTheyAre) {
    std::vector<stilb::Triple> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t i = 0; i < 20'000; ++i) {
        const double x = 0.01 * (i % 200), y = 0.01 * (i / 200);
        vertices.insert(vertices.end(), {{x, y, 0.02}, {x + 0.01, y, 0.02}, {x, y + 0.01, 0.02}});
        triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    stilb::SceneBuilder builder = room();
    builder.mesh("tiles", vertices, triangles, "wall");
    const stilb::Scene scene = builder.build();
    for (const std::string& stage : {std::string("acceleration structure"), std::string()}) {
        stilb::Control control;
        control.report = [&](const stilb::Progress& progress) {
            if (progress.stage == stage) throw Fault();
        };
        EXPECT_THROW(stilb::measure(scene, few_samples(), control), Fault) << stage;
    }
    EXPECT_EQ(stilb::measure(scene, few_samples()).samples, 4096u) << "the scene can be used all the same";
}

/// The reader's message without the file and line that it begins with.
std::string readers_message(const std::string& toml) {
    const std::string message = message_of([&] { stilb::Scene::parse(toml); });
    const std::size_t line_end = message.find(": ");
    return message.substr(message.starts_with(':') ? line_end + 2 : 0);
}

TEST(Library, BuildersHaveTheReadersMessages) {
    const auto message = [](const char* key, const stilb::Value& value) {
        return message_of([&] {
            stilb::SceneBuilder builder;
            builder.material("wall", {{"type", "diffuse"}, {key, value}}).build();
        });
    };
    const auto expect_same = [&](const char* key, const stilb::Value& value, const std::string& text) {
        const std::string read = readers_message("materials.wall = { type = \"diffuse\", " +
                                                 std::string(key) + " = " + text + " }");
        EXPECT_EQ(message(key, value), read);
        EXPECT_NE(read, "no error");
        EXPECT_NE(read.find("materials.wall"), std::string::npos) << read;
    };
    expect_same("reflectance", 2, "2");
    expect_same("reflectance", "white", "\"white\"");
    expect_same("reflectance", {0.5, 0.5}, "[0.5, 0.5]");
    expect_same("reflectence", 0.5, "0.5");
}

TEST(Library, NamesAreGivenOnce) {
    stilb::SceneBuilder builder = room();
    EXPECT_NE(message_of([&] { builder.light("bulb", {}); }).find("lights.bulb"), std::string::npos);
}

TEST(Library, ValidateFindsWhatIsWrongAndWhatIsOdd) {
    EXPECT_TRUE(validate(room()).empty()) << validate(room()).front();
    stilb::SceneBuilder wrong = room();
    wrong.light("spot", {{"type", "point"}, {"position", {2, 1, 1}}});
    ASSERT_EQ(validate(wrong).size(), 1u);
    EXPECT_EQ(validate(wrong).front(), message_of([&] { wrong.build(); }));

    stilb::SceneBuilder odd = room();
    odd.sensor("outside", {{"type", "illuminance"}, {"position", {9, 9, 9}}, {"normal", {0, 0, 1}}});
    ASSERT_EQ(validate(odd).size(), 1u);
    EXPECT_NE(validate(odd).front().find("outside"), std::string::npos);
    EXPECT_EQ(validate(odd.build()), validate(odd));
}

TEST(Library, OptionsAreThoseOfTheSceneUnlessOthersAreGiven) {
    const stilb::Scene scene =
        stilb::Scene::parse(std::string(kRoom) + "[run]\nmethod = \"path\"\npaths = 2048\nseed = 7\n");
    EXPECT_EQ(scene.name(), "room");
    EXPECT_EQ(scene.sensors(), (std::vector<std::string>{"desk", "spot", "view"}));
    const stilb::Options options = scene.options();
    EXPECT_EQ(options.method, "path");
    EXPECT_EQ(options.paths, 2048u);
    const stilb::Result result = stilb::measure(scene);
    EXPECT_EQ(result.method, "path");
    EXPECT_EQ(result.samples, 2048u);
    EXPECT_EQ(result.seed, 7u);
}

TEST(Library, WrongOptionsAndNamesAreRefused) {
    const stilb::Scene scene = room().build();
    stilb::Options options = few_samples();
    options.method = "pth";
    EXPECT_NE(message_of([&] { stilb::measure(scene, options); }).find("\"path\""), std::string::npos);
    options = few_samples();
    options.patch_m = 0.1;
    EXPECT_NE(
        message_of([&] { stilb::measure(scene, options); }).find("patch has no effect with method auto"),
        std::string::npos);
    options = few_samples();
    options.threads = -1;
    EXPECT_NE(message_of([&] { stilb::measure(scene, options); }).find("threads"), std::string::npos);
    EXPECT_NE(message_of([&] { stilb::render(scene, "veiw", few_samples()); }).find("\"view\""),
              std::string::npos);
    const stilb::Result result = stilb::measure(scene, few_samples());
    EXPECT_NE(message_of([&] { result["desc"]; }).find("desk"), std::string::npos);
}

TEST(Library, AnyPointsAreMeasured) {
    stilb::SceneBuilder builder;
    builder.light("bulb",
                  {{"type", "point"}, {"position", {2, 1.5, 2.3}}, {"flux", 4 * std::numbers::pi * 100}});
    const stilb::Scene scene = builder.build();
    const std::array<stilb::Ray, 2> elements{{{{2, 1.5, 0.3}, {0, 0, 7}}, {{2, 1.5, 0.3}, {0, 0, -1}}}};
    const stilb::Result result = stilb::illuminance(scene, elements, few_samples());
    const stilb::SensorResult& lit = result["illuminance"];
    ASSERT_EQ(lit.readings.size(), 2u);
    EXPECT_NEAR(lit.readings[0].value, 100 / (2.0 * 2.0), 1e-6);  // I / d^2
    EXPECT_EQ(lit.readings[1].value, 0);
    EXPECT_EQ(lit.readings[0].direction, (stilb::Triple{0, 0, 1}));

    const stilb::Scene bright = room().build();
    const std::array<stilb::Ray, 1> sights{{{{1, 1, 1.5}, {0, 0, -1}}}};
    const stilb::Result seen = stilb::luminance(bright, sights, few_samples());
    const stilb::Result spot = stilb::measure(bright, few_samples(), {}, {"spot"});
    ASSERT_EQ(spot.sensors.size(), 1u);
    EXPECT_EQ(seen["luminance"].readings[0].value, spot["spot"].readings[0].value);

    const std::array<stilb::Ray, 1> nowhere{{{{1, 1, 1}, {0, 0, 0}}}};
    EXPECT_NE(message_of([&] { stilb::illuminance(bright, nowhere); }).find("point 0"), std::string::npos);
    EXPECT_NE(message_of([&] { stilb::measure(bright, {}, {}, {"desc"}); }).find("\"desk\""),
              std::string::npos);
}

TEST(Library, TablesDefaultsAndRunAreThoseOfSceneFiles) {
    using Parameters = stilb::Parameters;
    stilb::SceneBuilder builder = room();
    builder.defaults({{"lights", Parameters{{"maintenance", 0.5}}}})
        .run({{"method", "path"}, {"target", "mean"}})
        .light("row", {{"type", "point"},
                       {"flux", 100},
                       {"array", Parameters{{"origin", {1, 1, 2}},
                                            {"step_u", {1, 0, 0}},
                                            {"step_v", {0, 1, 0}},
                                            {"count", {2, 1}}}}});
    const stilb::Scene built = builder.build();
    const stilb::Scene read = stilb::Scene::parse(std::string(kRoom) + R"(
[defaults]
lights.maintenance = 0.5
[run]
method = "path"
target = "mean"
[lights.row]
type = "point"
flux = 100
array = { origin = [1, 1, 2], step_u = [1, 0, 0], step_v = [0, 1, 0], count = [2, 1] }
)");
    EXPECT_EQ(built.options().target, "mean");
    stilb::Options options = built.options();
    options.paths = 32;
    const stilb::Result a = stilb::measure(built, options), b = stilb::measure(read, options);
    EXPECT_EQ(a["desk"].mean.value, b["desk"].mean.value);
    options.target = "men";
    EXPECT_NE(message_of([&] { stilb::measure(built, options); }).find("\"mean\""), std::string::npos);
}

TEST(Library, PartsAreAddedToAScene) {
    std::string without = kRoom.data();
    for (const char* line : {"bulb = ", "spot = "}) {
        const std::size_t begin = without.find(line);
        without.erase(begin, without.find('\n', begin) - begin);
    }
    const stilb::Scene dark = stilb::Scene::parse(without);
    stilb::SceneBuilder builder(dark);
    builder.light("bulb", {{"type", "point"}, {"position", {2, 1.5, 2.3}}, {"flux", 800}})
        .sensor("spot", {{"type", "luminance"}, {"position", {1, 1, 1.5}}, {"direction", {0, 0, -1}}});
    const stilb::Scene lit = builder.build();
    EXPECT_EQ(lit.sensors(), (std::vector<std::string>{"desk", "view", "spot"}));
    const stilb::Result added = stilb::measure(lit, few_samples(), {}, {"desk"});
    const stilb::Result whole = stilb::measure(stilb::Scene::parse(kRoom), few_samples(), {}, {"desk"});
    EXPECT_EQ(added["desk"].mean.value, whole["desk"].mean.value);
    EXPECT_TRUE(validate(lit).empty()) << validate(lit).front();
    builder.material("wall", {{"type", "black"}});
    EXPECT_NE(message_of([&] { builder.build(); }).find("materials.wall: the scene has a part of this name"),
              std::string::npos);
}

TEST(Library, MeshesFromMemoryAreChecked) {
    const auto message = [](const std::vector<stilb::Triple>& vertices, std::uint32_t corner) {
        return message_of([&] {
            stilb::SceneBuilder builder = room();
            builder.mesh("sheet", vertices, {{0, 1, corner}}, "wall").build();
        });
    };
    const double infinite = std::numeric_limits<double>::infinity();
    EXPECT_EQ(message({{0, 0, 1}, {1, 0, 1}, {1, 1, 1}}, 2), "no error");
    EXPECT_NE(message({{0, 0, 1}, {1, 0, 1}, {1, 1, 1}}, 3)
                  .find("objects.sheet.faces: a triangle has the vertex 3"),
              std::string::npos);
    EXPECT_NE(message({{0, 0, 1}, {1, infinite, 1}, {1, 1, 1}}, 2).find("objects.sheet.vertices: vertex 1: "),
              std::string::npos);
    EXPECT_NE(message({{0, 0, 1}, {1, 0, 1}}, 1).find("fewer than 3 vertices"), std::string::npos);
}

TEST(Library, TypesOfPartsAreListedWithTheirKeys) {
    const std::vector<stilb::PartType> types = stilb::part_types();
    const auto keys = [&](const std::string& section, const std::string& type) {
        const auto found = std::ranges::find_if(
            types, [&](const stilb::PartType& part) { return part.section == section && part.type == type; });
        return found == types.end() ? std::vector<std::string>{} : found->keys;
    };
    EXPECT_EQ(keys("materials", "diffuse"), (std::vector<std::string>{"type", "reflectance", "back"}));
    EXPECT_EQ(keys("objects", "box"), (std::vector<std::string>{"min", "max", "shape", "material", "scale",
                                                                "rotate", "translate", "transform"}));
    EXPECT_FALSE(keys("lights", "environment").empty());
    EXPECT_FALSE(keys("sensors", "camera").empty());
}

TEST(Library, RunsAreFollowedAndInterrupted) {
    std::atomic<bool> interrupt{false};
    int reports = 0;
    stilb::Control control;
    control.interrupt = &interrupt;
    control.report = [&](const stilb::Progress& progress) {
        ++reports;
        if (progress.stage.empty()) interrupt = true;
    };
    stilb::Options options;
    options.error = 1e-6;
    options.time_s = 60;
    const stilb::Result result = stilb::measure(room().build(), options, control);
    EXPECT_GT(reports, 0);
    EXPECT_FALSE(result.converged);
    EXPECT_LT(result.elapsed_s, 30);
}

TEST(Library, PicturesHavePixelsAndErrors) {
    stilb::Options options;
    options.paths = 16;
    const stilb::Picture picture = stilb::render(room().build(), "", options);
    ASSERT_EQ(picture.luminance_cd_m2.size(), 12u * 8u);
    EXPECT_EQ(picture.width, 12);
    EXPECT_EQ(picture.rgb_cd_m2.size(), 12u * 8u);
    EXPECT_EQ(picture.standard_error_cd_m2.size(), 12u * 8u);
    EXPECT_GT(picture.luminance_cd_m2[50], 0);
    const stilb::TestFolder folder;
    const auto file = folder / "picture.png";
    picture.save(file);
    EXPECT_GT(std::filesystem::file_size(file), 100u);
    EXPECT_THROW(picture.save("/nowhere/picture.png"), stilb::InputError);
}

TEST(Library, SolutionsShowWhatRenderingDoes) {
    const stilb::TestFolder folder;
    const stilb::Scene scene = stilb::Scene::load(folder.write("room.toml", std::string(kRoom)));
    stilb::Options options;
    options.paths = 512;
    options.patch_m = 0.5;
    const stilb::Solution solution = stilb::solve(scene, options);
    const stilb::Picture stored = solution.render("view");
    options.method = "ray-bundle";
    options.paths = 32;
    const stilb::Picture direct = stilb::render(scene, "view", options);
    double stored_sum = 0, direct_sum = 0;
    for (std::size_t i = 0; i < stored.luminance_cd_m2.size(); ++i) {
        stored_sum += stored.luminance_cd_m2[i];
        direct_sum += direct.luminance_cd_m2[i];
    }
    EXPECT_NEAR(stored_sum, direct_sum, 0.05 * direct_sum);
    EXPECT_EQ(solution.summary().method, "ray-bundle");
    solution.save(folder / "room.solution");
    EXPECT_GT(std::filesystem::file_size(folder / "room.solution"), 1000u);
    const stilb::Solution loaded = stilb::Solution::load(folder / "room.solution");
    EXPECT_EQ(loaded.lights(), (std::vector<std::string>{"bulb"}));
    EXPECT_EQ(loaded.summary().samples, solution.summary().samples);
    const stilb::Picture dimmed = loaded.render("view", {}, {{"bulb", {0.5, 0.5, 0.5}}});
    for (std::size_t i = 0; i < stored.luminance_cd_m2.size(); ++i) {
        EXPECT_NEAR(dimmed.luminance_cd_m2[i], 0.5 * stored.luminance_cd_m2[i],
                    2e-3 * stored.luminance_cd_m2[i]);  // files keep 11 bits of each value
    }
    EXPECT_NE(message_of([&] {
                  loaded.render("view", {}, {{"bulb", {-1, 1, 1}}});
              }).find("lights.bulb"),
              std::string::npos);
    EXPECT_NE(message_of([&] {
                  stilb::solve(room().build(), options).save("room.solution");
              }).find("built in code"),
              std::string::npos);
}

}  // namespace
