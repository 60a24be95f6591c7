#include "walk/live_walk.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "io/scene/scene_file.h"
#include "stilb/error.h"

namespace stilb::walk {
namespace {

using std::chrono::milliseconds;

constexpr const char* kRoom = R"(
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

RunOptions steps(std::uint64_t count) {
    RunOptions options;
    options.method = "ray-bundle";
    options.paths = count;
    options.patch_m = 1;
    return options;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

TEST(Pace, ShowingTakesATenthOfTheTimeAtMost) {
    const Pace::Clock::time_point start{};
    Pace pace;
    EXPECT_TRUE(pace.is_due(start));
    pace.add(start, start + milliseconds(500));
    EXPECT_FALSE(pace.is_due(start + milliseconds(4999)));
    EXPECT_TRUE(pace.is_due(start + milliseconds(5000)));
    pace.add(start, start + milliseconds(1));
    EXPECT_FALSE(pace.is_due(start + milliseconds(300)));
    EXPECT_TRUE(pace.is_due(start + milliseconds(500)));
}

TEST(LiveWalk, HasSceneAndLightAtTheEnd) {
    const io::SceneFile file = io::read_scene(kRoom, "s.toml", ".");
    LiveWalk walk(file, steps(64), 2, nullptr);
    EXPECT_EQ(walk.scene(), nullptr);
    EXPECT_EQ(walk.light(), nullptr);
    EXPECT_TRUE(contains(walk.state(), R"("scene":false,"light":0,"error":null)")) << walk.state();
    walk.start();
    const SolveResult result = walk.finish();
    EXPECT_TRUE(walk.is_finished());
    EXPECT_GT(result.samples, 0u);
    ASSERT_NE(walk.scene(), nullptr);
    ASSERT_NE(walk.light(), nullptr);
    EXPECT_TRUE(walk.scene()->starts_with("STILBWLK"));
    EXPECT_TRUE(walk.light()->starts_with("STILBWLK"));
    EXPECT_TRUE(contains(walk.state(), R"("stage":"done","share":1.0,"scene":true)")) << walk.state();
    EXPECT_TRUE(contains(walk.state(), R"("done":true,"message":"Finished: all steps done.")"))
        << walk.state();
}

TEST(LiveWalk, ShowsASolution) {
    const io::SceneFile file = io::read_scene(kRoom, "s.toml", ".");
    LiveWalk walk(file, run::solve(file.scene, steps(64), 2));
    walk.start();
    walk.finish();
    ASSERT_NE(walk.scene(), nullptr);
    ASSERT_NE(walk.light(), nullptr);
    EXPECT_TRUE(contains(walk.state(), R"("light":1)")) << walk.state();
}

TEST(LiveWalk, LightIsRefined) {
    const io::SceneFile file = io::read_scene(kRoom, "s.toml", ".");
    LiveWalk walk(file, steps(10'000'000), 2, nullptr);
    walk.start();
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!contains(walk.state(), R"("light":3)") && std::chrono::steady_clock::now() < deadline)
        std::this_thread::sleep_for(milliseconds(5));
    EXPECT_TRUE(contains(walk.state(), R"("stage":"refining")")) << walk.state();
    EXPECT_FALSE(contains(walk.state(), R"("elapsed_s":0.0,)")) << walk.state();
    // Data that somebody still sends stays as it is.
    const Bytes third = walk.light();
    const std::string copy = *third;
    walk.interrupt();
    const SolveResult result = walk.finish();
    EXPECT_EQ(result.stop_reason, StopReason::interrupted);
    EXPECT_EQ(*third, copy);
    EXPECT_NE(walk.light(), third);
    EXPECT_TRUE(contains(walk.state(), "Finished: interrupted.")) << walk.state();
}

TEST(LiveWalk, EndsAtOnceWhereNobodyWantsIt) {
    const io::SceneFile file = io::read_scene(kRoom, "s.toml", ".");
    const auto begin = std::chrono::steady_clock::now();
    {
        LiveWalk walk(file, steps(10'000'000), 2, nullptr);
        walk.start();
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, milliseconds(1000));
}

TEST(LiveWalk, FailuresArePassedOn) {
    const io::SceneFile file = io::read_scene(kRoom, "s.toml", ".");
    RunOptions options = steps(64);
    options.bounces = 1;  // solutions have all reflections
    LiveWalk walk(file, options, 2, nullptr);
    walk.start();
    EXPECT_THROW(walk.finish(), InputError);
}

}  // namespace
}  // namespace stilb::walk
