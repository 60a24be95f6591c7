// The language of Radiance's scene files: words, commands, transforms. Expected numbers of commands are those
// of Radiance's own programs (xform and genbox of pyradiance 1.3).
#include "radiance_text.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

using radiance::SurfaceKind;

const std::string kSurfaces = with_material(
    "void plastic other 0 0 5 .5 .5 .5 0 0\n"
    "m polygon p 0 0 9 1 2 3 4 5 6 7 9 11\n"
    "m ring r 0 0 8 1 0 0 0 0 1 0.25 0.5\n"
    "m cone c 0 0 8 0 0 0 0 1 2 0.5 0.25\n"
    "m bubble b 0 0 4 1 1 1 0.5\n");

class RadianceFiles : public testing::Test {
  protected:
    RadianceFiles() { std::filesystem::create_directories(folder_ / "parts"); }
    void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }
    radiance::Description describe(const std::string& text) const {
        return radiance::read_description(text, "r.rad", folder_);
    }
    const TestFolder folder_;
};

TEST(RadianceDescription, CommentsQuotesAndArgumentsOverLines) {
    const auto description = describe_rad(
        "# a comment\n\nvoid plastic 'two words' # another\n0\n0\n5\n .1 .2 # inside\n.3\t0\n0\n"
        "\"two words\" polygon floor 0 0 9\n0 0 0 1 0 0\n1 1 0\n");
    ASSERT_EQ(description.modifiers.size(), 1u);
    EXPECT_EQ(description.modifiers[0].name, "two words");
    EXPECT_EQ(description.modifiers[0].numbers, (std::vector<double>{.1, .2, .3, 0, 0}));
    ASSERT_EQ(description.surfaces.size(), 1u);
    EXPECT_EQ(description.surfaces[0].modifier, 0u);
    EXPECT_EQ(description.surfaces[0].place.line, 10u);
}

TEST(RadianceDescription, AliasesAndRedefinitions) {
    const auto description = describe_rad(
        "void plastic a 0 0 5 .1 .1 .1 0 0\nvoid alias b a\nvoid plastic a 0 0 5 .2 .2 .2 0 0\n"
        "a sphere s1 0 0 4 0 0 0 1\nb sphere s2 0 0 4 0 0 0 1\ninherit alias c a\nc sphere s3 0 0 4 0 0 0 "
        "1\n");
    EXPECT_EQ(description.surfaces[0].modifier, 1u);
    EXPECT_EQ(description.surfaces[1].modifier, 0u);
    EXPECT_EQ(description.surfaces[2].modifier, 1u);
}

TEST_F(RadianceFiles, TransformsOfXform) {
    write("t.rad", kSurfaces);
    const auto description =
        describe("!xform -m other -n x -t 1 0 0 -rz 90 -s 2 -i 2 -t 0 0 0.5 -i 1 -mx \\\n -ry 30 t.rad\n");
    ASSERT_EQ(description.surfaces.size(), 4u);
    EXPECT_EQ(description.surfaces[0].name, "x.p");
    EXPECT_EQ(description.modifiers[*description.surfaces[0].modifier].name, "other");
    expect_numbers(
        description, 0,
        {27.0884572681, 16, 10.918584287, 15.1602540378, 10, 6.2583302492, 6.96410161514, 4, 4.06217782649});
    expect_numbers(description, 1, {0.5, 4, 0.866025403784, 1, 0, 1.73205080757, 0.5, 1});
    expect_numbers(description, 2, {0.5, 2, 0.866025403784, 4.23205080757, 2, 3.33012701892, 1, 0.5});
    expect_numbers(description, 3, {3.23205080757, 4, 1.59807621135, 1});
}

TEST_F(RadianceFiles, InvertedSurfaces) {
    write("t.rad", kSurfaces);
    const auto description = describe("!xform -I -rx 20 t.rad\n");
    expect_numbers(
        description, 0,
        {7, 4.69501201049, 13.4148001186, 4, 2.64634224398, 7.34825644134, 1, 0.853324811595, 3.50311814901});
    expect_numbers(description, 1, {1, 0, 0, 0, 0.342020143326, -0.939692620786, 0.25, 0.5});
    EXPECT_EQ(description.surfaces[2].kind, SurfaceKind::cup);
    EXPECT_EQ(description.surfaces[3].kind, SurfaceKind::sphere);
}

TEST_F(RadianceFiles, ArraysAndNestedFiles) {
    write("parts/ball.rad", "m sphere b 0 0 4 1 1 1 0.5\n");
    write("parts/pair.rad", "!xform -n pair ball.rad\n");
    auto description =
        describe(with_material("!xform -a 2 -rz 10 -a 2 -t 0 1 0 -i 1 -t 0 0 5 parts/pair.rad\n!cat "
                               "parts/ball.rad parts/pair.rad\n"));
    ASSERT_EQ(description.surfaces.size(), 6u);
    EXPECT_EQ(description.surfaces[0].name, "a0.0.pair.b");
    EXPECT_EQ(description.surfaces[1].name, "a0.1.pair.b");
    EXPECT_EQ(description.surfaces[3].name, "a1.1.pair.b");
    EXPECT_EQ(description.surfaces[5].name, "pair.b");
    expect_numbers(description, 1, {1, 2, 6, 0.5});
    expect_numbers(description, 2, {0.811159575345, 1.15845593068, 6, 0.5});
    expect_numbers(description, 3, {0.811159575345, 2.15845593068, 6, 0.5});
    expect_numbers(description, 4, {1, 1, 1, 0.5});
}

