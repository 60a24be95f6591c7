// Shapes of Radiance: areas in closed form, fronts, and normals.
#include <cmath>
#include <numbers>

#include "geometry/mesh_topology.h"
#include "io/import/radiance/compiled_files.h"
#include "io/text/text.h"
#include "radiance_text.h"
#include "rays/ray_caster.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

constexpr double kCirclePi = std::numbers::pi;

const Object& only_object(const SceneFile& file) {
    EXPECT_EQ(file.scene.objects.size(), 1u);
    return file.scene.objects.at(0);
}
Mesh mesh_of(const std::string& surface) {
    return std::get<Mesh>(only_object(read_rad(with_material(surface))).shape);
}
double area_of(const std::string& surface) {
    return area_m2(only_object(read_rad(with_material(surface))).shape);
}

TEST(RadianceShapes, AreasAreExact) {
    EXPECT_NEAR(area_of("m polygon p 0 0 12 0 0 0 2 0 0 2 1 0 0 1 0\n"), 2, 1e-12);
    // A square hole by a seam.
    EXPECT_NEAR(area_of("m polygon p 0 0 30 0 0 0 4 0 0 4 4 0 0 4 0 0 0 0 1 1 0 1 2 0 2 2 0 2 1 0 1 1 0\n"),
                15, 1e-12);
    EXPECT_NEAR(area_of("m sphere s 0 0 4 1 2 3 2\n"), 16 * kCirclePi, 1e-12);
    EXPECT_NEAR(area_of("m bubble s 0 0 4 1 2 3 -2\n"), 16 * kCirclePi, 1e-12);
    EXPECT_NEAR(area_of("m ring r 0 0 8 0 0 0 1 2 2 0 3\n"), 9 * kCirclePi, 1e-12);
    EXPECT_NEAR(area_of("m ring r 0 0 8 0 0 0 1 2 2 3 1\n"), 8 * kCirclePi, 1e-12);
    EXPECT_NEAR(area_of("m cylinder c 0 0 7 0 0 0 3 0 4 0.5\n"), 5 * kCirclePi, 1e-12);
    EXPECT_NEAR(area_of("m cone c 0 0 8 1 0 0 1 0 4 4 1\n"), kCirclePi * 5 * 5, 1e-10);
    EXPECT_NEAR(area_of("m cup c 0 0 8 1 0 0 1 0 4 3 0\n"), kCirclePi * 3 * 5, 1e-10);
    EXPECT_NEAR(area_of("m cone c 0 0 8 1 0 0 1 0 4 0 3\n"), kCirclePi * 3 * 5, 1e-10);
}

/// The mean of the front's normal along the direction from the axis through the origin along z.
double outwardness(const Mesh& mesh) {
    double sum = 0, area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 across = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
        const Vec3 middle = (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3;
        sum += dot(across, normalized(Vec3{middle.x, middle.y, 0}));
        area += length(across);
    }
    return sum / area;
}

TEST(RadianceShapes, FrontsOfCylindersAndConesLookOutwardsThoseOfTubesAndCupsInwards) {
    EXPECT_NEAR(outwardness(mesh_of("m cylinder c 0 0 7 0 0 0 0 0 1 2\n")), 1, 1e-3);
    EXPECT_NEAR(outwardness(mesh_of("m cylinder c 0 0 7 0 0 1 0 0 0 2\n")), 1, 1e-3);
    EXPECT_NEAR(outwardness(mesh_of("m tube c 0 0 7 0 0 0 0 0 1 2\n")), -1, 1e-3);
    EXPECT_NEAR(outwardness(mesh_of("m cone c 0 0 8 0 0 0 0 0 4 3 0\n")), 0.8, 1e-3);
    EXPECT_NEAR(outwardness(mesh_of("m cup c 0 0 8 0 0 0 0 0 4 0 3\n")), -0.8, 1e-3);
}

TEST(RadianceShapes, CurvedSurfacesHaveTheirOwnNormals) {
    for (const char* surface : {"m cylinder c 0 0 7 0 0 0 0 0 1 2\n", "m cone c 0 0 8 0 0 0 0 0 4 3 0\n",
                                "m cup c 0 0 8 0 0 0 0 0 4 3 1\n", "m cone c 0 0 8 0 0 0 0 0 4 0 3\n"}) {
        const Mesh mesh = mesh_of(surface);
        ASSERT_EQ(mesh.corner_normals.size(), mesh.triangles.size());
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const auto& [a, b, c] = mesh.triangles[t];
            const Vec3 flat =
                normalized(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
            for (const std::uint32_t corner : mesh.corner_normals[t])
                EXPECT_GT(dot(mesh.normals[corner], flat), std::cos(0.04)) << surface;
        }
    }
}

