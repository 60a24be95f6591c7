// What a solution's scene may change in, and what not.
#include <gtest/gtest.h>

#include "io/text/text.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

constexpr const char* kScene = R"(
[scene]
name = "A room"
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
[sensors.view]
type = "camera"
position = [0.5, 2.5, 1.6]
target = [4, 1, 1]
)";

class LightHash : public testing::Test {
  protected:
    /// With the first `old` replaced.
    std::string hash_with(const std::string& old = "", const std::string& text = "") {
        std::string scene = kScene;
        scene.replace(scene.find(old), old.size(), text);
        return light_hash(std::vector{folder_.write("room.toml", scene), folder_.write("room.obj", mesh_)});
    }

    std::string mesh_ = "v 0 0 0\n";
    const TestFolder folder_;
};

TEST_F(LightHash, IsThatOfMaterialsObjectsAndLights) {
    const std::string hash = hash_with();
    EXPECT_EQ(hash.size(), 16u);
    EXPECT_EQ(hash_with(), hash);
    EXPECT_NE(hash_with("reflectance = 0.5", "reflectance = 0.6"), hash);
    EXPECT_NE(hash_with("[4, 3, 2.5]", "[4, 3, 2.4]"), hash);
    EXPECT_NE(hash_with("flux = 1000", "flux = 1001"), hash);
    EXPECT_NE(hash_with("lights.bulb", "lights.lamp"), hash);
    mesh_ = "v 0 0 1\n";
    EXPECT_NE(hash_with(), hash);
}

TEST_F(LightHash, IsNotThatOfSensorsRunTitleAndLayout) {
    const std::string hash = hash_with();
    EXPECT_EQ(hash_with("position = [0.5, 2.5, 1.6]", "position = [1, 1, 1]"), hash);
    EXPECT_EQ(hash_with("[sensors.view]", "[sensors.door]"), hash);
    EXPECT_EQ(hash_with("[scene]", "[run]\nerror = 0.1\n[scene]"), hash);
    EXPECT_EQ(hash_with("A room", "Another name"), hash);
    EXPECT_EQ(hash_with("flux = 1000", "flux = 1e3  # lumen"), hash);
    EXPECT_EQ(hash_with("[4, 3, 2.5]", "[ 4.0, 3,\n 2.50 ]"), hash);
}

}  // namespace
}  // namespace stilb::io
