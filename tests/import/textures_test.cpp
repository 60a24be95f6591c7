// Textures of glTF and OBJ as they are seen and measured.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "gltf_text.h"
#include "import_folder.h"
#include "io/import/obj/obj_scene.h"
#include "io/import/scene_folder.h"
#include "io/import/textures/texture_map.h"
#include "materials/diffuse.h"
#include "materials/plastic.h"
#include "materials/thin_dielectric.h"
#include "rays/ray_caster.h"

namespace stilb::io {
namespace {

using RgbTexel = std::array<std::uint8_t, 3>;
constexpr RgbTexel kDark{120, 60, 60}, kBright{250, 200, 100};

Rgb linear(const RgbTexel& texel) { return linear_rgb({texel[0], texel[1], texel[2], 255}); }

/// Chequers of count x count texels; the top left one is bright.
std::vector<RgbTexel> chequers(int count) {
    std::vector<RgbTexel> texels;
    for (int row = 0; row < count; ++row)
        for (int column = 0; column < count; ++column)
            texels.push_back((row + column) % 2 == 0 ? kBright : kDark);
    return texels;
}

const std::string kDiffuse = R"(, "extensions": {"KHR_materials_specular": {"specularFactor": 0}})";
const std::string kShow = "import.textures=true";

/// A square of 2 m x 2 m, seen from above with the picture's top at y = 1 and its left edge at x = -1.
/// `texture`: members of the texture's reference; `factors`: members of the material.
struct TexturedSquare {
    int count = 8;
    std::string texture = "", sampler = "", members = kDiffuse;
    std::vector<float> uv{0, 0, 0, 1, 1, 1, 1, 0};

    GltfText gltf() const {
        GltfText gltf;
        const bool has_sampler = !sampler.empty();
        gltf.add_texture(tga(count, count, chequers(count)), has_sampler ? R"(, "sampler": 0)" : "");
        if (has_sampler) gltf.samplers.push_back(sampler);
        gltf.add_material(fmt::format(
            R"("name": "tiles", "pbrMetallicRoughness": {{"metallicFactor": 0,
               "baseColorTexture": {{"index": 0{}}}}}{})",
            texture, members));
        const int coordinates = gltf.add_accessor(uv, 2, 5126);
        gltf.add_node(
            fmt::format(R"("name": "floor", "mesh": {})",
                        gltf.add_mesh(gltf_square(), 0, fmt::format(R"(, "TEXCOORD_0": {})", coordinates))));
        return gltf;
    }
    SceneFile read(std::vector<std::string> overrides = {kShow}) const {
        return read_gltf(gltf().text(), overrides);
    }
};

Rgb reflectance_of(const Material& material) { return material.get_if<Diffuse>()->reflectance; }

/// The reflectance of what lies below a point of the ground.
Rgb reflectance_at(const SceneFile& file, double x, double y) {
    const rays::RayCaster caster(file.scene);
    const auto hit = caster.closest({x, y, 1}, {0, 0, -1});
    return hit ? reflectance_of(file.scene.material(hit->material)) : Rgb::grey(-1);
}

void expect_near(const Rgb& found, const Rgb& expected, double tolerance = 1e-9) {
    for (std::size_t b = 0; b < kBands; ++b) EXPECT_NEAR(found[b], expected[b], tolerance);
}

/// The chequers of a square, count of them on each side, with the bright ones at the top left.
void expect_chequers(const SceneFile& file, int count) {
    for (int row = 0; row < count; ++row) {
        for (int column = 0; column < count; ++column) {
            const double size = 2.0 / count;
            const Rgb found = reflectance_at(file, -1 + (column + 0.5) * size, 1 - (row + 0.5) * size);
            expect_near(found, linear((row + column) % 2 == 0 ? kBright : kDark), 2e-3);
        }
    }
}

