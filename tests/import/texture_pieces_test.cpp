// Surfaces divided by their textures: no gaps, true means, limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "geometry/mesh_part.h"
#include "geometry/mesh_topology.h"
#include "io/import/imported_scene.h"
#include "materials/diffuse.h"
#include "support/closed_meshes.h"

namespace stilb::io {
namespace {

using Texel = std::array<std::uint8_t, 4>;

/// A texture whose texels are given by their column and row.
template <typename TexelAt>
TextureMap make_texture(int width, int height, const TexelAt& texel_at) {
    auto texture = std::make_shared<Texture>();
    texture->width = width, texture->height = height;
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) texture->texels.push_back(texel_at(column, row));
    return {std::move(texture)};
}

TextureMap chequers(int count, std::uint8_t dark, std::uint8_t bright) {
    return make_texture(count, count, [&](int column, int row) {
        const std::uint8_t value = (column + row) % 2 == 0 ? bright : dark;
        return Texel{value, value, value, 255};
    });
}

TextureMap noise(int size) {
    RandomPairs random(7);
    return make_texture(size, size, [&](int, int) {
        const auto value = static_cast<std::uint8_t>(255 * random.next());
        return Texel{value, static_cast<std::uint8_t>(value / 2), 20, 255};
    });
}

/// A box of which each face has the whole picture; two triangles to a face, which share no vertices with
/// others.
ImportedMesh textured_box(const Box& box) {
    const Mesh whole = triangulated(box);
    ImportedMesh imported;
    for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
        const auto first = static_cast<std::uint32_t>(imported.mesh.vertices.size());
        for (const std::uint32_t corner : whole.triangles[t])
            imported.mesh.vertices.push_back(whole.vertices[corner]);
        imported.mesh.triangles.push_back({first, first + 1, first + 2});
        // Triangles (0, 1, 2) and (0, 2, 3) of a square.
        imported.places.push_back(t % 2 == 0 ? FacePlace{{{0, 1}, {1, 1}, {1, 0}}}
                                             : FacePlace{{{0, 1}, {1, 0}, {0, 0}}});
    }
    return imported;
}

FaceTexture shown(const TextureMap& map, double least_alpha = 0) {
    return {{map, least_alpha}, [](const Rgb& colour) { return Material(Diffuse{colour}); }};
}

/// A scene in which objects of one material show a texture.
struct TexturedScene {
    Scene scene;
    SceneTextures textures;
    UniqueNames names;
    GroupedWarnings remarks, warnings;

    explicit TexturedScene(const FaceTexture& texture) {
        scene.materials.push_back({"paper", Diffuse{Rgb::grey(0.5)}});
        textures.of_material[MaterialId{0}] = texture;
    }
    void add(const ImportedMesh& mesh) {
        const ObjectId id{static_cast<std::uint32_t>(scene.objects.size())};
        scene.objects.push_back({"object " + std::to_string(index_of(id)), mesh.mesh, {MaterialId{0}}});
        if (!mesh.places.empty()) textures.places[id] = mesh.places;
    }
    void apply(const TextureLimits& limits = {}) {
        apply_textures(scene, textures, names, remarks, warnings, limits);
    }
    const Mesh& mesh(std::size_t object) const { return std::get<Mesh>(scene.objects[object].shape); }
    Rgb reflectance(std::size_t object, std::size_t triangle) const {
        const auto& materials = scene.objects[object].materials;
        return scene.material(materials[materials.size() == 1 ? 0 : triangle]).get_if<Diffuse>()->reflectance;
    }
    Rgb mean(std::size_t object) const {
        Rgb sum;
        for (std::size_t t = 0; t < mesh(object).triangles.size(); ++t)
            sum += geometry::triangle_area_m2(mesh(object), t) * reflectance(object, t);
        return sum * (1 / area_m2(scene.objects[object].shape));
    }
};

Rgb mean_of_texels(const TextureMap& map) {
    const std::array<double, 4> mean = mean_of(map, {}, Texels::colours);
    return {{mean[0], mean[1], mean[2]}};
}

constexpr Box kRoom{{0, 0, 0}, {4, 3, 2.5}};

