#include "io/export/export.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/mesh/mesh_file.h"
#include "io/scene_text.h"
#include "io/text/text.h"
#include "stilb/error.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

constexpr const char* kExportedRoom = R"([materials.grey]
type = "diffuse"
reflectance = 0.5
[materials.black]
type = "black"
[materials.gloss]
type = "phong"
diffuse = 0.3
specular = 0.2
exponent = 50
[objects."two words"]
shape = "box"
min = [0, 0, 0]
max = [4, 3, 2.5]
material = "grey"
[objects.panel]
shape = "rectangle"
corner = [1, 1, 2.4]
edge_u = [0, 1, 0]
edge_v = [1, 0, 0]
material = "black"
[objects.ball]
shape = "sphere"
center = [1, 1, 0.5]
radius = 0.25
material = "gloss"
[objects.table]
shape = "polygons"
vertices = [[1, 1, 0.7], [2, 1, 0.7], [2, 2, 0.7]]
faces = [[0, 1, 2]]
material = "gloss"
[lights.panel]
type = "area"
object = "panel"
luminance = 1790
[lights.bulb]
type = "point"
position = [2, 1.5, 2]
intensity = 100
[sensors.desk]
type = "grid"
corner = [0, 0, 0.75]
edge_u = [2, 0, 0]
edge_v = [0, 1, 0]
count = [2, 1]
[sensors.column]
type = "cylindrical"
position = [1, 1, 1]
[sensors.view]
type = "camera"
position = [0.1, 0.1, 1.6]
target = [2, 2, 1]
fov = 70
resolution = [64, 48]
)";

class Export : public testing::Test {
  protected:
    std::string content(const std::string& name) const { return read_whole_file(folder_ / name); }
    ExportReport write(ExportFormat format) const {
        return export_scene(read_scene_text(kExportedRoom), format, folder_);
    }

    const TestFolder folder_;
};

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

TEST_F(Export, MeshesKeepTheirTriangles) {
    write(ExportFormat::mitsuba);
    const Mesh room = read_mesh_file(folder_ / "two_words.ply").mesh;
    EXPECT_NEAR(geometry::area_m2(room), 2 * (4 * 3 + 4 * 2.5 + 3 * 2.5), 1e-5);
    EXPECT_EQ(read_mesh_file(folder_ / "table.ply").mesh.triangles.size(), 1u);
}

TEST_F(Export, RadianceGetsRadiances) {
    write(ExportFormat::radiance);
    const std::string scene = content("scene.rad");
    EXPECT_TRUE(contains(scene, "void light light_panel\n0\n0\n3 10 10 10\n")) << "1790 cd/m2 / 179 lm/W";
    EXPECT_TRUE(contains(scene, "material_grey polygon two_words.0\n"));
    EXPECT_TRUE(contains(scene, "material_gloss sphere ball\n0\n0\n4 1 1 0.5 0.25\n"));
    // The radiance of a sphere of 1 mm: I / (pi r^2) / 179.
    EXPECT_TRUE(contains(scene, "void light light_bulb\n0\n0\n3 177826.7"));
    EXPECT_TRUE(contains(content("view.vf"), "rvu -vtv -vp 0.1 0.1 1.6"));
}

TEST_F(Export, MitsubaGetsLuminances) {
    write(ExportFormat::mitsuba);
    const std::string scene = content("scene.xml");
    EXPECT_TRUE(contains(scene, "<rgb name=\"radiance\" value=\"1790 1790 1790\"/>"));
    EXPECT_TRUE(contains(scene, "<rgb name=\"intensity\" value=\"100 100 100\"/>"));
    EXPECT_TRUE(contains(scene, "<bsdf type=\"stilb_phong\">"));
    EXPECT_TRUE(contains(content("stilb_plugins.py"), "mi.register_bsdf(\"stilb_phong\""));
}