double area_of(const SceneFile& file) {
    double sum = 0;
    for (const Object& object : file.scene.objects) sum += area_m2(object.shape);
    return sum;
}

Rgb mean_reflectance(const SceneFile& file) {
    Rgb sum;
    for (const Object& object : file.scene.objects) {
        const auto& mesh = std::get<Mesh>(object.shape);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const MaterialId material = object.materials[object.materials.size() == 1 ? 0 : t];
            sum += geometry::triangle_area_m2(mesh, t) * reflectance_of(file.scene.material(material));
        }
    }
    return sum * (1 / area_of(file));
}

TEST(GltfTextures, CountByTheirMeansUnlessTheyAreShown) {
    const TexturedSquare square;
    const SceneFile mean = square.read({});
    ASSERT_EQ(mean.scene.materials.size(), 1u);
    constexpr double of_points = 5e-4;
    expect_near(reflectance_of(mean.scene.materials[0].material), 0.5 * (linear(kDark) + linear(kBright)),
                of_points);
    ASSERT_EQ(mean.notes.size(), 1u);
    EXPECT_EQ(
        mean.notes[0],
        "material tiles: the texture counts by its mean over the surface; import.textures=true shows it.");
    const SceneFile shown = square.read();
    expect_near(mean_reflectance(shown), 0.5 * (linear(kDark) + linear(kBright)));
    EXPECT_EQ(shown.scene.materials.size(), 2u);
    ASSERT_EQ(shown.notes.size(), 1u);
    EXPECT_EQ(shown.notes[0].substr(0, 32), "material tiles: its texture is 1");
    EXPECT_NE(shown.notes[0].find(" faces of 2 colours."), std::string::npos) << shown.notes[0];
}

TEST(GltfTextures, EachSquareHasItsColour) {
    expect_chequers(TexturedSquare{}.read(), 8);
    expect_chequers(TexturedSquare{.count = 5}.read(), 5);  // whose edges fit no halves
    // Half of the picture's size, in the middle of the square; what repeats around it goes on.
    TexturedSquare large;
    large.uv = {-0.5f, -0.5f, -0.5f, 1.5f, 1.5f, 1.5f, 1.5f, -0.5f};
    expect_chequers(large.read(), 16);
}

TEST(GltfTextures, RepeatAsTheirSamplersSay) {
    TexturedSquare square{.count = 3};
    square.uv = {0, 0, 0, 2, 2, 2, 2, 0};  // twice in each direction: six squares of a third of a metre
    const auto at = [&](const std::string& sampler, int column) {
        square.sampler = sampler;
        const Rgb found = reflectance_at(square.read(), -1 + (column + 0.5) / 3, 1 - 0.5 / 3);
        return std::abs(found[0] - linear(kBright)[0]) < 2e-3 ? 'b' : 'd';
    };
    const auto row = [&](const std::string& sampler) {
        std::string colours;
        for (int column = 0; column < 6; ++column) colours += at(sampler, column);
        return colours;
    };
    EXPECT_EQ(row(""), "bdbbdb");
    EXPECT_EQ(row(R"({"wrapS": 33648, "wrapT": 33648})"), "bdbbdb");
    EXPECT_EQ(row(R"({"wrapS": 33071, "wrapT": 33071})"), "bdbbbb");
    square.count = 2, square.uv = {0, 0, 0, 3, 3, 3, 3, 0};  // six squares again
    EXPECT_EQ(row(""), "bdbdbd");
    EXPECT_EQ(row(R"({"wrapS": 33648, "wrapT": 33648})"), "bddbbd");
}

TEST(GltfTextures, AreTransformed) {
    TexturedSquare square;
    square.texture =
        R"(, "extensions": {"KHR_texture_transform": {"scale": [0.5, 0.5], "offset": [0.125, 0]}})";
    const SceneFile file = square.read();  // four squares, moved by one to the left
    expect_near(reflectance_at(file, -0.75, 0.75), linear(kDark));
    expect_near(reflectance_at(file, -0.25, 0.75), linear(kBright));
    expect_near(reflectance_at(file, -0.25, 0.25), linear(kDark));
}

