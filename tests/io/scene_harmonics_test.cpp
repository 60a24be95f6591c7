#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "geometry/harmonics/surface.h"
#include "io/mesh/harmonics_file.h"
#include "io/scene_text.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

const double kUnit = std::sqrt(4 * std::numbers::pi);

std::string harmonic_object(const std::string& keys) {
    return "[materials.wall]\ntype = \"black\"\n[objects.a]\nshape = \"harmonics\"\nmaterial = \"wall\"\n" +
           keys;
}

Harmonics harmonic_shape_of(const std::string& toml,
                            const std::filesystem::path& directory = "no-such-directory") {
    return std::get<Harmonics>(read_scene_text(toml, directory).scene.objects.at(0).shape);
}

/// 1 + 0.2 z.
std::string coefficients() {
    const double first = 0.2 * std::sqrt(4 * std::numbers::pi / 3);
    return fmt::format("coefficients = [{}, 0, {}, 0]\n", kUnit, first);
}

void expect_near(const Vec3& actual, const Vec3& expected, double tolerance = 1e-9) {
    EXPECT_LT(length(actual - expected), tolerance) << actual.x << ' ' << actual.y << ' ' << actual.z;
}

TEST(SceneHarmonics, HaveTheirRadiusByDirection) {
    const Harmonics shape = harmonic_shape_of(harmonic_object(coefficients()));
    expect_near(shape.point_towards({0, 0, 1}), {0, 0, 1.2});
    expect_near(shape.point_towards({0, 0, -1}), {0, 0, -0.8});
    expect_near(shape.point_towards({1, 0, 0}), {1, 0, 0});
    EXPECT_EQ(shape.method, HarmonicMethod::cells);
    EXPECT_FALSE(shape.has_levels_of_detail);
}

TEST(SceneHarmonics, AreScaledAndTurnedAboutTheCenterThatIsGiven) {
    const Harmonics shape = harmonic_shape_of(
        harmonic_object(coefficients() + "center = [5, 6, 7]\nscale = 2\nrotate = [0, 1, 0, 90]\n"));
    expect_near(shape.point_towards({1, 0, 0}), {5 + 2.4, 6, 7});
    expect_near(shape.point_towards({0, 1, 0}), {5, 8, 7});
    const Harmonics moved =
        harmonic_shape_of(harmonic_object(coefficients() + "center = [5, 6, 7]\ntranslate = [0, 0, 1]\n"));
    expect_near(moved.point_towards({0, 0, 1}), {5, 6, 9.2});
}

TEST(SceneHarmonics, FromAFileLieWhereItsMeshLay) {
    const TestFolder directory;
    write_harmonics({{kUnit}, {1, 2, 3}}, directory / "ball.json");
    const std::string file = "file = \"ball.json\"\n";
    expect_near(harmonic_shape_of(harmonic_object(file), directory).center, {1, 2, 3}, 1e-6);
    expect_near(harmonic_shape_of(harmonic_object(file + "scale = 2\n"), directory).center, {2, 4, 6}, 1e-6);
    expect_near(
        harmonic_shape_of(harmonic_object(file + "scale = 2\ncenter = [0, 1, 0]\n"), directory).center,
        {0, 1, 0}, 1e-6);
    const SceneFile scene = read_scene_text(harmonic_object(file), directory);
    ASSERT_EQ(scene.sources.size(), 1u);  // what a hash of the scene is made of
}

TEST(SceneHarmonics, EndAtTheDegreeAskedFor) {
    EXPECT_EQ(harmonic_shape_of(harmonic_object(coefficients())).surface->radius().degree(), 1);
    const Harmonics ball = harmonic_shape_of(harmonic_object(coefficients() + "degree = 0\n"));
    EXPECT_EQ(ball.surface->radius().degree(), 0);
    expect_near(ball.point_towards({0, 0, 1}), {0, 0, 1});
}

TEST(SceneHarmonics, KnowMethodsAndLevelsOfDetail) {
    EXPECT_EQ(harmonic_shape_of(harmonic_object(coefficients() + "intersection = \"roots\"\n")).method,
              HarmonicMethod::roots);
    EXPECT_EQ(harmonic_shape_of(harmonic_object(coefficients() + "intersection = \"march\"\n")).method,
              HarmonicMethod::march);
    EXPECT_TRUE(harmonic_shape_of(harmonic_object(coefficients() + "lod = true\n")).has_levels_of_detail);
}

TEST(SceneHarmonics, RefuseWhatIsNoSurface) {
    EXPECT_REFUSAL(
        harmonic_object("coefficients = [1, 2]\n"),
        "s.toml:6: objects.a.coefficients: found 2 coefficients. Allowed: (degree + 1)^2 of them for "
        "a degree from 0 to 128: 1, 4, 9, 16 ...");
    EXPECT_REFUSAL(harmonic_object("coefficients = [1, 0, 9, 0]\n"),
                   "s.toml:3: objects.a: the radius of a surface by spherical harmonics is 0 or nearly 0 "
                   "(its least value is below 3 % of the greatest): it must be above 0 in all directions");
    EXPECT_REFUSAL(harmonic_object(coefficients() + "degree = 2\n"),
                   "s.toml:7: objects.a.degree: found the number 2. Allowed: a whole number from 0 to 1.");
    EXPECT_REFUSAL(harmonic_object(coefficients() + "lod = 1\n"),
                   "s.toml:7: objects.a.lod: found the number 1 where true or false is needed.");
    EXPECT_REFUSAL(
        harmonic_object(""),
        "s.toml:3: objects.a: key \"file\" or \"coefficients\" is missing for shape \"harmonics\".");
    EXPECT_REFUSAL(
        harmonic_object(coefficients() + "intersection = \"rots\"\n"),
        "s.toml:7: objects.a.intersection: unknown intersection \"rots\". Did you mean \"roots\"? Allowed: "
        "cells, roots, march.");
}

}  // namespace
}  // namespace stilb::io