TEST_F(Export, MaterialsWithABackAreTwo) {
    const std::string scene =
        std::string(kExportedRoom) +
        "[materials.sides]\ntype = \"diffuse\"\nreflectance = 0.2\n"
        "back = { type = \"black\" }\n[objects.wall]\nshape = \"rectangle\"\ncorner = [2, 0, 0]\n"
        "edge_u = [0, 1, 0]\nedge_v = [0, 0, 1]\nmaterial = \"sides\"\n";
    export_scene(read_scene_text(scene), ExportFormat::mitsuba, folder_);
    const std::string mitsuba = content("scene.xml");
    EXPECT_TRUE(contains(mitsuba,
                         "<bsdf type=\"twosided\" id=\"material_sides_sides\">\n    <ref "
                         "id=\"material_sides\"/>\n    <ref id=\"material_sides__back_\"/>\n  </bsdf>"));
    EXPECT_TRUE(contains(mitsuba, "<ref id=\"material_sides_sides\"/>\n  </shape>")) << mitsuba;
    export_scene(read_scene_text(scene), ExportFormat::radiance, folder_);
    const std::string radiance = content("scene.rad");
    EXPECT_TRUE(contains(radiance,
                         "void mixfunc material_sides_sides\n4 material_sides material_sides__back_ "
                         "if(Rdot,1,0) .\n0\n0\n"));
    EXPECT_TRUE(contains(radiance, "material_sides_sides polygon wall"));
}

TEST_F(Export, GlazingIsAPaneThatTransmitsAsMuch) {
    const auto scene = [](const std::string& keys) {
        return std::string(kExportedRoom) + "[materials.window]\ntype = \"glazing\"\n" + keys +
               "\n[objects.window]\nshape = \"rectangle\"\ncorner = [2, 0, 0]\nedge_u = [0, 1, 0]\n"
               "edge_v = [0, 0, 1]\nmaterial = \"window\"\n";
    };
    const auto warnings = [&](const std::string& keys) {
        const auto report = export_scene(read_scene_text(scene(keys)), ExportFormat::radiance, folder_);
        return std::ranges::count_if(
            report.warnings, [](const std::string& text) { return text.starts_with("material window"); });
    };
    EXPECT_EQ(warnings("visible_transmittance = 0.7"), 0);
    const std::string clear = content("scene.rad");
    // 0.7 along the normal is the transmissivity 0.763 of Radiance.
    EXPECT_TRUE(contains(clear, "void glass material_window\n0\n0\n4 0.76284")) << clear;
    EXPECT_EQ(warnings("transmittance = 0.7\nreflectance = 0.2"), 1);
    EXPECT_EQ(content("scene.rad"), clear) << "the same pane";
}

TEST_F(Export, PointsHavePositionAndNormal) {
    write(ExportFormat::radiance);
    EXPECT_EQ(content("desk.pts"), "0.5 0.5 0.75 0 0 1\n1.5 0.5 0.75 0 0 1\n");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "column.pts"));
}

TEST_F(Export, WarningsNameWhatHasNoEqual) {
    const ExportReport report = write(ExportFormat::radiance);
    ASSERT_EQ(report.warnings.size(), 2u);
    EXPECT_TRUE(report.warnings[0].starts_with("material gloss: Radiance has no Phong model."));
    EXPECT_TRUE(report.warnings[1].starts_with("sensor column: cylindrical sensors"));
    for (const auto& file : report.files) EXPECT_TRUE(std::filesystem::exists(file)) << file;
}

TEST_F(Export, RefusesTheFolderOfTheScene) {
    const std::filesystem::path scene = folder_ / "scene.toml";
    std::ofstream(scene) << kExportedRoom;
    EXPECT_THROW(export_scene(read_scene_file(scene), ExportFormat::mitsuba, folder_), InputError);
}

TEST_F(Export, FormatsHaveNames) {
    EXPECT_EQ(export_format("radiance"), ExportFormat::radiance);
    EXPECT_THROW(export_format("radiant"), InputError);
}

}  // namespace
}  // namespace stilb::io
