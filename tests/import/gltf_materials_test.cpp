// Materials, lights and textures of glTF.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gltf_text.h"
#include "io/import/coated_surface.h"
#include "io/photometry/photometry_file.h"
#include "lights/environment.h"
#include "materials/dielectric.h"
#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/plastic.h"
#include "materials/rough_conductor.h"
#include "materials/thin_dielectric.h"
#include "materials/ward.h"

namespace stilb::io {
namespace {

constexpr double kPerBand = 1e-6;  // of colours in JSON, rounding of sums

SceneFile read_material(const std::string& members, const std::string& extensions = "") {
    GltfText gltf;
    gltf.add_material(members + (extensions.empty() ? "" : ", \"extensions\": {" + extensions + "}"));
    gltf.add_node(fmt::format(R"("mesh": {})", gltf.add_mesh(gltf_square(), 0)));
    return read_gltf(gltf.text());
}

template <typename Model>
Model material_of(const SceneFile& file) {
    const auto* model = file.scene.materials.at(0).material.get_if<Model>();
    if (model == nullptr) throw std::runtime_error("another type of material");
    return *model;
}

bool warns_of(const SceneFile& file, std::string_view part) {
    for (const std::string& warning : texts_of(file.warnings))
        if (warning.find(part) != warning.npos) return true;
    return false;
}

void expect_rgb(const Rgb& found, const Rgb& expected) {
    for (std::size_t b = 0; b < kBands; ++b) EXPECT_NEAR(found[b], expected[b], kPerBand);
}

std::string pbr(const std::string& members) { return "\"pbrMetallicRoughness\": {" + members + "}"; }

TEST(GltfMaterials, DielectricsReflectTheirBaseColourUnderACoat) {
    const SceneFile file = read_material(
        pbr(R"("baseColorFactor": [0.5, 0.4, 0.3, 1], "metallicFactor": 0, "roughnessFactor": 0.5)"));
    const auto plastic = material_of<Plastic>(file);
    EXPECT_NEAR(plastic.parameters().ior, 1.5, 1e-9);
    EXPECT_NEAR(plastic.parameters().roughness, 0.25, 1e-9);
    // Under uniform light F + (1 - F) base, as glTF's mixture by Fresnel's reflectance has it.
    const double coat = Plastic({Rgb{}, 1.5, 0.25}).mean_reflectance().luminance();
    const Rgb base{{0.5, 0.4, 0.3}};
    for (std::size_t b = 0; b < kBands; ++b)
        EXPECT_NEAR(plastic.mean_reflectance()[b], coat + (1 - coat) * base[b], 1e-9);
}

TEST(GltfMaterials, MetalsBecomeRoughOrMirrors) {
    const auto rough = material_of<RoughConductor>(read_material(
        pbr(R"("baseColorFactor": [0.9, 0.8, 0.7, 1], "metallicFactor": 1, "roughnessFactor": 0.4)")));
    EXPECT_NEAR(rough.parameters().roughness, 0.16, 1e-9);
    expect_rgb(rough.parameters().reflectance, {{0.9, 0.8, 0.7}});
    const auto mirror = material_of<Mirror>(
        read_material(pbr(R"("baseColorFactor": [0.9, 0.9, 0.9, 1], "roughnessFactor": 0)")));
    expect_rgb(mirror.reflectance, Rgb::grey(0.9));
}

TEST(GltfMaterials, MixturesOfMetalKeepTheirLight) {
    const SceneFile file = read_material(
        pbr(R"("baseColorFactor": [0.5, 0.5, 0.5, 1], "metallicFactor": 0.5, "roughnessFactor": 0.3)"));
    const auto ward = material_of<Ward>(file);
    EXPECT_NEAR(ward.parameters().diffuse[0], 0.5 * 0.96 * 0.5, 1e-9);
    EXPECT_NEAR(ward.parameters().specular[0], 0.5 * 0.5 + 0.5 * 0.04, 1e-9);
    EXPECT_TRUE(warns_of(file, "a mixture of metal and no metal"));
}

TEST(GltfMaterials, WithoutHighlightsTheyAreDiffuse) {
    const auto diffuse = material_of<Diffuse>(
        read_material(pbr(R"("baseColorFactor": [0.5, 0.4, 0.3, 1], "metallicFactor": 0)"),
                      R"("KHR_materials_specular": {"specularFactor": 0})"));
    expect_rgb(diffuse.reflectance, {{0.5, 0.4, 0.3}});
}

TEST(GltfMaterials, IorAndSpecularSetTheCoat) {
    const auto ior = material_of<Plastic>(
        read_material(pbr(R"("metallicFactor": 0)"), R"("KHR_materials_ior": {"ior": 1.8})"));
    EXPECT_NEAR(ior.parameters().ior, 1.8, 1e-9);
    const auto half = material_of<Plastic>(
        read_material(pbr(R"("metallicFactor": 0)"), R"("KHR_materials_specular": {"specularFactor": 0.5})"));
    EXPECT_NEAR(normal_reflectance(half.parameters().ior), 0.02, 1e-9);
}

TEST(GltfMaterials, TransmissionMakesPanesAndSolids) {
    const std::string glass =
        pbr(R"("baseColorFactor": [1, 0.9, 0.8, 1], "metallicFactor": 0, "roughnessFactor": 0)");
    const auto pane = material_of<ThinDielectric>(
        read_material(glass, R"("KHR_materials_transmission": {"transmissionFactor": 1})"));
    // A surface of glTF reflects 0.04 and transmits the rest times its base colour.
    const auto shares = pane.shares(1);
    EXPECT_NEAR(shares.transmittance[0], 0.96, 1e-9);
    EXPECT_NEAR(shares.reflectance[0], 0.04, 1e-9);
    EXPECT_NEAR(shares.transmittance[1], 0.96 * 0.9, 1e-4);
    const SceneFile solid = read_material(
        glass, R"("KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1.6},
                  "KHR_materials_volume": {"thicknessFactor": 0.1})");
    EXPECT_NEAR(material_of<Dielectric>(solid).ior, 1.6, 1e-9);
    EXPECT_TRUE(warns_of(solid, "the base colour of the solid glass is left out"));
}

TEST(GltfMaterials, MetalsTransmitNoLight) {
    const auto read = [](double metallic) {
        return read_material(
            pbr(fmt::format(
                R"("baseColorFactor": [0.9, 0.8, 0.7, 1], "metallicFactor": {}, "roughnessFactor": 0.4)",
                metallic)),
            R"("KHR_materials_transmission": {"transmissionFactor": 1})");
    };
    EXPECT_NEAR(material_of<RoughConductor>(read(1)).parameters().reflectance[0], 0.9, 1e-9);
    EXPECT_TRUE(warns_of(read(1), "metals transmit no light"));
    EXPECT_NEAR(material_of<ThinDielectric>(read(0.25)).internal_transmittance[0], 0.75 * 0.9, 1e-9);
    EXPECT_FALSE(warns_of(read(0), "metals transmit no light"));
}

SceneFile read_specular_glossiness(const std::string& members) {
    return read_material(R"("name": "m")", R"("KHR_materials_pbrSpecularGlossiness": {)" + members + "}");
}

TEST(GltfMaterials, SpecularGlossinessIsADiffuseColourUnderACoat) {
    const SceneFile file = read_specular_glossiness(
        R"("diffuseFactor": [0.3, 0.3, 0.3, 1], "specularFactor": [0.04, 0.04, 0.04], "glossinessFactor": 0.5)");
    const auto plastic = material_of<Plastic>(file);
    EXPECT_NEAR(plastic.parameters().ior, 1.5, 1e-9);
    EXPECT_NEAR(plastic.parameters().roughness, 0.25, 1e-9);
    const double coat = Plastic({Rgb{}, 1.5, 0.25}).mean_reflectance().luminance();
    EXPECT_NEAR(plastic.mean_reflectance()[0], coat + (1 - coat) * 0.3, 1e-9);
    EXPECT_FALSE(warns_of(file, "extension"));
}

TEST(GltfMaterials, SpecularGlossinessWithoutDiffuseColourIsMetal) {
    const auto metal = material_of<RoughConductor>(read_specular_glossiness(
        R"("diffuseFactor": [0, 0, 0, 1], "specularFactor": [0.9, 0.7, 0.4], "glossinessFactor": 0.6)"));
    expect_rgb(metal.parameters().reflectance, {{0.9, 0.7, 0.4}});
    EXPECT_NEAR(metal.parameters().roughness, 0.16, 1e-9);
    // Plastic reaches to the reflectance of ior 4, 0.36; both sides of this border reflect alike.
    const auto below = material_of<Plastic>(read_specular_glossiness(
        R"("diffuseFactor": [0.5, 0.5, 0.5, 1], "specularFactor": [0.359, 0.359, 0.359], "glossinessFactor": 0.9)"));
    EXPECT_NEAR(below.mean_reflectance()[0], 0.36 + 0.64 * 0.5, 0.03);
    const auto above = material_of<RoughConductor>(read_specular_glossiness(
        R"("diffuseFactor": [0.5, 0.5, 0.5, 1], "specularFactor": [0.361, 0.361, 0.361], "glossinessFactor": 0.9)"));
    EXPECT_NEAR(above.parameters().reflectance[0], 0.361 + 0.639 * 0.5, 1e-9);
    // Without highlights.
    EXPECT_NEAR(
        material_of<Diffuse>(
            read_specular_glossiness(R"("diffuseFactor": [0.5, 0.5, 0.5, 1], "specularFactor": [0, 0, 0])"))
            .reflectance[0],
        0.5, 1e-9);
}

TEST(GltfMaterials, AlphaBlendedSheetsTransmitTheRest) {
    const SceneFile file = read_material(pbr(R"("baseColorFactor": [1, 1, 1, 0.25], "metallicFactor": 0)") +
                                         R"(, "alphaMode": "BLEND")");
    EXPECT_NEAR(material_of<ThinDielectric>(file).internal_transmittance[0], 0.75, 1e-9);
    EXPECT_TRUE(warns_of(file, "alphaMode BLEND becomes a clear pane"));
}

TEST(GltfMaterials, EmissiveSurfacesAreAreaLightsInNits) {
    const std::string material = R"("emissiveFactor": [1, 0.5, 0.25])";
    const SceneFile front =
        read_material(material, R"("KHR_materials_emissive_strength": {"emissiveStrength": 2000})");
    ASSERT_EQ(front.scene.lights.size(), 1u);
    const auto& area = std::get<AreaLight>(front.scene.lights[0].source);
    expect_rgb(area.luminance_cd_m2, {{2000, 1000, 500}});
    EXPECT_NEAR(scene::flux_lm(front.scene, front.scene.lights[0]).luminance(),
                kPi * 4 * area.luminance_cd_m2.luminance(), 1e-2);
    // Both sides of an open surface, the back as an object of its own behind it.
    const SceneFile both = read_material(material + R"(, "doubleSided": true)",
                                         R"("KHR_materials_emissive_strength": {"emissiveStrength": 2000})");
    ASSERT_EQ(both.scene.lights.size(), 2u);
    ASSERT_EQ(both.scene.objects.size(), 2u);
    const auto& back = std::get<Mesh>(both.scene.objects[1].shape);
    EXPECT_LT(back.vertices[0].z, -5e-5);
    EXPECT_GT(back.vertices[0].z, -2e-4);
    EXPECT_TRUE(warns_of(read_material(material), "has no KHR_materials_emissive_strength"));
}

TEST(GltfMaterials, NamesWhatItLeavesOut) {
    const SceneFile file =
        read_material(pbr(R"("metallicFactor": 0)"), R"("KHR_materials_clearcoat": {"clearcoatFactor": 1})");
    EXPECT_TRUE(warns_of(file, "its extension KHR_materials_clearcoat is left out"));
    GltfText gltf;
    gltf.add_material(pbr(R"("baseColorFactor": [2, 0, 0, 1])"));
    gltf.add_node(fmt::format(R"("mesh": {})", gltf.add_mesh(gltf_square(), 0)));
    EXPECT_EQ(gltf_refusal(gltf.text()), "s.gltf: materials[0]: baseColorFactor is 2. Allowed: from 0 to 1.");
}

SceneFile read_textured(const std::vector<float>& uv, const std::string& members) {
    GltfText gltf;
    gltf.add_texture(tga(2, 1, {{255, 255, 255}, {0, 0, 0}}));
    gltf.add_material(members);
    const int coordinates = gltf.add_accessor(uv, 2, 5126);
    gltf.add_node(fmt::format(
        R"("mesh": {})", gltf.add_mesh(gltf_square(), 0, fmt::format(R"(, "TEXCOORD_0": {})", coordinates))));
    return read_gltf(gltf.text());
}

TEST(GltfMaterials, TexturesCountByTheirMeanOverTheSurface) {
    const std::string material =
        pbr(R"("baseColorFactor": [0.8, 0.8, 0.8, 1], "baseColorTexture": {"index": 0}, "metallicFactor": 0)") +
        R"(, "extensions": {"KHR_materials_specular": {"specularFactor": 0}})";
    // 16384 points of the surface are looked up.
    constexpr double kOfPoints = 5e-4;
    const auto mean = [&](const std::vector<float>& uv) {
        return material_of<Diffuse>(read_textured(uv, material)).reflectance[0];
    };
    EXPECT_NEAR(mean({0, 0, 0, 1, 1, 1, 1, 0}), 0.4, kOfPoints);                // half of it is white
    EXPECT_NEAR(mean({0, 0, 0, 1, 0.75, 1, 0.75, 0}), 0.8 * 2 / 3, kOfPoints);  // two thirds
    EXPECT_NEAR(mean({0, 0, 0, 1, 0.4f, 1, 0.4f, 0}), 0.8, 1e-12);              // all of it
    EXPECT_NEAR(mean({0, 0, 0, 1, 2, 1, 2, 0}), 0.4, kOfPoints);                // repeated
}

/// A picture that cannot be read is no white surface.
TEST(GltfMaterials, UnreadableTexturesAreOfMediumReflectance) {
    GltfText gltf;
    gltf.add_texture("RIFF....WEBPVP8L");
    gltf.textures.push_back(R"({"extensions": {"KHR_texture_basisu": {"source": 0}}})");
    for (const int texture : {0, 1}) {
        gltf.add_material(
            pbr(fmt::format(R"("baseColorTexture": {{"index": {0}}}, "baseColorFactor": [1, 1, 0.6, 1],
                                              "metallicRoughnessTexture": {{"index": {0}}})",
                            texture)));
        gltf.add_node(fmt::format(R"("mesh": {})", gltf.add_mesh(gltf_square(), texture)));
    }
    const SceneFile file = read_gltf(gltf.text());
    ASSERT_EQ(file.scene.materials.size(), 2u);
    for (const NamedMaterial& material : file.scene.materials) {
        const auto& plastic = *material.material.get_if<Plastic>();  // no metal
        const double coat = Plastic({Rgb{}, 1.5, 1}).mean_reflectance().luminance();
        EXPECT_NEAR(plastic.mean_reflectance()[0], coat + (1 - coat) * 0.5, 1e-9);
        EXPECT_NEAR(plastic.mean_reflectance()[2], coat + (1 - coat) * 0.3, 1e-9);
    }
    EXPECT_TRUE(warns_of(file, "a colour counts as 0.5 times its factor"));
}

