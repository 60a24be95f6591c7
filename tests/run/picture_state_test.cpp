// Pictures that another run continues: they have the bits of a picture in one go.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "run/pictures/picture_sums.h"
#include "run/run.h"
#include "stilb/error.h"
#include "support/continued_runs.h"

namespace stilb::run {
namespace {

Sensor camera_of(std::array<int, 2> resolution) {
    Camera camera;
    camera.position = {0.3, 0.3, 1.5};
    camera.target = {2.6, 1.8, 0.7};
    camera.fov_deg = 75;
    camera.resolution = resolution;
    return {"camera", camera};
}

class PictureState : public testing::TestWithParam<const char*> {
  protected:
    PictureState() {
        options_.method = GetParam();
        options_.paths = 20;
        if (options_.method == "ray-bundle") options_.patch_m = 1;
    }
    Scene scene_ = room_with_box();
    Sensor camera_ = camera_of({40, 24});
    RunOptions options_;
};

/// The second interruption comes after the paces are decided.
TEST_P(PictureState, HasTheSameBitsAfterInterruptions) {
    PictureSums whole, state;
    const RenderResult in_one_go = render(scene_, camera_, options_, nullptr, nullptr, &whole);
    for (const int reports : {3, 8}) {
        Impatience viewer(reports);
        const RenderResult some = render(scene_, camera_, options_, &viewer, &viewer.interrupt, &state);
        ASSERT_EQ(some.stop_reason, StopReason::interrupted);
        ASSERT_LT(state.passes(), 20u);
        state = read_state<PictureSums>(bytes_of(state));
    }
    EXPECT_EQ(state.plan().has_paces, !state.plan().paces.empty());
    const RenderResult continued = render(scene_, camera_, options_, nullptr, nullptr, &state);
    EXPECT_EQ(continued.technique, in_one_go.technique);
    EXPECT_EQ(continued.pixels.rgb_cd_m2, in_one_go.pixels.rgb_cd_m2);
    EXPECT_EQ(continued.pixels.standard_error_cd_m2, in_one_go.pixels.standard_error_cd_m2);
    EXPECT_EQ(bytes_of(state), bytes_of(whole));
    const RenderResult again = render(scene_, camera_, options_, nullptr, nullptr, &state);
    EXPECT_EQ(again.pixels.rgb_cd_m2, in_one_go.pixels.rgb_cd_m2) << "nothing is left to do";
    EXPECT_EQ(again.samples, in_one_go.samples);
}

std::string name_of_method(const testing::TestParamInfo<const char*>& method) {
    std::string name;
    for (const char letter : std::string(method.param)) {
        if (letter != '-') name += letter;
    }
    return name;
}
INSTANTIATE_TEST_SUITE_P(Methods, PictureState,
                         testing::Values("auto", "path", "light-paths", "guided", "ray-bundle"),
                         name_of_method);

TEST(PictureSums, RefuseWhatDoesNotFit) {
    const Scene scene = room_with_box();
    RunOptions options;
    options.method = "path";
    options.paths = 16;
    PictureSums state;
    render(scene, camera_of({20, 10}), options, nullptr, nullptr, &state);
    const std::string before = bytes_of(state);
    EXPECT_THROW(render(scene, camera_of({10, 20}), options, nullptr, nullptr, &state),
                 std::invalid_argument);
    EXPECT_EQ(bytes_of(state), before);
    for (const std::size_t size : {std::size_t{0}, std::size_t{7}, before.size() / 2, before.size() - 1})
        EXPECT_THROW(read_state<PictureSums>(before.substr(0, size)), InputError) << size;
}

}  // namespace
}  // namespace stilb::run