TEST(GltfTextures, FactorsAndCoatsStay) {
    TexturedSquare square;
    square.members = "";
    const SceneFile coated = square.read();
    ASSERT_EQ(coated.scene.materials.size(), 2u);
    const double coat = Plastic({Rgb{}, 1.5, 1}).mean_reflectance().luminance();
    for (std::size_t m = 0; m < 2; ++m) {
        const auto& plastic = *coated.scene.materials[m].material.get_if<Plastic>();
        expect_near(plastic.mean_reflectance(),
                    Rgb::grey(coat) + (1 - coat) * linear(m == 0 ? kDark : kBright), 1e-6);
    }
    square.members = kDiffuse;
    GltfText tinted = square.gltf();
    const std::size_t metallic = tinted.materials[0].find("\"metallicFactor\"");
    tinted.materials[0].insert(metallic, R"("baseColorFactor": [0.5, 0.25, 1, 1], )");
    const SceneFile file = read_gltf(tinted.text(), {kShow});
    expect_near(reflectance_at(file, -0.875, 0.875), linear(kBright) * Rgb{{0.5, 0.25, 1}});
}

TEST(GltfTextures, OfLampsAndPanesCountByTheirMeans) {
    TexturedSquare square;
    square.members = R"(, "emissiveFactor": [1, 1, 1],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 500}})";
    const SceneFile lamp = square.read();
    EXPECT_EQ(lamp.scene.objects.size(), 1u);
    EXPECT_EQ(lamp.scene.materials.size(), 1u);
    ASSERT_EQ(lamp.warnings.size(), 1u);
    EXPECT_EQ(lamp.warnings[0],
              "s.gltf: material tiles: it shines or is transparent: its texture counts by its mean.");
}

TEST(GltfTextures, AlphaCutsHoles) {
    std::vector<std::array<std::uint8_t, 4>> texels;
    for (int i = 0; i < 16; ++i)
        texels.push_back({200, 200, 200, static_cast<std::uint8_t>(i % 4 == 0 ? 90 : 255)});
    TexturedSquare square;
    square.members = kDiffuse + R"(, "alphaMode": "MASK")";
    GltfText gltf = square.gltf();
    const int texture = gltf.add_texture(tga_of(4, 4, texels));
    std::string& material = gltf.materials[0];
    material.replace(material.find("\"index\": 0"), 10, fmt::format("\"index\": {}", texture));
    const SceneFile file = read_gltf(gltf.text(), {kShow});
    EXPECT_NEAR(area_of(file), 3, 1e-9);
    EXPECT_EQ(reflectance_at(file, -0.75, 0.1), Rgb::grey(-1));
    expect_near(reflectance_at(file, -0.25, 0.1), Rgb::grey(linear_of_srgb(200)));
}

// Holes without textures

/// A square of 4 m2 with this share of holes, in squares of one texel of 64 x 64 spread over it. The texels
/// of holes are black, the others white.
struct HolesSquare {
    double share = 0.45;
    std::string alpha_mode = "MASK", more = "";

    std::vector<std::array<std::uint8_t, 4>> texels() const {
        std::vector<std::array<std::uint8_t, 4>> texels;
        double owed = 0;
        for (int i = 0; i < 64 * 64; ++i) {
            owed += share;
            const bool is_hole = owed >= 1;
            if (is_hole) owed -= 1;
            texels.push_back(is_hole ? std::array<std::uint8_t, 4>{0, 0, 0, 0}
                                     : std::array<std::uint8_t, 4>{255, 255, 255, 255});
        }
        return texels;
    }
    GltfText gltf() const {
        TexturedSquare square;
        square.members =
            fmt::format(R"({}, "alphaMode": "{}", "doubleSided": true{})", kDiffuse, alpha_mode, more);
        GltfText gltf = square.gltf();
        const int texture = gltf.add_texture(tga_of(64, 64, texels()));
        std::string& material = gltf.materials[0];
        material.replace(material.find("\"index\": 0"), 10, fmt::format("\"index\": {}", texture));
        return gltf;
    }
};

