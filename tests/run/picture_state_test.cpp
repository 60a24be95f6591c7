// Pictures that another run continues: they have the bits of a picture in one go.
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

/// With fewer passes than decide the paces, with just as many, and with more.
TEST_P(PictureState, PartsAreTheBitsOfTheWhole) {
    const bool lights_patches = options_.method == "ray-bundle";
    for (const std::uint64_t passes : {7, 8, 9, 20}) {
        if (lights_patches && passes != 20) continue;  // as they have no paces, all numbers are alike
        options_.paths = passes;
        PictureSums whole;
        const RenderResult in_one_go = render(scene_, camera_, options_, nullptr, nullptr, &whole);
        for (const std::size_t parts : {std::size_t{3}, whole.plan().replicates}) {
            PictureSums merged;
            for (std::size_t k = parts; k-- > 0;) {
                PictureSums part;
                render_part(scene_, camera_, options_, {k, parts}, part);
                part = read_state<PictureSums>(bytes_of(part));
                if (k + 1 == parts)
                    merged = part;
                else
                    merged.merge(part);
                EXPECT_THROW(merged.merge(std::move(part)), std::invalid_argument) << "twice";
                if (k > 0) {
                    EXPECT_THROW(result_of(scene_, camera_, options_, merged), InputError) << "parts lack";
                }
            }
            EXPECT_EQ(bytes_of(merged), bytes_of(whole)) << passes << " passes in " << parts << " parts";
            EXPECT_EQ(result_of(scene_, camera_, options_, merged).pixels.rgb_cd_m2,
                      in_one_go.pixels.rgb_cd_m2);
        }
        EXPECT_EQ(whole.plan().paces.empty(), lights_patches || passes < 9);
    }
}

/// A whole run takes over what parts have left.
TEST_P(PictureState, ARunGoesOnFromSomeParts) {
    PictureSums whole, state;
    render(scene_, camera_, options_, nullptr, nullptr, &whole);
    render_part(scene_, camera_, options_, {1, 3}, state);
    const RenderResult continued = render(scene_, camera_, options_, nullptr, nullptr, &state);
    EXPECT_EQ(continued.samples, 20u);
    EXPECT_EQ(bytes_of(state), bytes_of(whole));
}

/// The value of a pixel is the mean of both runs by their passes, whatever their paces were.
TEST_P(PictureState, SeedsAreAddedByTheirPasses) {
    PictureSums one, other;
    const RenderResult first = render(scene_, camera_, options_, nullptr, nullptr, &one);
    options_.seed = 2;
    options_.paths = 40;
    const RenderResult second = render(scene_, camera_, options_, nullptr, nullptr, &other);
    PictureSums both = one;
    EXPECT_THROW(both.merge(one), std::invalid_argument);
    both.merge(other);
    EXPECT_THROW(both.merge(other), std::invalid_argument);
    both = read_state<PictureSums>(bytes_of(both));
    EXPECT_EQ(both.seeds(), (std::vector<std::uint64_t>{1, 2}));
    const RenderResult merged = result_of(scene_, camera_, options_, both);
    EXPECT_EQ(merged.samples, 60u);
    double errors = 0, of_first = 0;
    for (std::size_t i = 0; i < merged.depth_m.size(); ++i) {
        for (std::size_t b = 0; b < 3; ++b) {
            const float expected = (first.pixels.rgb_cd_m2[i][b] + 2 * second.pixels.rgb_cd_m2[i][b]) / 3;
            ASSERT_NEAR(merged.pixels.rgb_cd_m2[i][b], expected, 1e-5F * expected);
        }
        errors += double{merged.pixels.standard_error_cd_m2[i]};
        of_first += double{first.pixels.standard_error_cd_m2[i]};
    }
    EXPECT_NEAR(errors / of_first, std::sqrt(20. / 60), 0.12);
    EXPECT_THROW(render(scene_, camera_, options_, nullptr, nullptr, &both), std::invalid_argument);
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

TEST(PictureSums, PartsAreAsManyAsReplicatesAtMost) {
    RunOptions options;
    options.method = "path";
    PictureSums state;
    const auto part = [&](std::size_t number, std::size_t of) {
        render_part(room_with_box(), camera_of({20, 10}), options, {number, of}, state);
    };
    EXPECT_THROW(part(0, 2), InputError) << "no number of passes";
    options.paths = 8;
    EXPECT_THROW(part(2, 2), InputError);
    EXPECT_THROW(part(0, 5), InputError);
    part(3, 4);
    EXPECT_EQ(state.passes(), 2u);
}

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