// Lights

SceneFile read_light(const std::string& light, const std::string& node = "") {
    GltfText gltf;
    gltf.add_node(fmt::format(R"("mesh": {})", gltf.add_mesh(gltf_square(), -1)));
    gltf.extensions = R"("KHR_lights_punctual": {"lights": [{)" + light + "}]}";
    gltf.add_node(R"("name": "lamp", "extensions": {"KHR_lights_punctual": {"light": 0}})" + node);
    return read_gltf(gltf.text());
}

TEST(GltfLights, PointsHaveTheirIntensityAndColour) {
    const SceneFile file = read_light(R"("type": "point", "intensity": 127, "color": [1, 0.5, 0.25])",
                                      R"(, "translation": [1, 2, 3])");
    ASSERT_EQ(file.scene.lights.size(), 1u);
    EXPECT_EQ(file.scene.lights[0].name, "lamp");
    const auto& point = std::get<PointLight>(file.scene.lights[0].source);
    expect_rgb(point.intensity_cd, {{127, 63.5, 31.75}});
    EXPECT_EQ(point.position, (Vec3{1, -3, 2}));
}

TEST(GltfLights, SpotsFallBetweenTheirCones) {
    const SceneFile file = read_light(
        R"("type": "spot", "intensity": 100, "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.6})");
    const auto& spot = std::get<Luminaire>(file.scene.lights.at(0).source);
    EXPECT_NEAR(spot.nadir.y, 1, 1e-12);  // -z of glTF
    const PhotometricSolid& solid = file.scene.solid(spot.solid);
    for (const double angle : {0.0, 0.15, 0.3, 0.45, 0.59, 0.7}) {
        const double share =
            std::clamp((std::cos(angle) - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6)), 0.0, 1.0);
        const double found =
            solid.intensity_cd({std::sin(angle), 0, std::cos(angle)}) * spot.factor.luminance();
        EXPECT_NEAR(found, 100 * share * share, 0.05) << angle;
    }
}

