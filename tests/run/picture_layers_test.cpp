// Layers of pictures: the light of each group of lamps, or after each number of reflections.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "run/pictures/picture_sums.h"
#include "run/run.h"
#include "stilb/error.h"
#include "support/continued_runs.h"

namespace stilb::run {
namespace {

Scene room_with_three_lamps() {
    Scene scene = room_with_box();
    add_point_light(scene, {0.6, 2.4, 2}, {{150, 90, 40}});
    add_point_light(scene, {2.1, 0.5, 2.2}, Rgb::grey(120));
    scene.lights[0].name = "panel";
    scene.lights[1].name = "left", scene.lights[1].group = "lamps";
    scene.lights[2].name = "right", scene.lights[2].group = "lamps";
    return scene;
}

Sensor view() {
    Camera camera;
    camera.position = {0.3, 2.7, 1.6};
    camera.target = {2.6, 1, 0.7};
    camera.fov_deg = 80;
    camera.resolution = {24, 18};
    return {"view", camera};
}

RunOptions passes(const char* method, const char* by, std::uint64_t count) {
    RunOptions options;
    options.method = method;
    options.by = by;
    options.paths = count;
    return options;
}

double mean_of(const std::vector<std::array<float, 3>>& pixels) {
    double sum = 0;
    for (const auto& [r, g, b] : pixels) sum += Rgb{{r, g, b}}.luminance();
    return sum / static_cast<double>(pixels.size());
}

class LayersOf : public testing::TestWithParam<const char*> {};

TEST_P(LayersOf, AddUpToThePicture) {
    for (const char* by : {"light", "bounce"}) {
        const RenderResult result = render(room_with_three_lamps(), view(), passes(GetParam(), by, 12));
        ASSERT_EQ(result.layers.size(), by == std::string("light") ? 2u : 8u);
        ASSERT_EQ(result.pixels.layers_cd_m2.size(), result.layers.size());
        for (std::size_t i = 0; i < result.pixels.rgb_cd_m2.size(); ++i) {
            for (std::size_t b = 0; b < kBands; ++b) {
                double sum = 0;
                for (const auto& layer : result.pixels.layers_cd_m2) sum += double{layer[i][b]};
                const double whole = double{result.pixels.rgb_cd_m2[i][b]};
                EXPECT_NEAR(sum, whole, 1e-4 * std::abs(whole) + 1e-4) << by << ", pixel " << i;
            }
        }
    }
}

TEST_P(LayersOf, AreThoseOfLampsAlone) {
    // A pass of path tracing knows less, and costs less.
    const std::uint64_t count = GetParam() == std::string("path") ? 256 : 32;
    const RenderResult result = render(room_with_three_lamps(), view(), passes(GetParam(), "light", count));
    EXPECT_EQ(result.layers, (std::vector<std::string>{"panel", "lamps"}));
    for (std::size_t layer = 0; layer < 2; ++layer) {
        Scene alone = room_with_three_lamps();
        std::erase_if(alone.lights,
                      [&](const Light& light) { return (light.name == "panel") != (layer == 0); });
        RunOptions options = passes(GetParam(), "none", count);
        options.seed = 2;
        const RenderResult expected = render(alone, view(), options);
        // The errors of single pixels, over all pixels as if they were independent, times 4 for those that
        // are not.
        const double error =
            4 * 4 * std::hypot(result.mean_standard_error_cd_m2, expected.mean_standard_error_cd_m2) /
            std::sqrt(static_cast<double>(result.pixels.rgb_cd_m2.size()));
        EXPECT_NEAR(mean_of(result.pixels.layers_cd_m2[layer]), expected.mean_luminance_cd_m2, error)
            << layer;
        EXPECT_LT(error, 0.1 * expected.mean_luminance_cd_m2) << "the comparison tells something";
    }
}

/// Also in a picture that is interrupted, kept as bytes and continued.
TEST_P(LayersOf, AreContinuedBitByBit) {
    const Scene scene = room_with_three_lamps();
    const RunOptions options = passes(GetParam(), "light", 14);
    const RenderResult whole = render(scene, view(), options);
    PictureSums state;
    Impatience impatience(5);
    render(scene, view(), options, &impatience, &impatience.interrupt, &state);
    ASSERT_LT(state.passes(), 14u);
    state = read_state<PictureSums>(bytes_of(state));
    const RenderResult result = render(scene, view(), options, nullptr, nullptr, &state);
    EXPECT_EQ(result.pixels.layers_cd_m2, whole.pixels.layers_cd_m2);
    EXPECT_EQ(result.pixels.rgb_cd_m2, whole.pixels.rgb_cd_m2);
    EXPECT_THROW(render(scene, view(), passes(GetParam(), "none", 14), nullptr, nullptr, &state),
                 std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Techniques, LayersOf, testing::Values("path", "light-paths", "guided"),
                         [](const auto& technique) {
                             std::string name;
                             for (const char letter : std::string(technique.param))
                                 if (letter != '-') name += letter;
                             return name;
                         });

TEST(PictureLayers, OfOneGroupAreThePicture) {
    const RenderResult result = render(room_with_box(), view(), passes("path", "light", 4));
    ASSERT_EQ(result.layers.size(), 1u);
    EXPECT_EQ(result.pixels.layers_cd_m2[0], result.pixels.rgb_cd_m2);
}

TEST(PictureLayers, AreRefusedByMethodsOnPatches) {
    RunOptions options = passes("ray-bundle", "light", 4);
    options.patch_m = 1;
    EXPECT_THROW(render(room_with_three_lamps(), view(), options), InputError);
}

}  // namespace
}  // namespace stilb::run