TEST(TexturePieces, PatternsThatFitHaveTheirColoursExactly) {
    TexturedScene textured(shown(chequers(8, 60, 200)));
    textured.add(textured_box(kRoom));
    textured.apply();
    // Of each square half a texel, and where neighbours need it less.
    EXPECT_EQ(textured.scene.materials.size(), 2u);
    EXPECT_EQ(textured.scene.materials[0].name, "paper (texture 1)");
    EXPECT_EQ(textured.scene.materials[1].name, "paper (texture 2)");
    const double dark = textured.scene.materials[0].material.get_if<Diffuse>()->reflectance[0];
    EXPECT_NEAR(dark, linear_of_srgb(60), 1e-12);
    EXPECT_NEAR(textured.mean(0)[0], (linear_of_srgb(60) + linear_of_srgb(200)) / 2, 1e-12);
    EXPECT_TRUE(textured.warnings.list().empty());
}

TEST(TexturePieces, TheMeanIsThatOfThePicture) {
    constexpr double of_points = 2e-3;  // 64 points or more of each piece, of texels from 0 to 1
    for (const TextureMap& map : {chequers(10, 0, 255), noise(50)}) {
        TexturedScene textured(shown(map));
        textured.add(textured_box(kRoom));
        textured.apply();
        for (std::size_t b = 0; b < kBands; ++b)
            EXPECT_NEAR(textured.mean(0)[b], mean_of_texels(map)[b], of_points);
        EXPECT_NEAR(area_m2(textured.scene.objects[0].shape), 59, 1e-9);
        EXPECT_LE(textured.scene.materials.size(), 256u);
    }
}