TEST(RadianceShapes, RingsFaceTheirDirection) {
    const auto disk =
        std::get<Disk>(only_object(read_rad(with_material("m ring r 0 0 8 0 0 1 0 0 -2 0 3\n"))).shape);
    EXPECT_EQ(disk.normal, (Vec3{0, 0, -1}));
    EXPECT_EQ(disk.radius, 3);
    const Mesh ring = mesh_of("m ring r 0 0 8 0 0 1 0 0 -2 1 3\n");
    const auto& [a, b, c] = ring.triangles[0];
    EXPECT_LT(cross(ring.vertices[b] - ring.vertices[a], ring.vertices[c] - ring.vertices[a]).z, 0);
}

TEST(RadianceShapes, BubblesOfGlassAreClosedAndTheirFrontIsInside) {
    const SceneFile file = read_rad("void dielectric g 0 0 5 1 1 1 1.5 0\ng bubble b 0 0 4 0 0 0 2\n");
    const auto mesh = std::get<Mesh>(only_object(file).shape);
    EXPECT_NEAR(area_m2(mesh), 16 * kCirclePi, 1e-9);
    EXPECT_EQ(geometry::find_components(mesh).total_open_edges(), 0u);
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 across = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
        EXPECT_LT(dot(across, mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]), 0);
    }
}

TEST(RadianceShapes, SurfacesOfOneMaterialAreOneObjectAndSurfacesOfVoidAreLeftOut) {
    const SceneFile file = read_rad(with_material(
        "m polygon a 0 0 9 0 0 0 1 0 0 0 1 0\nm polygon b 0 0 9 0 0 1 1 0 1 0 1 1\nm sphere s 0 0 4 5 5 5 1\n"
        "m sphere s 0 0 4 8 5 5 1\nm tube t 0 0 7 0 0 0 1 0 0 .1\nvoid sphere v 0 0 4 0 0 0 9\n"
        "m polygon line 0 0 9 0 0 0 1 0 0 2 0 0\n"));
    std::vector<std::string> names;
    for (const Object& object : file.scene.objects) names.push_back(object.name);
    EXPECT_EQ(names, (std::vector<std::string>{"s", "s_2", "m", "m (curved)"}));
    EXPECT_EQ(file.scene.materials.size(), 1u);
    EXPECT_EQ(warnings_of(file),
              (std::vector<std::string>{"no light: the scene is dark.",
                                        "surface v: its modifier is void: it is invisible, and left out.",
                                        "surface m: 1 triangles without area are left out."}));
}

TEST(RadianceShapes, CompiledMeshesAndOctrees) {
    const auto read = [](const char* name) { return read_radiance_scene(kRadianceData / "compiled" / name); };
    const SceneFile text = read("plain.rad");
    for (const char* name : {"mesh.rad", "octree.rad"}) {
        const SceneFile file = read(name);
        double area = 0, expected = 0;
        for (const Object& object : file.scene.objects) area += area_m2(object.shape);
        for (const Object& object : text.scene.objects) expected += area_m2(object.shape);
        EXPECT_NEAR(area, expected, 1e-6 * expected) << name;
        const Bounds bounds = scene::bounds_of(file.scene), of_text = scene::bounds_of(text.scene);
        EXPECT_LT(length(bounds.min - of_text.min) + length(bounds.max - of_text.max), 1e-6) << name;
    }
    try {
        radiance::files_of_octree(read_whole_file(kRadianceData / "compiled/frozen.oct"), "frozen.oct");
        ADD_FAILURE() << "a frozen octree was read";
    } catch (const InputError& error) {
        EXPECT_STREQ(
            error.what(),
            "frozen.oct: this octree is frozen (oconv -f). Name the Radiance files that it was made of, or "
            "make it without -f.");
    }
    const auto mesh = std::get<Mesh>(read("mesh.rad").scene.objects.at(1).shape);
    ASSERT_EQ(mesh.corner_normals.size(), mesh.triangles.size());
    // The normals of the file are vertical.
    for (const std::uint32_t corner : mesh.corner_normals[0]) EXPECT_GT(mesh.normals[corner].z, 0.99999);
}

}  // namespace
}  // namespace stilb::io
