// Scenes of Stilb that are exported to Radiance and read again.
#include "io/export/export.h"
#include "materials/diffuse.h"
#include "materials/thin_dielectric.h"
#include "materials/ward.h"
#include "radiance_text.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

constexpr const char* kRoundTripRoom = R"([materials.grey]
type = "diffuse"
reflectance = [0.5, 0.4, 0.3]
[materials.gloss]
type = "ward"
diffuse = 0.3
specular = 0.2
roughness = [0.1, 0.1]
[materials.pane]
type = "pane"
ior = 1.5
internal_transmittance = 0.9
[materials.black]
type = "black"
[objects.room]
shape = "box"
min = [0, 0, 0]
max = [4, 3, 2.5]
material = "grey"
[objects.ball]
shape = "sphere"
center = [1, 1, 0.5]
radius = 0.25
material = "gloss"
[objects.window]
shape = "rectangle"
corner = [1, 1, 1]
edge_u = [1, 0, 0]
edge_v = [0, 0, 1]
material = "pane"
[objects.panel]
shape = "rectangle"
corner = [1, 1, 2.4]
edge_u = [0, 1, 0]
edge_v = [1, 0, 0]
material = "black"
[lights.panel]
type = "area"
object = "panel"
flux = 3000
[lights.downlight]
type = "photometry"
file = "downlight.ies"
position = [3, 2, 2.4]
aim = [0.2, 0.1, -1]
spin = 20
[lights.spot]
type = "photometry"
file = "downlight.ies"
position = [3, 1, 2.4]
opening = "point"
)";

TEST(RadianceRoundTrip, KeepsAreasMaterialsAndFluxes) {
    const SceneFile original = read_scene(kRoundTripRoom, "room.toml", kRadianceData / "parts");
    const TestFolder folder;
    export_scene(original, ExportFormat::radiance, folder);
    const SceneFile again = read_radiance_scene(folder / "scene.rad");

    EXPECT_TRUE(again.warnings.empty());
    const auto flux_of = [](const SceneFile& file, std::string_view part) {
        for (const Light& light : file.scene.lights) {
            if (light.name.find(part) != light.name.npos)
                return scene::flux_lm(file.scene, light).luminance();
        }
        return 0.0;
    };
    EXPECT_NEAR(flux_of(again, "panel"), 3000, 1e-3);
    // The tables have steps of 2.5 degrees and 1 degree.
    EXPECT_NEAR(flux_of(again, "downlight"), flux_of(original, "downlight"),
                2e-3 * flux_of(original, "downlight"));
    EXPECT_NEAR(flux_of(again, "spot"), flux_of(original, "spot"), 1e-4 * flux_of(original, "spot"));
    const auto material = [&](std::string_view name) {
        return std::ranges::find(again.scene.materials, name, &NamedMaterial::name)->material;
    };
    EXPECT_NEAR(material("material_grey").get_if<Diffuse>()->reflectance[2], 0.3, 1e-9);
    const auto gloss = material("material_gloss").get_if<materials::Ward>()->parameters();
    EXPECT_NEAR(gloss.diffuse[0], 0.3, 1e-8);
    EXPECT_NEAR(gloss.specular[0], 0.2, 1e-9);
    EXPECT_NEAR(gloss.roughness[0], 0.1, 1e-9);
    EXPECT_NEAR(material("material_pane").get_if<materials::ThinDielectric>()->internal_transmittance[0], 0.9,
                1e-9);
    // The points of the export are spheres of a millimetre.
    EXPECT_NEAR(scene::surface_area_m2(again.scene), scene::surface_area_m2(original.scene), 1e-4);
}

}  // namespace
}  // namespace stilb::io