TEST(TexturePieces, LargeAreasOfOneColourAreFewFaces) {
    // A dark line of three texels in 300.
    const TextureMap line = make_texture(300, 300, [](int column, int) {
        const std::uint8_t value = column >= 100 && column < 103 ? 0 : 255;
        return Texel{value, value, value, 255};
    });
    TexturedScene textured(shown(line));
    textured.add(textured_box(kRoom));
    textured.apply();
    EXPECT_NEAR(textured.mean(0)[0], 0.99, 2e-4);
    EXPECT_LT(textured.mesh(0).triangles.size(), 40'000u);
    EXPECT_TRUE(textured.warnings.list().empty());

    TexturedScene plain(shown(chequers(1, 100, 100)));
    plain.add(textured_box(kRoom));
    plain.apply();
    EXPECT_EQ(plain.mesh(0).triangles.size(), 12u);
    ASSERT_EQ(plain.scene.materials.size(), 1u);
    EXPECT_EQ(plain.scene.materials[0].name, "paper");
}

/// A room of six objects, one for each side; those of the list without texture.
void add_sides(TexturedScene& textured, std::initializer_list<std::size_t> plain) {
    const ImportedMesh box = textured_box(kRoom);
    for (std::size_t side = 0; side < 6; ++side) {
        const std::vector<std::uint32_t> both{static_cast<std::uint32_t>(2 * side),
                                              static_cast<std::uint32_t>(2 * side + 1)};
        ImportedMesh part{geometry::part_of(box.mesh, both), {}, {}};
        if (std::ranges::find(plain, side) == plain.end())
            part.places = {box.places[2 * side], box.places[2 * side + 1]};
        textured.add(part);
    }
}

TEST(TexturePieces, NoRayPassesBetweenThem) {
    TexturedScene textured(shown(noise(40)));
    add_sides(textured, {0, 3, 4});
    textured.apply();
    Mesh all;
    for (std::size_t i = 0; i < 6; ++i) {
        const auto first = static_cast<std::uint32_t>(all.vertices.size());
        const Mesh& side = textured.mesh(i);
        all.vertices.insert(all.vertices.end(), side.vertices.begin(), side.vertices.end());
        for (const auto& [a, b, c] : side.triangles)
            all.triangles.push_back({first + a, first + b, first + c});
    }
    const auto components = geometry::find_components(all);
    EXPECT_EQ(components.count(), 1u);
    EXPECT_EQ(components.total_open_edges(), 0u);
    EXPECT_EQ(components.turned_edges, 0u);
    for (const Queries queries : {Queries::single, Queries::packets})
        EXPECT_EQ(lost_rays(textured.scene, {2, 1.5, 1.25}, queries, 200'000, 1), 0u);
}

TEST(TexturePieces, TrianglesWithoutCoordinatesKeepTheirMaterial) {
    EXPECT_FALSE(has_place(no_place()));
    EXPECT_FALSE(has_place({{{0, 0}, {1e30, 0}, {0, 1}}}));
    TexturedScene textured(shown(noise(20)));
    ImportedMesh box = textured_box(kRoom);
    box.places[5] = no_place();
    textured.add(box);
    textured.apply();
    EXPECT_EQ(textured.scene.materials[0].name, "paper");
    const Object& object = textured.scene.objects[0];
    double plain_m2 = 0;
    for (std::size_t t = 0; t < object.materials.size(); ++t) {
        if (object.materials[t] == MaterialId{0}) plain_m2 += geometry::triangle_area_m2(textured.mesh(0), t);
    }
    EXPECT_NEAR(plain_m2, geometry::triangle_area_m2(box.mesh, 5), 1e-9);
}

TEST(TexturePieces, OtherObjectsStayAsTheyAre) {
    TexturedScene textured(shown(noise(20)));
    textured.add(textured_box(kRoom));
    const Mesh table = triangulated(Box{{1, 1, 0.7}, {2, 2, 0.8}});
    textured.add({table, {}, {}});
    textured.apply();
    EXPECT_EQ(textured.mesh(1).vertices, table.vertices);
    EXPECT_EQ(textured.mesh(1).triangles, table.triangles);
    EXPECT_EQ(textured.reflectance(1, 0), Rgb::grey(0.5));
}

TEST(TexturePieces, LimitsAreKeptAndSaid) {
    TexturedScene textured(shown(noise(200)));
    textured.add(textured_box(kRoom));
    textured.apply({.faces_of_material = 5000, .faces = 100'000, .colours_of_material = 16, .colours = 100});
    EXPECT_GT(textured.mesh(0).triangles.size(), 4500u);
    EXPECT_LT(textured.mesh(0).triangles.size(), 5600u);
    EXPECT_EQ(textured.scene.materials.size(), 16u);
    ASSERT_EQ(textured.warnings.list().size(), 1u);
    const std::string warning = textured.warnings.list()[0];
    EXPECT_NE(warning.find("material paper: its texture is finer than the "), std::string::npos) << warning;
    EXPECT_NE(warning.find(" m have the mean colour of their part."), std::string::npos) << warning;
    for (std::size_t b = 0; b < kBands; ++b)
        EXPECT_NEAR(textured.mean(0)[b], mean_of_texels(noise(200))[b], 2e-3);
    // The faces of a scene are shared among its textures.
    TexturedScene shared(shown(noise(200)));
    shared.add(textured_box(kRoom));
    shared.apply({.faces_of_material = 5000, .faces = 1000, .colours_of_material = 16, .colours = 8});
    EXPECT_EQ(shared.scene.materials.size(), 8u);
    EXPECT_LT(shared.mesh(0).triangles.size(), 1200u);
}

TEST(TexturePieces, AlphaCutsHoles) {
    const TextureMap half = make_texture(8, 8, [](int column, int) {
        return Texel{200, 200, 200, static_cast<std::uint8_t>(column < 4 ? 100 : 0)};
    });
    TexturedScene textured(shown(half, 0.3));
    textured.add(textured_box(kRoom));
    textured.apply();
    EXPECT_NEAR(area_m2(textured.scene.objects[0].shape), 59.0 / 2, 1e-9);
    // Nothing is left of objects that are all hole.
    TexturedScene empty(shown(half, 0.5));
    empty.add(textured_box(kRoom));
    empty.apply();
    EXPECT_TRUE(empty.scene.objects.empty());
}

TEST(TexturePieces, SmoothSurfacesStaySmooth) {
    const Sphere sphere{{1, 2, 3}, 0.5};
    ImportedMesh ball{smooth_icosphere(sphere, 2), {}, {}};
    for (std::size_t t = 0; t < ball.mesh.triangles.size(); ++t)
        ball.places.push_back(FacePlace{{{0, 0}, {1, 0}, {0, 1}}});
    TexturedScene textured(shown(chequers(4, 60, 200)));
    textured.add(ball);
    textured.apply();
    TexturedScene plain(shown(chequers(4, 60, 200)));
    plain.add({ball.mesh, {}, {}});
    const rays::RayCaster coarse(plain.scene);
    ASSERT_GT(textured.mesh(0).triangles.size(), 4 * ball.mesh.triangles.size());
    const rays::RayCaster fine(textured.scene);
    RandomPairs random(5);
    for (int i = 0; i < 1000; ++i) {
        const auto [u1, u2] = random.next_pair();
        const Vec3 direction = math::sample_sphere(u1, u2).direction;
        const auto a = coarse.closest(sphere.center, direction), b = fine.closest(sphere.center, direction);
        ASSERT_TRUE(a && b);
        EXPECT_GT(dot(a->shading_normal, b->shading_normal), 1 - 1e-4);
    }
}

}  // namespace
}  // namespace stilb::io
