// Materials of Radiance against their definitions in its reference manual.
#include <cmath>

#include "materials/black.h"
#include "materials/dielectric.h"
#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/plastic.h"
#include "materials/thin_dielectric.h"
#include "materials/translucent.h"
#include "materials/ward.h"
#include "radiance_text.h"

namespace stilb::io {
namespace {

struct ReadMaterial {
    Material material;
    std::vector<std::string> warnings;
};
ReadMaterial read_radiance_material(const std::string& definition) {
    SceneFile file = read_rad(definition + "\nm sphere s 0 0 4 0 0 0 1\n");
    std::erase_if(file.warnings, is_of(WarningKind::no_light));
    return {file.scene.material(file.scene.objects.at(0).materials.at(0)), warnings_of(file)};
}
template <typename Model>
Model model_of(const std::string& definition) {
    return *read_radiance_material(definition).material.get_if<Model>();
}

void expect_bands(const Rgb& found, const Rgb& expected) {
    for (std::size_t b = 0; b < kBands; ++b) EXPECT_NEAR(found[b], expected[b], 1e-12);
}

TEST(RadianceMaterials, MattPlasticAndMetalAreDiffuse) {
    expect_bands(model_of<Diffuse>("void plastic m 0 0 5 .1 .2 .3 0 .2").reflectance, {{.1, .2, .3}});
    expect_bands(model_of<Diffuse>("void metal m 0 0 5 .1 .2 .3 0 0").reflectance, {{.1, .2, .3}});
    EXPECT_TRUE(read_radiance_material("void plastic m 0 0 5 0 0 0 0 0").material.is<Black>());
}

/// The isotropic lobe of Radiance's normal.c, for a specularity of 1.
double lobe_per_sr(double roughness, const Vec3& in, const Vec3& out) {
    const Vec3 half = in + out;
    const double along = half.z * half.z, all = squared_length(half), a2 = roughness * roughness;
    return std::exp(-(all - along) / along / a2) * all / (kPi * along * along * a2);
}

TEST(RadianceMaterials, RoughGlossHasWardsLobeAndTheRestIsDiffuse) {
    const Vec3 in = normalized(Vec3{0.3, 0.1, 1}), out = normalized(Vec3{-0.2, -0.3, 0.9});
    const double lobe = lobe_per_sr(.15, in, out);
    const ReadMaterial plastic = read_radiance_material("void plastic m 0 0 5 .5 .4 .3 .1 .15");
    const ReadMaterial metal = read_radiance_material("void metal m 0 0 5 .5 .4 .3 .1 .15");
    const Rgb of_plastic = materials::evaluate_brdf_per_sr(plastic.material, in, out);
    const Rgb of_metal = materials::evaluate_brdf_per_sr(metal.material, in, out);
    const Rgb color{{.5, .4, .3}};
    for (std::size_t b = 0; b < kBands; ++b) {
        EXPECT_NEAR(of_plastic[b], .9 * color[b] / kPi + .1 * lobe, 1e-12);
        EXPECT_NEAR(of_metal[b], .9 * color[b] / kPi + .1 * color[b] * lobe, 1e-12);
    }
    EXPECT_TRUE(plastic.warnings.empty());
}

TEST(RadianceMaterials, SmoothMetalIsAMirrorAndSmoothPlasticHasACoat) {
    expect_bands(model_of<materials::Mirror>("void metal m 0 0 5 .9 .8 .7 1 0").reflectance, {{.9, .8, .7}});
    const double s = 0.05, c = 0.5;
    const auto coated = model_of<Plastic>("void plastic m 0 0 5 .5 .5 .5 .05 0");
    const double ior = coated.parameters().ior;
    EXPECT_NEAR(std::pow((ior - 1) / (ior + 1), 2), s, 1e-12);
    // Radiance: the coat reflects s + (1 - s) f, f = exp(-5.85 cos) - 0.00203; the base reflects c of the
    // rest. Averages over the cosine-weighted hemisphere.
    const double k = 5.85, f = 2 * (1 - std::exp(-k) * (1 + k)) / (k * k) - 0.00202943064;
    const double coat = s + (1 - s) * f;
    EXPECT_NEAR(coated.mean_reflectance()[0], coat + (1 - coat) * c, 0.01);
    const ReadMaterial faint = read_radiance_material("void plastic m 0 0 5 .5 .5 .5 .01 0");
    EXPECT_NEAR(faint.material.get_if<materials::Ward>()->parameters().roughness[0], 0.001, 1e-15);
    EXPECT_TRUE(faint.warnings.empty());
}

TEST(RadianceMaterials, GlassHasTheTransmittanceAndReflectanceOfRadiance) {
    const auto pane = model_of<materials::ThinDielectric>("void glass m 0 0 3 .9 .8 .7");
    const auto other = model_of<materials::ThinDielectric>("void glass m 0 0 4 .9 .8 .7 1.7");
    EXPECT_EQ(pane.ior, 1.52);
    EXPECT_EQ(other.ior, 1.7);
    for (const double cosine : {1.0, 0.8, 0.4, 0.1}) {
        // glass.c of Radiance.
        const double n = 1.52, inside = std::sqrt(1 - 1 / (n * n) + cosine * cosine / (n * n));
        const double e = std::pow((cosine - n * inside) / (cosine + n * inside), 2);
        const double m = std::pow((1 / cosine - n / inside) / (1 / cosine + n / inside), 2);
        const double d = std::pow(.8, 1 / inside);
        const double transmitted = .5 * (1 - e) * (1 - e) * d / (1 - e * e * d * d) +
                                   .5 * (1 - m) * (1 - m) * d / (1 - m * m * d * d);
        const double reflected = .5 * e * (1 + (1 - 2 * e) * d * d) / (1 - e * e * d * d) +
                                 .5 * m * (1 + (1 - 2 * m) * d * d) / (1 - m * m * d * d);
        EXPECT_NEAR(pane.shares(cosine).transmittance[1], transmitted, 1e-12);
        EXPECT_NEAR(pane.shares(cosine).reflectance[1], reflected, 1e-12);
    }
}

TEST(RadianceMaterials, DielectricAndInterfaceAreGlass) {
    const ReadMaterial clear = read_radiance_material("void dielectric m 0 0 5 1 1 1 1.5 0");
    EXPECT_EQ(clear.material.get_if<materials::Dielectric>()->ior, 1.5);
    EXPECT_TRUE(clear.warnings.empty());
    const ReadMaterial tinted = read_radiance_material("void dielectric m 0 0 5 .9 1 0 1.5 2");
    EXPECT_EQ(tinted.warnings, (std::vector<std::string>{"dielectric m: its dispersion is left out."}));
    // The transmissivity holds for a unit of length, here a metre.
    expect_bands(tinted.material.get_if<materials::Dielectric>()->inside().left_after(2), {{.81, 1, 1e-12}});
    const auto interface = model_of<materials::Dielectric>("void interface m 0 0 8 1 1 1 1.5 .9 .8 .7 1.33");
    EXPECT_EQ(interface.ior, 1.5);
    EXPECT_EQ(interface.outside.ior, 1.33);
    expect_bands(interface.outside.left_after(1), {{.9, .8, .7}});
}

TEST(RadianceMaterials, MirrorsMayBeSeenAsAnotherMaterial) {
    expect_bands(model_of<materials::Mirror>("void mirror m 0 0 3 .9 .8 .7").reflectance, {{.9, .8, .7}});
    const std::string other = "void plastic wall 0 0 5 .5 .5 .5 0 0\nvoid mirror m 1 wall 0 3 .9 .8 .7";
    expect_bands(model_of<Diffuse>(other).reflectance, Rgb::grey(.5));
}

TEST(RadianceMaterials, TransIsTranslucent) {
    const auto paper = model_of<materials::Translucent>("void trans m 0 0 7 .5 .6 .7 0 0 .4 .25");
    const Rgb color{{.5, .6, .7}};
    expect_bands(paper.parameters().reflectance, .6 * color);
    expect_bands(paper.parameters().transmittance, .4 * .75 * color);
    expect_bands(paper.parameters().specular_transmittance, .4 * .25 * color);
    const ReadMaterial curtain = read_radiance_material("void trans m 0 0 7 .5 .5 .5 .1 .2 .4 .25");
    const auto rough = curtain.material.get_if<materials::Translucent>()->parameters();
    expect_bands(rough.reflectance, Rgb::grey(.5 * .9 * .6 + .1));
    expect_bands(rough.transmittance, Rgb::grey(.5 * .9 * .4));
    expect_bands(rough.specular_transmittance, {});
    EXPECT_EQ(
        curtain.warnings,
        (std::vector<std::string>{
            "trans m: its gloss, 10.0 % of the light, is reflected in all directions.",
            "trans m: the light that its roughness spreads a little, as it lets it through, goes in all "
            "directions."}));
    const auto veil = model_of<materials::Translucent>("void trans m 0 0 7 .5 .5 .5 0 0 1 1");
    expect_bands(veil.parameters().specular_transmittance, Rgb::grey(.5));
    expect_bands(veil.reflectance_bound(), Rgb::grey(.5));
    EXPECT_TRUE(read_radiance_material("void trans m 0 0 7 .5 .5 .5 0 0 0 0").warnings.empty());
}

TEST(RadianceMaterials, WhatIsNotSupportedIsNamedWithItsStandIn) {
    const ReadMaterial textured = read_radiance_material(
        "void texfunc waves 4 xwave ywave zwave w.cal 0 0\nwaves colorpict wood 7 red green blue w.hdr p.cal "
        "u v "
        "0 0\nwood plastic m 0 0 5 .5 .5 .5 0 0");
    EXPECT_EQ(textured.warnings,
              (std::vector<std::string>{
                  "colorpict wood: patterns of surfaces are not supported; their materials have their own "
                  "colours everywhere.",
                  "texfunc waves: textures are not supported; the surface is left as it is."}));
    const ReadMaterial mixed = read_radiance_material(
        "void plastic a 0 0 5 .2 .2 .2 0 0\nvoid plastic b 0 0 5 .4 .4 .4 0 0\nvoid mixfunc m 4 b a v m.cal "
        "0 0");
    expect_bands(mixed.material.get_if<Diffuse>()->reflectance, Rgb::grey(.4));
    EXPECT_EQ(mixed.warnings,
              (std::vector<std::string>{
                  "mixfunc m: mixtures are not supported; the first of both, b, stands for it."}));
    EXPECT_EQ(
        read_radiance_material("void BSDF m 6 0 x.xml 0 0 1 . 0 0").warnings,
        (std::vector<std::string>{"BSDF m: this type is not supported; a black surface stands for it."}));
    EXPECT_EQ(
        read_radiance_material("void plastic2 m 4 1 0 0 . 0 6 .5 .5 .5 .1 .1 .4").warnings,
        (std::vector<std::string>{"plastic2 m: a lobe that is the same in all directions, of the mean of "
                                  "both roughnesses, stands for it."}));
    EXPECT_EQ(read_radiance_material("void plastic m 0 0 5 1.2 .5 .5 0 0").warnings,
              (std::vector<std::string>{
                  "plastic m: the value 1.2 lies outside of 0 to 1, where energy is kept; 1 is used."}));
}

TEST(RadianceMaterials, EqualDefinitionsAreOneMaterial) {
    const SceneFile file = read_rad(
        "void plastic m 0 0 5 .5 .5 .5 0 0\nm sphere a 0 0 4 0 0 0 1\nvoid plastic m 0 0 5 .5 .5 .5 0 0\n"
        "m sphere b 0 0 4 3 0 0 1\nvoid plastic m 0 0 5 .6 .5 .5 0 0\nm sphere c 0 0 4 6 0 0 1\n");
    ASSERT_EQ(file.scene.materials.size(), 2u);
    EXPECT_EQ(file.scene.materials[1].name, "m_2");
}

}  // namespace
}  // namespace stilb::io
