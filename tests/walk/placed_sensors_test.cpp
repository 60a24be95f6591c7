#include "walk/service/placed_sensors.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "io/scene/scene_file.h"
#include "io/text/table.h"
#include "io/text/text.h"
#include "stilb/error.h"
#include "support/test_folder.h"

namespace stilb::walk {
namespace {

constexpr const char* kPlacedRoom = R"(
[materials.wall]
type = "diffuse"
reflectance = 0.5
[objects.room]
shape = "box"
min = [0, 0, 0]
max = [4, 3, 2.5]
material = "wall"
[lights.bulb]
type = "point"
position = [2, 1.5, 2]
flux = 1000
)";

std::string refusal(const std::string& json) {
    try {
        read_placed_sensors(json, {});
        return "accepted";
    } catch (const InputError& error) {
        return error.what();
    }
}

std::string one(const std::string& members) { return R"({"sensors": [{)" + members + "}]}"; }

TEST(PlacedSensors, AreReadBackAsTheyWere) {
    const std::vector<Sensor> placed = read_placed_sensors(
        R"({"sensors": [
            {"name": "desk", "type": "illuminance", "position": [1.2000000476837158, 1, 0.75], "normal": [0, 0, 2]},
            {"name": "left \"wall\" [1].ä", "type": "illuminance", "position": [1e-9, -1, 1.25], "normal": [1, 1, 0]},
            {"name": "eye", "type": "luminance", "position": [1, 1, 1.2], "direction": [0, 3, 4]}]})",
        {});
    const io::SceneFile file = io::read_scene(kPlacedRoom + to_toml(placed), "s.toml", ".");
    ASSERT_EQ(file.sensors.size(), 3u);
    EXPECT_TRUE(file.warnings.empty());
    for (std::size_t i = 0; i < placed.size(); ++i) {
        EXPECT_EQ(file.sensors[i].name, placed[i].name);
        EXPECT_EQ(file.sensors[i].type(), placed[i].type());
        const Location is = file.sensors[i].location(0), was = placed[i].location(0);
        EXPECT_LT(length(is.position - was.position), 1e-6);
        EXPECT_LT(length(is.directions[0].value - was.directions[0].value), 2e-6);
    }
}

TEST(PlacedSensors, TextIsShort) {
    const auto placed = read_placed_sensors(
        one(R"("name": "desk", "type": "illuminance", "position": [1.2000000476837158, -1e-12, 0.75], "normal": [0, 0, 1])"),
        {});
    EXPECT_EQ(
        to_toml(placed),
        "[sensors.desk]\ntype = \"illuminance\"\nposition = [1.2, 0.0, 0.75]\nnormal = [0.0, 0.0, 1.0]\n");
}

TEST(PlacedSensors, TakenNamesGetANumber) {
    const std::string desk =
        R"({"name": "desk", "type": "illuminance", "position": [1, 1, 1], "normal": [0, 0, 1]})";
    const auto present = read_placed_sensors(R"({"sensors": [)" + desk + "]}", {});
    const auto placed = read_placed_sensors(R"({"sensors": [)" + desk + "," + desk + "]}", present);
    EXPECT_EQ(placed[0].name, "desk_2");
    EXPECT_EQ(placed[1].name, "desk_3");
}

TEST(PlacedSensors, WrongOnesAreRefused) {
    const std::string rest = R"("type": "illuminance", "position": [1, 1, 1], "normal": [0, 0, 1])";
    EXPECT_EQ(refusal(one(R"("name": "a", )" + rest)), "accepted");
    EXPECT_EQ(refusal(one(R"("name": "a", "more": 1, )" + rest)),
              "The sensor has an unknown member \"more\". Allowed: name, type, position, normal.");
    for (const char* name : {"", "a/b", "a\\\\b", "a\\nb", "\\u007f"})
        EXPECT_NE(refusal(one("\"name\": \"" + std::string(name) + "\", " + rest)), "accepted") << name;
    EXPECT_NE(refusal(one("\"name\": \"" + std::string(101, 'a') + "\", " + rest)), "accepted");
    for (const char* json :
         {"", "{", "[]", "1", "{}", R"({"sensors": []})", R"({"sensors": {}})", R"({"sensors": [1]})",
          R"({"sensors": [{}]})", R"({"sensors": [{"name": 1}]})", R"({"other": []})"})
        EXPECT_NE(refusal(json), "accepted") << json;
    for (const char* members :
         {R"("name": "a", "type": "grid", "position": [1, 1, 1], "normal": [0, 0, 1])",
          R"("name": "a", "type": "illuminance", "position": [1, 1], "normal": [0, 0, 1])",
          R"("name": "a", "type": "illuminance", "position": [1, 1, 1e999], "normal": [0, 0, 1])",
          R"("name": "a", "type": "illuminance", "position": [1, 1, null], "normal": [0, 0, 1])",
          R"("name": "a", "type": "illuminance", "position": [1, 1, 1], "normal": [0, 0, 0])",
          R"("name": "a", "type": "luminance", "position": [1, 1, 1], "normal": [0, 0, 1])"})
        EXPECT_NE(refusal(one(members)), "accepted") << members;
}

TEST(PlacedSensors, AreSavedIntoNewFilesOnly) {
    const TestFolder folder;
    io::write_file(folder / "room-sensors-2.toml", "mine");
    EXPECT_EQ(save_beside(folder / "room.toml", "one"), folder / "room-sensors.toml");
    EXPECT_EQ(save_beside(folder / "room.toml", "two"), folder / "room-sensors-3.toml");
    EXPECT_EQ(io::read_whole_file(folder / "room-sensors.toml"), "one");
    EXPECT_EQ(io::read_whole_file(folder / "room-sensors-2.toml"), "mine");
    EXPECT_EQ(io::read_whole_file(folder / "room-sensors-3.toml"), "two");
    // A link that leads nowhere is somebody's, too.
    std::filesystem::create_symlink(folder / "elsewhere", folder / "room-sensors-4.toml");
    EXPECT_EQ(save_beside(folder / "room.toml", "three"), folder / "room-sensors-5.toml");
    EXPECT_FALSE(std::filesystem::exists(folder / "elsewhere"));
    EXPECT_EQ(save_beside(folder / "none" / "room.toml", "one"), std::nullopt);
    EXPECT_EQ(save_beside("-", "one"), std::nullopt);
}

TEST(PlacedSensors, TheAnswerSaysWhereTheyAre) {
    const TestFolder folder;
    const std::string request =
        one(R"("name": "a", "type": "illuminance", "position": [1, 1, 1], "normal": [0, 0, 1])");
    const std::string answer = keep_placed_sensors(request, {}, folder / "room.toml");
    EXPECT_NE(answer.find(R"("toml":"[sensors.a]\ntype = )"), std::string::npos) << answer;
    EXPECT_NE(answer.find(R"("saved":"room-sensors.toml")"), std::string::npos) << answer;
    const std::string text = io::read_whole_file(folder / "room-sensors.toml");
    EXPECT_EQ(io::read_scene(kPlacedRoom + text, "s.toml", ".").sensors.size(), 1u);
    EXPECT_THROW(keep_placed_sensors(request, {}, folder / "none" / "room.toml"), InputError);
}

}  // namespace
}  // namespace stilb::walk