TEST(GltfLights, DirectionalOnesShineFromTheSky) {
    // From straight above: -z of the node points down.
    const SceneFile file = read_light(R"("type": "directional", "intensity": 1000)",
                                      R"(, "rotation": [-0.70710678, 0, 0, 0.70710678])");
    const auto& sky = std::get<EnvironmentLight>(file.scene.lights.at(0).source);
    EXPECT_NEAR(sky.panorama->total_lx().luminance(), 1000, 0.01);
    const Vec3 up = sky.axes.to_local({0, 0, 1});
    EXPECT_GT(sky.panorama->luminance_cd_m2(up).luminance(), 1e6);
    EXPECT_NEAR(sky.panorama->illuminance_lx(up).luminance(), 1000, 0.1);
}

TEST(GltfLights, ProfilesPointAlongMinusZOfTheirNode) {
    PhotometricSolid::Grid grid;
    grid.planes_deg = {0, 90, 180, 270, 360};
    grid.polar_deg = {0, 90};
    grid.intensity_cd = {100, 10, 100, 20, 100, 30, 100, 40, 100, 10};  // C0: 10 cd, C90: 20 cd ...
    const std::string ies = to_ies(grid, "profile");
    GltfText gltf;
    gltf.add_node(fmt::format(R"("mesh": {})", gltf.add_mesh(gltf_square(), -1)));
    const int view = gltf.add_view(ies.data(), ies.size());
    gltf.extensions = fmt::format(
        R"("EXT_lights_ies": {{"lights": [{{"bufferView": {}, "mimeType": "application/x-ies-lm-63"}}]}})",
        view);
    gltf.add_node(R"("extensions": {"EXT_lights_ies": {"light": 0, "multiplier": 2, "color": [1, 1, 0.5]}})");
    const SceneFile file = read_gltf(gltf.text());
    const auto& light = std::get<Luminaire>(file.scene.lights.at(0).source);
    const auto intensity = [&](const Vec3& gltf_direction) {
        const Vec3 world{gltf_direction.x, -gltf_direction.z, gltf_direction.y};
        return file.scene.solid(light.solid).intensity_cd(light.in_solid(world)) * light.factor[0];
    };
    EXPECT_NEAR(intensity({0, 0, -1}), 200, 1e-9);
    EXPECT_NEAR(intensity({1, 0, 0}), 20, 1e-6);
    EXPECT_NEAR(intensity({0, 1, 0}), 40, 1e-6);
    EXPECT_NEAR(intensity({-1, 0, 0}), 60, 1e-6);
    EXPECT_NEAR(light.factor[2], 1, 1e-12);
}

TEST(GltfLights, FaintLampsAreProbablyInWatts) {
    EXPECT_TRUE(warns_of(read_light(R"("type": "point", "intensity": 0.5)"), "import.light_scale=683"));
    EXPECT_FALSE(warns_of(read_light(R"("type": "point", "intensity": 50)"), "import.light_scale"));
}

}  // namespace
}  // namespace stilb::io