TEST_F(RadianceFiles, ArgumentFilesOfXform) {
    write("ball.rad", "m sphere b 0 0 4 0 0 0 1\n");
    write("places", "# places\n-t 1 0 0\n\nxform -s 2 -t 0 0 7\n");
    const auto description = describe(with_material("!xform -f places ball.rad\n"));
    ASSERT_EQ(description.surfaces.size(), 2u);
    EXPECT_EQ(description.surfaces[1].name, "i1.b");
    expect_numbers(description, 0, {1, 0, 0, 1});
    expect_numbers(description, 1, {0, 0, 7, 2});
}

TEST(RadianceDescription, BoxesOfGenbox) {
    const auto box = describe_rad(with_material("!genbox m b 1 2 3 | xform -t 5 0 0\n"));
    ASSERT_EQ(box.surfaces.size(), 6u);
    const SceneFile scene = read_rad(with_material("!genbox m b 1 2 3\n"));
    EXPECT_NEAR(area_m2(scene.scene.objects[0].shape), 22, 1e-12);

    const auto bevelled = describe_rad(with_material("!genbox m b 1 2 3 -b 0.1\n"));
    EXPECT_EQ(bevelled.surfaces.size(), 26u);
    const auto round = describe_rad(with_material("!genbox m b 1 2 3 -r 0.1\n"));
    EXPECT_EQ(round.surfaces.size(), 26u);
    EXPECT_EQ(std::ranges::count(round.surfaces, SurfaceKind::cylinder, &radiance::Surface::kind), 12);
}

/// The volume of a closed mesh, by the divergence theorem: positive where fronts look outwards.
double volume_m3(const Mesh& mesh) {
    double volume = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        volume += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c])) / 6;
    return volume;
}

TEST(RadianceDescription, FrontsOfBoxesLookOutwardsUnlessInverted) {
    const auto volume = [](const std::string& command) {
        return volume_m3(std::get<Mesh>(read_rad(with_material(command)).scene.objects[0].shape));
    };
    const double cut = 6 - 4 * (1 + 2 + 3 - 0.6) * 0.1 * 0.1 / 2 - 8 * 5.0 / 6 * 0.1 * 0.1 * 0.1;
    EXPECT_NEAR(volume("!genbox m b 1 2 3\n"), 6, 1e-12);
    EXPECT_NEAR(volume("!genbox m b 1 2 3 -i\n"), -6, 1e-12);
    EXPECT_NEAR(volume("!genbox m b 1 2 3 -b .1\n"), cut, 1e-12);
    EXPECT_NEAR(volume("!genbox m b 1 2 3 -b .1 | xform -mx\n"), cut, 1e-12);
    EXPECT_NEAR(volume("!genbox m b 1 2 3 -b .1 | xform -I -mx\n"), -cut, 1e-12);
}

TEST(RadianceDescription, MessagesNameFileLineAndRemedy) {
    EXPECT_EQ(
        refusal_of_rad("void plastik m 0 0 5 1 1 1 0 0\n"),
        "r.rad:1: \"plastik\" is no type of a primitive. Did you mean \"plastic\"? A primitive is: MODIFIER "
        "TYPE NAME, then its arguments.");
    EXPECT_EQ(
        refusal_of_rad(with_material("\nn sphere s 0 0 4 0 0 0 1\n")),
        "r.rad:3: the modifier \"n\" is not defined before this line. Did you mean \"m\"? Needed: a material "
        "of this name, or void.");
    EXPECT_EQ(refusal_of_rad(with_material("m sphere s 0 0 4\n0 0\nx 1\n")),
              "r.rad:4: found \"x\" where a number of a sphere is needed.");
    EXPECT_EQ(refusal_of_rad(with_material("m sphere s 0 0 3 0 0 0\n")),
              "r.rad:2: a sphere has 4 numbers, but 3 were found.");
    EXPECT_EQ(refusal_of_rad(with_material("m polygon p 0 0 8 0 0 0 1 0 0 1 1\n")),
              "r.rad:2: a polygon has three numbers for each of three or more corners, but 8 numbers were "
              "found.");
    EXPECT_EQ(
        refusal_of_rad(with_material("m cylinder c 0 0 7 1 1 1 1 1 1 .5\n")),
        "r.rad:2: both ends of the cylinder are the same point. Allowed: two points; a flat one is a ring.");
    EXPECT_EQ(refusal_of_rad(with_material("m ring c 0 0 8 0 0 0 0 0 1 -1 1\n")),
              "r.rad:2: the radius -1 is below 0. Allowed: 0 and more.");
    EXPECT_EQ(refusal_of_rad("void plastic m 0 0 4 1 1 1 0\nm sphere s 0 0 4 0 0 0 1\n"),
              "r.rad:1: plastic m: it has 5 numbers, but 4 were found.");
    EXPECT_EQ(refusal_of_rad("void plastic m 0 0 5 1 1"),
              "r.rad:1: the file ends before the numbers of a primitive.");
    EXPECT_EQ(refusal_of_rad("# nothing\n"),
              "r.rad: there is no surface. Needed: polygons, spheres or other surfaces.");
}