TEST(GltfTextures, HolesAreCutByTheirCoverage) {
    for (const double share : {0.02, 0.45, 0.55, 0.98}) {
        for (const std::string mode : {"MASK", "BLEND"}) {
            const SceneFile file = read_gltf(HolesSquare{share, mode}.gltf().text());
            EXPECT_NEAR(area_of(file), 4 * (1 - share), 0.004) << share;
            ASSERT_EQ(file.scene.materials.size(), 1u);
            expect_near(reflectance_of(file.scene.materials[0].material), Rgb::grey(1));  // not of the holes
        }
    }
}

TEST(GltfTextures, HolesOfRepeatedMeshesAreCut) {
    GltfText gltf = HolesSquare{}.gltf();
    gltf.add_node(R"("mesh": 0, "translation": [5, 0, 0])");
    EXPECT_NEAR(area_of(read_gltf(gltf.text())), 2 * 4 * 0.55, 0.008);
}

TEST(GltfTextures, LampsWithHolesShineWhereTheyAreNot) {
    HolesSquare square;
    square.more = R"(, "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 1})";
    GltfText gltf = square.gltf();
    const SceneFile file = read_gltf(gltf.text());
    // A double-sided open surface: a front and a back.
    ASSERT_EQ(file.scene.lights.size(), 2u);
    const double flux_lm = scene::flux_lm(file.scene, file.scene.lights[0]).luminance();
    EXPECT_NEAR(flux_lm, kPi * 4 * 0.55, 0.02);
}

TEST(GltfTextures, SurfacesOfHolesAloneAreLeftOut) {
    GltfText gltf = HolesSquare{1}.gltf();
    gltf.add_node(fmt::format(R"("mesh": {})", gltf.add_mesh(gltf_square(), -1)));
    const SceneFile file = read_gltf(gltf.text());
    EXPECT_NEAR(area_of(file), 4, 1e-9);
    EXPECT_EQ(file.scene.objects.size(), 1u);
}

/// A sun of 1000 lx from straight above.
void add_sun(GltfText& gltf) {
    gltf.extensions = R"("KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 1000}]})";
    gltf.add_node(R"("rotation": [-0.70710678, 0, 0, 0.70710678],
                     "extensions": {"KHR_lights_punctual": {"light": 0}})");
}

const std::string kLooks =
    "sensors.look={type=\"luminance\", direction=[0, 0, -1], "
    "positions=[[-0.875, 0.875, 1], [-0.625, 0.875, 1], [0.125, -0.125, 1]]}";

TEST_F(ImportFolderTest, TexturesAreMeasured) {
    GltfText gltf = TexturedSquare{}.gltf();
    add_sun(gltf);
    const SceneFile file = read_gltf(gltf.text(), {kShow, kLooks});
    const auto readings = readings_of(file);
    ASSERT_EQ(readings.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& estimate = readings[i].estimate;
        // In E / pi; the sun is a square of half a degree.
        const double expected = 1000 / kPi * linear(i == 1 ? kDark : kBright).luminance();
        EXPECT_NEAR(estimate.value, expected, std::max(estimate.upper - estimate.lower, 1e-4 * expected));
    }
    const auto files = write_scene_folder(read_gltf(gltf.text(), {kShow}), folder / "out");
    const SceneFile read = read_scene_file(files.front(), std::vector<std::string>{kLooks});
    EXPECT_EQ(read.scene.materials.size(), 2u);
    expect_same_readings(file, read);
}

// OBJ: the same square in its x-y plane.
constexpr std::string_view kSquareObj =
    "mtllib tiles.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl tiles\nf 1/1 2/2 3/3 4/4\n";

