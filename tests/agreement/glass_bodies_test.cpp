// Bodies of glass, seen against a lamp that fills the view: the luminance is that of the lamp times the
// transmittance of the layers with all interreflections. Layers add up as R / T = sum of R_i / T_i, because
// nothing is absorbed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "io/scene/scene_file.h"
#include "run/run.h"
#include "scene/glass.h"

namespace stilb {
namespace {

constexpr double kLamp_cd_m2 = 1000;

/// A lamp at z = 100, and sensors at z = -5 that look up, straight and oblique.
std::string scene(const std::string& glass) {
    return "[materials.g]\ntype = \"glass\"\nior = 1.5\n[materials.w]\ntype = \"glass\"\nior = 1.333\n"
           "[materials.k]\ntype = \"black\"\n[objects.lamp]\nshape = \"rectangle\"\ncorner = [-200, -200, "
           "100]\n"
           "edge_u = [0, 400, 0]\nedge_v = [400, 0, 0]\nmaterial = \"k\"\n[lights.l]\ntype = \"area\"\n"
           "object = \"lamp\"\nluminance = 1000\n" +
           glass +
           "[sensors.n]\ntype = \"luminance\"\nposition = [0, 0, -5]\ndirection = [0, 0, 1]\n"
           "[sensors.o]\ntype = \"luminance\"\nposition = [0, 0, -5]\ndirection = [0.6, 0, 0.8]\n";
}

std::string box(const std::string& name, double size, double from, double to, const std::string& material) {
    return fmt::format(
        "[objects.{}]\nshape = \"box\"\nmin = [{}, {}, {}]\nmax = [{}, {}, {}]\nmaterial = \"{}\"\n", name,
        -size, -size, from, size, size, to, material);
}

/// The same as a mesh; of its six faces, those in `turned` have their fronts inside.
std::string faces(const std::string& turned, double size, double from, double to) {
    const auto vertex = [&](int i) {
        const double x = (i & 3) == 0 || (i & 3) == 3 ? -size : size, y = (i & 3) < 2 ? -size : size;
        return fmt::format("[{}, {}, {}]", x, y, i < 4 ? from : to);
    };
    std::string text = "vertices = [";
    for (int i = 0; i < 8; ++i) text += (i > 0 ? ", " : "") + vertex(i);
    constexpr std::array<std::array<int, 4>, 6> corners{
        {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
    text += "]\nfaces = [";
    for (std::size_t f = 0; f < corners.size(); ++f) {
        const auto& [a, b, c, d] = corners[f];
        const bool is_turned = turned.find(static_cast<char>('0' + f)) != turned.npos;
        text += fmt::format("{}[{}, {}, {}, {}]", f > 0 ? ", " : "", is_turned ? d : a, is_turned ? c : b,
                            is_turned ? b : c, is_turned ? a : d);
    }
    return text + "]\n";
}
std::string polygons(const std::string& name, const std::string& turned, double size, double from, double to,
                     const std::string& material) {
    return fmt::format("[objects.{}]\nshape = \"polygons\"\n{}material = \"{}\"\n", name,
                       faces(turned, size, from, to), material);
}

double ratio_of_face(double n_from, double n_to) {
    const double r = (n_from - n_to) / (n_from + n_to);
    return r * r / (1 - r * r);
}
double transmittance(double sum_of_ratios) { return 1 / (1 + sum_of_ratios); }

struct Seen {
    statistics::Estimate normal, oblique;
    std::vector<std::string> warnings;  ///< of glass
};

void expect_near(const statistics::Estimate& estimate, double exact, const std::string& what = "") {
    EXPECT_NEAR(estimate.value, exact, 4 * estimate.standard_error + 0.05) << what;
    EXPECT_LT(estimate.standard_error, 0.003 * exact) << what;
}

Seen seen(const std::string& glass, const std::string& method = "auto") {
    const io::SceneFile file = io::read_scene(scene(glass), "s.toml", "");
    RunOptions options;
    options.method = method;
    options.paths = 16384;
    if (method == "ray-bundle") options.patch_m = 100;
    const RunResult result = run::measure(file.scene, file.sensors, options);
    Seen seen{result.sensors[0].readings[0].estimate, result.sensors[1].readings[0].estimate, {}};
    std::ranges::copy_if(
        texts_of(file.warnings), std::back_inserter(seen.warnings),
        [](const std::string& warning) { return warning.find("\"glass\"") != warning.npos; });
    return seen;
}

/// Of the second sensor, at the cosine 0.8, by Fresnel's equations for unpolarised light at each face.
double oblique_slab() {
    const double c = 0.8, n = 1.5, inside = std::sqrt(1 - (1 - c * c) / (n * n));
    const double s = (c - n * inside) / (c + n * inside), p = (n * c - inside) / (n * c + inside);
    const double r = (s * s + p * p) / 2;
    return kLamp_cd_m2 * (1 - r) / (1 + r);
}

const double kSlab = kLamp_cd_m2 * transmittance(2 * ratio_of_face(1, 1.5));

TEST(GlassBodies, LayersAddUp) {
    // 1 | 1.5 | 1.333 | 1.5 | 1
    const double exact =
        kLamp_cd_m2 * transmittance(2 * ratio_of_face(1, 1.5) + 2 * ratio_of_face(1.5, 1.333));
    EXPECT_NEAR(exact, 917.2, 0.05);
    const std::string outer = box("a", 50, 0, 1, "g"), inner = box("b", 49, 0.3, 0.6, "w");
    for (const char* method : {"auto", "path", "double-local", "ray-bundle"}) {
        expect_near(seen(outer + inner, method).normal, exact, method);
    }
    expect_near(seen(inner + outer).normal, exact);
    expect_near(seen(outer + polygons("b", "012345", 49, 0.3, 0.6, "w")).normal, exact);
    // Three media, one in another: 1 | 1.5 | 1.333 | 1.5 | 1.333 | 1.5 | 1.
    const double three =
        kLamp_cd_m2 * transmittance(2 * ratio_of_face(1, 1.5) + 4 * ratio_of_face(1.5, 1.333));
    expect_near(seen(box("c", 48, 0.4, 0.5, "g") + outer + inner).normal, three);
    EXPECT_TRUE(seen(outer + inner).warnings.empty());
}

TEST(GlassBodies, FrontsOfClosedSurfacesNeedNotBeOutside) {
    const Seen box_itself = seen(box("a", 50, 0, 1, "g"));
    expect_near(box_itself.normal, kSlab);
    for (const char* turned : {"", "012345", "1", "03", "2345"}) {
        const Seen mesh = seen(polygons("a", turned, 50, 0, 1, "g"));
        expect_near(mesh.normal, kSlab, turned);
        expect_near(mesh.oblique, oblique_slab(), turned);
        EXPECT_TRUE(mesh.warnings.empty()) << turned;
    }
}

/// A hollow body: two slabs of glass, whose fronts all lie in the air, or all in the glass.
TEST(GlassBodies, CavitiesStayHollow) {
    const double exact = kLamp_cd_m2 * transmittance(4 * ratio_of_face(1, 1.5));
    expect_near(seen(polygons("a", "", 50, 0, 1, "g") + polygons("b", "012345", 49, 0.3, 0.6, "g")).normal,
                exact);
    expect_near(seen(polygons("a", "012345", 50, 0, 1, "g") + polygons("b", "", 49, 0.3, 0.6, "g")).normal,
                exact);
    // With water in it, which does not touch the glass.
    const double with_water =
        kLamp_cd_m2 * transmittance(4 * ratio_of_face(1, 1.5) + 2 * ratio_of_face(1, 1.333));
    expect_near(seen(polygons("a", "", 50, 0, 1, "g") + polygons("b", "012345", 49, 0.3, 0.6, "g") +
                     box("c", 48, 0.4, 0.5, "w"))
                    .normal,
                with_water);
    // A body of air in glass, by its refractive index.
    const std::string air = "[materials.air]\ntype = \"glass\"\nior = 1\n";
    expect_near(seen(air + box("a", 50, 0, 1, "g") + box("b", 49, 0.3, 0.6, "air")).normal, exact);
    // Glass in glass of the same kind is not seen.
    expect_near(seen(box("a", 50, 0, 1, "g") + box("b", 49, 0.3, 0.6, "g")).normal, kSlab);
}

TEST(GlassBodies, FacesThatCloseNoBodyAreSheets) {
    const auto rectangle = [](const std::string& name, const std::string& corner, const std::string& u,
                              const std::string& v) {
        return fmt::format(
            "[objects.{}]\nshape = \"rectangle\"\ncorner = {}\nedge_u = {}\nedge_v = {}\nmaterial = "
            "\"g\"\n",
            name, corner, u, v);
    };
    const std::string up = rectangle("top", "[-50, -50, 1]", "[100, 0, 0]", "[0, 100, 0]"),
                      down = rectangle("bottom", "[-50, -50, 0]", "[100, 0, 0]", "[0, 100, 0]");
    const Seen sheet = seen(up);
    expect_near(sheet.normal, kSlab);
    ASSERT_EQ(sheet.warnings.size(), 1u);
    EXPECT_NE(sheet.warnings[0].find("object \"top\": the faces of type \"glass\" close no body"),
              std::string::npos);
    const std::string disk =
        "[objects.d]\nshape = \"disk\"\ncenter = [0, 0, 1]\nnormal = [0, 0, -1]\nradius = 50\n"
        "material = \"g\"\n";
    expect_near(seen(disk).normal, kSlab);
    // Six rectangles close one together, whatever their fronts are.
    const std::string closed = up + down + rectangle("a", "[-50, -50, 0]", "[100, 0, 0]", "[0, 0, 1]") +
                               rectangle("b", "[-50, 50, 0]", "[100, 0, 0]", "[0, 0, 1]") +
                               rectangle("c", "[-50, -50, 0]", "[0, 100, 0]", "[0, 0, 1]") +
                               rectangle("d", "[50, -50, 0]", "[0, 100, 0]", "[0, 0, 1]");
    const Seen body = seen(closed);
    expect_near(body.normal, kSlab);
    expect_near(body.oblique, oblique_slab());
    EXPECT_TRUE(body.warnings.empty());
}

/// A room of which one wall is glass is full of air; a slab with black edges is none.
TEST(GlassBodies, TheLargerPartOfAClosedSurfaceDecides) {
    const auto with_glass_faces = [](double least, double most, std::vector<std::size_t> glass_faces) {
        io::SceneFile file = io::read_scene(scene(polygons("room", "", 10, least, most, "k")), "s.toml", "");
        const auto object = std::ranges::find(file.scene.objects, "room", &Object::name);
        std::vector<MaterialId> materials(12, object->materials[0]);
        for (const std::size_t face : glass_faces)
            materials[2 * face] = materials[2 * face + 1] = MaterialId{0};
        object->materials = materials;
        return file;
    };
    const auto normal = [](const io::SceneFile& file) {
        RunOptions options;
        options.paths = 16384;
        return run::measure(file.scene, file.sensors, options).sensors[0].readings[0].estimate;
    };
    io::SceneFile room = with_glass_faces(-10, 1, {1});
    const std::vector<std::string> of_room = scene::settle_glass(room.scene);
    ASSERT_EQ(of_room.size(), 2u);
    EXPECT_NE(of_room[0].find("close no body"), std::string::npos);
    EXPECT_NE(of_room[1].find("object \"room\": only some faces of a closed surface"), std::string::npos);
    expect_near(normal(room), kSlab);
    io::SceneFile slab = with_glass_faces(0, 1, {0, 1});
    const std::vector<std::string> of_slab = scene::settle_glass(slab.scene);
    ASSERT_EQ(of_slab.size(), 1u);
    EXPECT_NE(of_slab[0].find("not all faces of a closed surface"), std::string::npos);
    expect_near(normal(slab), kSlab);
}

TEST(GlassBodies, ThatCutEachOtherAreNamed) {
    const Seen cut = seen(box("a", 50, 0, 1, "g") + box("b", 60, 0.5, 1.5, "w"));
    ASSERT_EQ(cut.warnings.size(), 1u);
    EXPECT_NE(cut.warnings[0].find("\"a and b\": these bodies of type \"glass\" cut"), std::string::npos);
}

}  // namespace
}  // namespace stilb
