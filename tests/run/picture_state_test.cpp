// Pictures that another run continues: they have the bits of a picture in one go.
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

#include "run/pictures/picture_sums.h"
#include "run/run.h"
#include "stilb/error.h"
#include "support/scene_builder.h"

namespace stilb::run {
namespace {

Scene room_with_box() {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {3, 3, 3}}, diffuse(0.5));
    add_object(scene, Box{{1.7, 0.6, 0.001}, {2.5, 1.4, 0.7}}, diffuse(0.5));
    add_area_light(scene, Rectangle{{1.1, 1.1, 2.99}, {0, 0.8, 0}, {0.8, 0, 0}}, Rgb::grey(5000));
    return scene;
}

Sensor camera_of(std::array<int, 2> resolution) {
    Camera camera;
    camera.position = {0.3, 0.3, 1.5};
    camera.target = {2.6, 1.8, 0.7};
    camera.fov_deg = 75;
    camera.resolution = resolution;
    return {"camera", camera};
}

std::string bytes_of(const PictureSums& sums) {
    ByteWriter bytes;
    sums.write(bytes);
    return bytes.take();
}

PictureSums sums_of(const std::string& bytes) {
    const std::string name = "run";
    ByteReader reader(bytes, 0, name, "Run again.");
    PictureSums sums = PictureSums::read(reader);
    reader.expect_end();
    return sums;
}

/// Interrupts after so many reports.
class ImpatientViewer final : public PictureSink {
  public:
    explicit ImpatientViewer(int reports) : left_(reports) {}
    void report(const Progress&) override { interrupt = --left_ <= 0; }
    bool wants_picture() override { return false; }
    void show(const Pixels&) override {}
    std::atomic<bool> interrupt = false;

  private:
    int left_;
};

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
        ImpatientViewer viewer(reports);
        const RenderResult some = render(scene_, camera_, options_, &viewer, &viewer.interrupt, &state);
        ASSERT_EQ(some.stop_reason, StopReason::interrupted);
        ASSERT_LT(state.passes(), 20u);
        state = sums_of(bytes_of(state));
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
        EXPECT_THROW(sums_of(before.substr(0, size)), InputError) << size;
}

}  // namespace
}  // namespace stilb::run