TEST_F(ImportFolderTest, TexturesOfObj) {
    write("tiles.tga", tga(8, 8, chequers(8)));
    const std::vector<std::string> plain{"import.scale=1", "import.up=z"};
    std::vector<std::string> show = plain;
    show.push_back(kShow);
    const auto path = write("square.obj", std::string(kSquareObj));
    const auto read = [&](const std::string& mtl, const std::vector<std::string>& overrides) {
        write("tiles.mtl", "newmtl tiles\n" + mtl);
        return read_obj_scene(path, overrides);
    };
    expect_chequers(read("Kd 1 1 1\nmap_Kd tiles.tga\n", show), 8);
    expect_chequers(read("Kd 1 1 1\nmap_Kd -s 2 2 1 tiles.tga\n", show), 16);
    // Moved by one square to the left; Kd multiplies.
    const SceneFile moved = read("Kd 0.5 0.5 0.5\nmap_Kd -o 0.125 0 0 tiles.tga\n", show);
    expect_near(reflectance_at(moved, -0.875, 0.875), 0.5 * linear(kDark));
    // Beyond the picture's right edge, the colours of the edge go on.
    const SceneFile clamped = read("Kd 1 1 1\nmap_Kd -clamp on -o 0.5 0 tiles.tga\n", show);
    expect_near(reflectance_at(clamped, 0.3, 0.875), linear(kDark));
    expect_near(reflectance_at(clamped, 0.9, 0.875), linear(kDark));
    // Means: over the surface, which shows half of one square.
    const SceneFile mean = read("Kd 1 1 1\nmap_Kd -s 0.0625 0.0625 -o 0 0.9375 tiles.tga\n", plain);
    expect_near(reflectance_of(mean.scene.materials[0].material), linear(kBright));
    // A glossy surface is of one type, whatever the colour of its parts.
    const SceneFile glossy = read("Kd 1 1 1\nKs 0.5 0.5 0.5\nNs 50\nillum 2\nmap_Kd tiles.tga\n", show);
    ASSERT_EQ(glossy.scene.materials.size(), 2u);
    for (const NamedMaterial& material : glossy.scene.materials) EXPECT_TRUE(material.material.is<Plastic>());
    // The folder of import.
    const SceneFile file = read("Kd 1 1 1\nmap_Kd tiles.tga\n", show);
    const SceneFile again = read_scene_file(write_scene_folder(file, folder / "out").front());
    expect_chequers(again, 8);
}

/// Opacities are grey, or the alpha of their picture. Where they are nearly 0 or 1 they cut holes.
TEST_F(ImportFolderTest, OpacitiesOfObjCutHoles) {
    const HolesSquare holes;
    write("alpha.tga", tga_of(64, 64, holes.texels()));
    std::vector<std::array<std::uint8_t, 3>> grey;
    for (const auto& texel : holes.texels()) grey.push_back({texel[3], texel[3], texel[3]});
    write("grey.tga", tga(64, 64, grey));
    const auto path = write("square.obj", std::string(kSquareObj));
    for (const std::string picture : {"alpha.tga", "grey.tga"}) {
        write("tiles.mtl", "newmtl tiles\nKd 0.6 0.6 0.6\nmap_d " + picture + "\n");
        const SceneFile file =
            read_obj_scene(path, std::vector<std::string>{"import.scale=1", "import.up=z"});
        EXPECT_NEAR(area_of(file), 4 * 0.55, 0.004) << picture;
        expect_near(reflectance_of(file.scene.materials.at(0).material), Rgb::grey(0.6));
    }
    // A veil is a pane.
    write("veil.tga", tga(1, 1, {{51, 51, 51}}));
    write("tiles.mtl", "newmtl tiles\nKd 0.6 0.6 0.6\nmap_d veil.tga\n");
    const SceneFile veil = read_obj_scene(path, std::vector<std::string>{"import.scale=1", "import.up=z"});
    const auto& pane = *veil.scene.materials.at(0).material.get_if<ThinDielectric>();
    EXPECT_NEAR(pane.internal_transmittance[0], 0.8, 1e-9);
}

