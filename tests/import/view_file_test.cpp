// Views of Radiance and of pictures as cameras.
#include "io/import/view_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/image/picture_file.h"
#include "stilb/error.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

constexpr double kRadiansPerDegree = kPi / 180;

ViewFile view_of(const std::string& text) { return read_view_file(text, "a.vf"); }
std::string refusal_of_view(const std::string& text) {
    try {
        view_of(text);
        return "accepted";
    } catch (const InputError& error) {
        return error.what();
    }
}

TEST(ViewFile, IsACamera) {
    const Camera camera =
        view_of("rvu -vtv -vp 1 2 1.6 -vd 0.6 0.8 -0.1 -vu 0 0 1 -vh 60 -vv 40 -vo 0 -va 0 -vs 0 -vl 0\n")
            .camera;
    EXPECT_EQ(camera.position, (Vec3{1, 2, 1.6}));
    EXPECT_LT(length(camera.target - Vec3{1.6, 2.8, 1.5}), 1e-12);
    EXPECT_EQ(camera.up, (Vec3{0, 0, 1}));
    EXPECT_EQ(camera.fov_deg, 60);
    EXPECT_EQ(camera.projection, Projection::perspective);
    EXPECT_EQ(camera.resolution,
              (std::array{1280, static_cast<int>(std::lround(1280 * std::tan(20 * kRadiansPerDegree) /
                                                             std::tan(30 * kRadiansPerDegree)))}));
}

TEST(ViewFile, HasRadiancesDefaults) {
    const Camera camera = view_of("VIEW= -vp 1 2 3\n").camera;
    EXPECT_EQ(camera.target, (Vec3{1, 3, 3}));
    EXPECT_EQ(camera.fov_deg, 45);
    EXPECT_EQ(camera.resolution, (std::array{1280, 1280}));
}

TEST(ViewFile, TakesLinesOfProgramsAndFollowsTheLast) {
    const Camera camera = view_of(
                              "# a comment\nview= n -vtv -vp 1 1 1 -vh 50\n\n/usr/local/bin/rpict -av 1 1 1 "
                              "-vp 2 1 1 -x 640 -y 300\nxform -vp 9 9 9\n-vv 22.5\n")
                              .camera;
    EXPECT_EQ(camera.position, (Vec3{2, 1, 1}));
    EXPECT_EQ(camera.fov_deg, 50);
    // In a box of 640 x 300.
    const double aspect = std::tan(11.25 * kRadiansPerDegree) / std::tan(25 * kRadiansPerDegree);
    EXPECT_EQ(camera.resolution, (std::array{640, static_cast<int>(std::lround(640 * aspect))}));
    EXPECT_EQ(view_of("-vh 40 -vv 60 -x 500 -y 500\n").camera.resolution[1], 500);
}

TEST(ViewFile, TakesFisheyes) {
    const ViewFile angular = view_of("rvu -vta -vd 1 0 0 -vh 180 -vv 180\n");
    EXPECT_EQ(angular.camera.projection, Projection::fisheye);
    EXPECT_EQ(angular.camera.fov_deg, 180);
    EXPECT_EQ(angular.camera.resolution, (std::array{1280, 1280}));
    EXPECT_TRUE(angular.warnings.empty());
    const ViewFile hemispherical = view_of("rvu -vth -vd 1 0 0 -vh 180 -vv 180\n");
    EXPECT_EQ(hemispherical.camera.projection, Projection::fisheye);
    ASSERT_EQ(hemispherical.warnings.size(), 1u);
    EXPECT_EQ(hemispherical.warnings[0],
              "a.vf: the fisheye -vth is not supported; an angular one (-vta) of the same angles stands for "
              "it. The "
              "same is seen, at other places of the picture.");
}

TEST(ViewFile, NamesWhatItLeavesOut) {
    const ViewFile view = view_of("rvu -vtv -vs 0.1 -vl 0 -vo 1 -va 0\n");
    ASSERT_EQ(view.warnings.size(), 2u);
    EXPECT_EQ(view.warnings[0],
              "a.vf: the shift (-vs) and the lift (-vl) of the picture off its axis are left out.");
    EXPECT_EQ(view.warnings[1],
              "a.vf: the clipping planes (-vo, -va) are left out: surfaces at all distances are seen.");
}

TEST(ViewFile, RefusesWhatIsNoView) {
    EXPECT_EQ(refusal_of_view("void plastic m\n0\n0\n"),
              "a.vf: there is no view. Needed: a line such as rvu -vtv -vp 1 1 1.6 -vd 1 1 0 -vu 0 0 1 -vh "
              "60 -vv 40.");
    EXPECT_EQ(refusal_of_view("\nrvu -vp 1 2\n"),
              "a.vf:2: the option -vp of the view needs a number from -1e9 to 1e9, but nothing was found.");
    EXPECT_EQ(refusal_of_view("rvu -vh wide\n"),
              "a.vf:1: the option -vh of the view needs a number from -1e9 to 1e9, but \"wide\" was found.");
    EXPECT_EQ(refusal_of_view("rvu -vtl -vh 5 -vv 5\n"),
              "a.vf: a view of type -vtl is not supported. Allowed: -vtv (perspective) and -vta (angular "
              "fisheye).");
    EXPECT_EQ(refusal_of_view("rvu -vtv -vd 0 0 -1\n"),
              "a.vf: the direction of the view (-vd) is 0 or parallel to its upward direction (-vu).");
    EXPECT_EQ(refusal_of_view("rvu -vtv -vh 180\n"),
              "a.vf: the angle of view 180 is not allowed for -vtv. Allowed: from 0.001 to 179.9 degrees.");
    EXPECT_EQ(refusal_of_view("rvu -vtv -vv 0\n"),
              "a.vf: the angle of view 0 is not allowed for -vtv. Allowed: from 0.001 to 179.9 degrees.");
}

TEST(ViewFile, APictureGivesItsViewAndSize) {
    const TestFolder folder;
    const auto path = folder.write("stilb-view-test.hdr",
                                   "#?RADIANCE\nVIEW= -vta -vp 1 2 3 -vd 0 -1 0 -vu 0 0 1 -vh "
                                   "90 -vv 45\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" +
                                       std::string(8, '\x40'));
    SceneFile file;
    file.sensors.push_back({"stilb-view-test", Camera{}});
    const std::string name = add_view(path, {}, file);
    EXPECT_EQ(name, "stilb-view-test_2");
    ASSERT_EQ(file.sensors.size(), 2u);
    const Camera& camera = *file.sensors[1].camera();
    EXPECT_EQ(camera.projection, Projection::fisheye);
    EXPECT_EQ(camera.position, (Vec3{1, 2, 3}));
    EXPECT_EQ(camera.resolution, (std::array{2, 1}));
    EXPECT_EQ(file.sources.back(), path);
}

}  // namespace
}  // namespace stilb::io