TEST(RadianceDescription, CommandsThatAreNotRun) {
    EXPECT_EQ(
        refusal_of_rad("\n!gendaylit 6 21 12\n"),
        "r.rad:2: the command \"gendaylit\" cannot be run, because Stilb runs no other programs. Allowed: "
        "xform, genbox, gensky, cat. Or let a shell run it once, and include its output: !cat FILE.");
    EXPECT_EQ(
        refusal_of_rad("!cat a.rad; rm b\n"),
        "r.rad:1: the command contains \";\", which a shell would interpret. Stilb runs no shell. Allowed: "
        "xform, genbox, gensky and cat, joined by \"|\"; other characters in quotes.");
    EXPECT_EQ(refusal_of_rad("!genbox m b 1 1 1 | wc\n"),
              "r.rad:1: \"wc\" behind a \"|\" is not allowed. Allowed: xform.");
    unsetenv("RAYPATH");
    EXPECT_EQ(
        refusal_of_rad("!cat none.rad\n"),
        "r.rad:1: there is no file \"none.rad\", neither beside this file, nor beside the scene's, nor in a "
        "folder of the environment variable RAYPATH, which is not set.");
    EXPECT_EQ(refusal_of_rad("!xform -t 1 0 x.rad\n"),
              "r.rad:1: \"x.rad\" behind \"-t\" is not allowed. Allowed: a number from -1e9 to 1e9.");
    EXPECT_EQ(refusal_of_rad("!xform -t 1 0 0\n"),
              "r.rad:1: xform has no file to read. Needed: xform TRANSFORMS FILE.");
    EXPECT_EQ(
        refusal_of_rad(with_material("!genbox m b 1 1\n")),
        "r.rad:2: arguments are missing. Needed: genbox MATERIAL NAME X Y Z [-i] [-b BEVEL | -r RADIUS].");
    EXPECT_EQ(
        refusal_of_rad("!genbox n b 1 1 1\n"),
        "r.rad:1: the modifier \"n\" is not defined before this line. Needed: a material of this name, or "
        "void.");
}

TEST_F(RadianceFiles, LibrariesAreInTheFoldersOfRaypath) {
    write("parts/ball.rad", "m sphere ball 0 0 4 0 0 0 2\n");
    std::filesystem::create_directories(folder_ / "scene");
    const auto balls = [&](const std::string& command) {
        return radiance::read_description(with_material(command), "r.rad", folder_ / "scene").surfaces.size();
    };
    setenv(
        "RAYPATH",
        ("." + std::string(":") + (folder_ / "none").string() + "::" + (folder_ / "parts").string()).c_str(),
        1);
    EXPECT_EQ(balls("!xform -t 1 0 0 ball.rad\n!cat ball.rad\n"), 2u);
    EXPECT_THROW(balls("!cat ./ball.rad\n"), InputError);
    EXPECT_THROW(balls("!cat box.rad\n"), InputError);
    unsetenv("RAYPATH");
    EXPECT_THROW(balls("!cat ball.rad\n"), InputError);
}

TEST_F(RadianceFiles, ErrorsInNestedFilesNameThem) {
    write("parts/bad.rad", "\nm sphere s 0 0 4 0 0 0\n");
    try {
        describe(with_material("!xform -t 1 0 0 parts/bad.rad\n"));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.what(), (folder_ / "parts/bad.rad").string() +
                                    ":2: the file ends before the numbers of a primitive.");
    }
    write("loop.rad", "!cat loop.rad\n");
    EXPECT_THROW(describe("!cat loop.rad\n"), InputError);
}

TEST(RadianceDescription, CopiesAreLimited) {
    const radiance::Limits limits{.primitives = 1000};
    EXPECT_THROW(radiance::read_description(with_material("!genbox m b 1 1 1 | xform -a 200 -t 1 0 0\n"),
                                            "r.rad", ".", {}, limits),
                 InputError);
    EXPECT_THROW(radiance::read_description(
                     with_material("!genbox m b 1 1 1 | xform -a 900000 -t 1 0 0 -a 900000 -t 0 1 0\n"),
                     "r.rad", ".", {}, limits),
                 InputError);
}

}  // namespace
}  // namespace stilb::io