TEST_F(ImportFolderTest, MissingPicturesOfObjAreOfMediumReflectance) {
    write("tiles.mtl", "newmtl tiles\nKd 1 1 0.5\nmap_Kd nowhere.png\n");
    const auto path = write("square.obj", std::string(kSquareObj));
    const SceneFile file = read_obj_scene(path, std::vector<std::string>{"import.scale=1", "import.up=z"});
    expect_near(reflectance_of(file.scene.materials.at(0).material), {{0.5, 0.5, 0.25}});
}

/// Names in quotes, with backslashes, in Latin-1, and of another computer.
TEST_F(ImportFolderTest, FilesOfObjAreFoundBesideIt) {
    const std::vector<std::string> plain{"import.scale=1", "import.up=z"};
    write("my tiles.mtl", "newmtl tiles\nKd 0.25 0.25 0.25\n");
    write(
        "K\xc3\xbc"
        "che.mtl",
        "newmtl tiles\nKd 0.125 0.125 0.125\n");
    const std::string rest(kSquareObj.substr(kSquareObj.find('\n') + 1));
    const auto reflectance = [&](const std::string& statement) {
        const SceneFile file =
            read_obj_scene(write("square.obj", "mtllib " + statement + "\n" + rest), plain);
        return reflectance_of(file.scene.materials.at(0).material)[0];
    };
    for (const std::string name : {"my tiles.mtl", "\"my tiles.mtl\"", "my\\ tiles.mtl", ".\\my tiles.mtl",
                                   "C:\\models\\my tiles.mtl"})
        EXPECT_NEAR(reflectance(name), 0.25, 1e-9) << name;
    EXPECT_NEAR(reflectance("K\xfc"
                            "che.mtl"),
                0.125, 1e-9);
    EXPECT_NEAR(reflectance("nowhere.mtl"), 0.5, 1e-9);
}

TEST_F(ImportFolderTest, NamesOfObjAreUtf8) {
    write("tiles.mtl", "newmtl W\xe4nde\nKd 0.25 0.25 0.25\n");
    std::string text(kSquareObj);
    text.replace(text.find("usemtl tiles"), 12,
                 "g K\xfc"
                 "che\nusemtl W\xe4nde");
    const SceneFile file =
        read_obj_scene(write("square.obj", text), std::vector<std::string>{"import.scale=1", "import.up=z"});
    EXPECT_EQ(file.scene.materials.at(0).name, "W\xc3\xa4nde");
    EXPECT_EQ(file.scene.objects.at(0).name,
              "K\xc3\xbc"
              "che");
    expect_near(reflectance_of(file.scene.materials[0].material), Rgb::grey(0.25));
}

TEST_F(ImportFolderTest, FacesWithoutCoordinatesKeepTheMean) {
    write("tiles.tga", tga(8, 8, chequers(8)));
    write("tiles.mtl", "newmtl tiles\nKd 1 1 1\nmap_Kd tiles.tga\n");
    const auto path = write("square.obj", std::string(kSquareObj) + "v 1 -1 0\nv 3 -1 0\nv 3 1 0\nf 5 6 7\n");
    const SceneFile file =
        read_obj_scene(path, std::vector<std::string>{"import.scale=1", "import.up=z", kShow});
    expect_chequers(file, 8);
    expect_near(reflectance_at(file, 2.5, -0.5), 0.5 * (linear(kDark) + linear(kBright)));
    ASSERT_EQ(file.scene.materials.size(), 3u);
    EXPECT_EQ(file.scene.materials[0].name, "tiles");
}

}  // namespace
}  // namespace stilb::io
