#include <cmath>
#include <fstream>

#include "io/scene_text.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

/// Four lines before the object's table.
std::string object(const std::string& keys) {
    return "[materials.wall]\ntype = \"black\"\n[materials.floor]\ntype = \"black\"\n[objects.a]\n" + keys;
}

std::string square(const std::string& keys) {
    return object(
        "shape = \"rectangle\"\ncorner = [1, 0, 0]\nedge_u = [1, 0, 0]\nedge_v = [0, 1, 0]\nmaterial = "
        "\"wall\"\n" +
        keys);
}

const std::string kTetrahedron =
    "shape = \"polygons\"\nmaterial = \"wall\"\n"
    "vertices = [[0,0,0], [1,0,0], [0,1,0], [0,0,1]]\nfaces = ";

template <class ShapeType>
ShapeType shape_of(const std::string& toml) {
    return std::get<ShapeType>(read_scene_text(toml).scene.objects.at(0).shape);
}

void expect_close(const Vec3& actual, const Vec3& expected) {
    EXPECT_LT(length(actual - expected), 1e-12) << actual.x << ' ' << actual.y << ' ' << actual.z;
}

TEST(SceneObjects, ScaleRotateTranslateInThisOrder) {
    const auto r = shape_of<Rectangle>(square("translate = [0, 0, 5]\nrotate = [0, 0, 2, 90]\nscale = 3"));
    expect_close(r.corner, {0, 3, 5});
    expect_close(r.edge_u, {0, 3, 0});
    expect_close(r.edge_v, {-3, 0, 0});
}

TEST(SceneObjects, TransformIsRowMajor) {
    const auto r = shape_of<Rectangle>(square("transform = [0,-1,0,10, 1,0,0,20, 0,0,1,30, 0,0,0,1]"));
    expect_close(r.corner, {10, 21, 30});
    expect_close(r.edge_u, {0, 1, 0});
}

TEST(SceneObjects, MirrorsKeepFrontsInFront) {
    const auto r = shape_of<Rectangle>(square("transform = [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]"));
    expect_close(cross(r.edge_u, r.edge_v), {0, 0, 1});
}

TEST(SceneObjects, RefusesWrongTransforms) {
    EXPECT_REFUSAL(
        square("scale = 2\ntransform = [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]"),
        "s.toml:12: objects.a.transform: contradicts \"scale\", which is given too. Allowed: one of the "
        "two.");
    EXPECT_REFUSAL(
        square("transform = [1, 0, 0]"),
        "s.toml:11: objects.a.transform: found an array of 3 where an array of 16 numbers is needed.");
    EXPECT_REFUSAL(square("transform = [1,0,0,0, 1,0,0,0, 0,0,1,0, 0,0,0,1]"),
                   "s.toml:11: objects.a.transform: the matrix is singular: it flattens the object. Allowed: "
                   "any invertible matrix.");
    EXPECT_REFUSAL(
        square("transform = [1,0,0,0, 0,1,0,0, 0,0,1,0, 5,5,5,1]"),
        "s.toml:11: objects.a.transform: the last row is not [0, 0, 0, 1]. Allowed: 16 numbers row by row; "
        "the translation is the fourth of each of the first three rows.");
    EXPECT_REFUSAL(
        square("scale = 0"),
        "s.toml:11: objects.a.scale: 0 is not allowed. Allowed: a factor above 0 (from 1e-9 to 1e9).");
    EXPECT_REFUSAL(square("rotate = [0, 0, 0, 90]"),
                   "s.toml:11: objects.a.rotate: [0, 0, 0] has no direction. Allowed: any other vector.");
    EXPECT_REFUSAL(square("rotate = [0, 0, 90]"),
                   "s.toml:11: objects.a.rotate: found an array of 3 where an array of 4 numbers is needed.");
    EXPECT_REFUSAL(
        object("shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"wall\"\n"
               "transform = [2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]"),
        "s.toml:10: objects.a.transform: stretches or shears a curved shape. Allowed for spheres, disks and "
        "harmonics: transformations that keep angles (translation, rotation, reflection, one scale for all "
        "axes).");
}

TEST(SceneObjects, RefusesUnknownShapesAndKeys) {
    EXPECT_REFUSAL(
        object("shape = \"spere\""),
        "s.toml:6: objects.a.shape: unknown shape \"spere\". Did you mean \"sphere\"? Allowed: mesh, "
        "rectangle, box, sphere, disk, polygons, harmonics.");
    EXPECT_REFUSAL(object("shape = \"box\"\nmax = [1, 1, 1]\nmni = [0, 0, 0]"),
                   "s.toml:8: objects.a: unknown key \"mni\" for shape \"box\". Did you mean \"min\"? "
                   "Allowed: min, max, "
                   "shape, material, scale, rotate, translate, transform.");
}

TEST(SceneObjects, RefusesMissingMaterials) {
    const std::string box = "shape = \"box\"\nmin = [0, 0, 0]\nmax = [1, 1, 1]\n";
    EXPECT_REFUSAL(object(box), "s.toml:5: objects.a: key \"material\" is missing for shape \"box\".");
    EXPECT_REFUSAL(object(box + "material = \"wal\""),
                   "s.toml:9: objects.a.material: unknown material \"wal\". Did you mean \"wall\"? Allowed: "
                   "wall, floor.");
}

TEST(SceneObjects, RefusesFlatShapes) {
    EXPECT_REFUSAL(
        object("shape = \"box\"\nmin = [0, 0, 0]\nmax = [1, 0, 1]"),
        "s.toml:5: objects.a: max is not above min. Allowed: a max that is larger than min in x, y and z.");
    EXPECT_REFUSAL(
        object("shape = \"rectangle\"\ncorner = [0, 0, 0]\nedge_u = [0, 0, 0]\nedge_v = [0, 1, 0]"),
        "s.toml:8: objects.a.edge_u: [0, 0, 0] has no direction. Allowed: any other vector.");
    EXPECT_REFUSAL(
        object("shape = \"rectangle\"\ncorner = [0, 0, 0]\nedge_u = [0, 2, 0]\nedge_v = [0, -1, 0]"),
        "s.toml:9: objects.a.edge_v: is parallel to edge_u, so the edges span no area. Allowed: any other "
        "direction.");
    EXPECT_REFUSAL(
        object("shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = -1"),
        "s.toml:8: objects.a.radius: -1 is not allowed. Allowed: a length above 0 (from 1e-9 to 1e9 m).");
    EXPECT_REFUSAL(object("shape = \"sphere\"\ncenter = [0, 0, inf]\nradius = 1"),
                   "s.toml:7: objects.a.center[2]: inf is not allowed. Allowed: a number from -1e9 to 1e9.");
    EXPECT_REFUSAL(object("shape = \"sphere\"\ncenter = [0, 0]\nradius = 1"),
                   "s.toml:7: objects.a.center: found an array of 2 where a triple [x, y, z] is needed.");
}

TEST(SceneObjects, DiskNormalsAreMadeUnit) {
    const std::string disk =
        "shape = \"disk\"\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"wall\"\nnormal = ";
    const SceneFile file = read_scene_text(object(disk + "[0, 3, 4]"));
    expect_close(std::get<Disk>(file.scene.objects[0].shape).normal, {0, 0.6, 0.8});
    EXPECT_EQ(file.warnings.at(0),
              "s.toml:10: objects.a.normal: the vector has length 5; it is normalised to length 1.");
    EXPECT_EQ(read_scene_text(object(disk + "[0, 0.6, 0.8001]")).warnings.at(0),
              "s.toml:3: materials.floor: no object has this material.")
        << "no warning of the normal";
    EXPECT_REFUSAL(object(disk + "[0, 0, 0]"),
                   "s.toml:10: objects.a.normal: [0, 0, 0] has no direction. Allowed: any other vector.");
}

TEST(SceneObjects, PolygonsOfAnyNumberOfCorners) {
    const auto tetrahedron = shape_of<Mesh>(object(kTetrahedron + "[[0,2,1], [0,1,3], [0,3,2], [1,2,3]]"));
    EXPECT_EQ(tetrahedron.triangles.size(), 4u);
    EXPECT_NEAR(area_m2(tetrahedron), 1.5 + std::sqrt(3) / 2, 1e-12);
    const auto l_shape = shape_of<Mesh>(
        object("shape = \"polygons\"\nmaterial = \"wall\"\n"
               "vertices = [[0,0,0], [2,0,0], [2,1,0], [1,1,0], [1,2,0], [0,2,0]]\nfaces = [[0,1,2,3,4,5]]"));
    EXPECT_EQ(l_shape.triangles.size(), 4u);
    EXPECT_NEAR(area_m2(l_shape), 3, 1e-12);
}

TEST(SceneObjects, DropsAndCountsDegenerateTriangles) {
    const SceneFile file = read_scene_text(object(kTetrahedron + "[[0,1,2], [0,1,1], [2,3,2]]"));
    EXPECT_EQ(std::get<Mesh>(file.scene.objects[0].shape).triangles.size(), 1u);
    EXPECT_EQ(file.warnings.at(0), "s.toml:5: objects.a: 2 triangles without area are left out.");
}

TEST(SceneObjects, RefusesWrongPolygons) {
    EXPECT_REFUSAL(
        object(kTetrahedron + "[[0, 1, 4]]"),
        "s.toml:9: objects.a.faces[0][2]: found the number 4. Allowed: a whole number from 0 to 3.");
    EXPECT_REFUSAL(
        object(kTetrahedron + "[[0,1,2],\n[0, 1, -1]]"),
        "s.toml:10: objects.a.faces[1][2]: found the number -1. Allowed: a whole number from 0 to 3.");
    EXPECT_REFUSAL(
        object(kTetrahedron + "[[0, 1]]"),
        "s.toml:9: objects.a.faces[0]: found a face of 2 corners. Allowed: 3 or more indices of vertices.");
    EXPECT_REFUSAL(object("shape = \"polygons\"\nvertices = []\nfaces = []"),
                   "s.toml:7: objects.a.vertices: found fewer than 3 vertices. Allowed: 3 or more.");
    EXPECT_TRUE(refusal(object(kTetrahedron + "[]")).starts_with("s.toml:5: objects.a: no triangle"));
    EXPECT_TRUE(
        refusal(object(kTetrahedron + "[[0, 1, 1]]")).starts_with("s.toml:5: objects.a: no triangle"));
}

/// A square floor and a wall, with names of materials and groups.
class SceneMeshes : public testing::Test {
  protected:
    void SetUp() override {
        std::ofstream(directory_ / "room.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\n"
                                                  "g ground\nusemtl carpet\nf 1 2 3 4\n"
                                                  "g back\nusemtl paint\nf 1 2 6 5\n";
        std::ofstream(directory_ / "empty.obj") << "v 0 0 0\n";
    }

    static std::string mesh(const std::string& keys) {
        return object("shape = \"mesh\"\nfile = \"room.obj\"\n" + keys);
    }
    SharedList<MaterialId> materials(const std::string& keys) const {
        return read_scene_text(mesh(keys), directory_).scene.objects.at(0).materials;
    }

    static constexpr MaterialId kWall{0}, kFloor{1};
    const TestFolder directory_;
};

TEST_F(SceneMeshes, MaterialForAll) { EXPECT_EQ(materials("material = \"floor\""), std::vector{kFloor}); }

TEST_F(SceneMeshes, MaterialsByTheFilesMaterialsOrGroups) {
    const std::vector expected{kFloor, kFloor, kWall, kWall};
    EXPECT_EQ(materials("materials = { carpet = \"floor\", paint = \"wall\" }"), expected);
    EXPECT_EQ(materials("materials = { ground = \"floor\", back = \"wall\" }"), expected);
    EXPECT_EQ(materials("material = \"wall\"\nmaterials = { carpet = \"floor\" }"), expected);
    EXPECT_EQ(materials("materials = { carpet = \"floor\", ground = \"wall\", back = \"wall\" }"), expected)
        << "material names come before groups";
}

TEST_F(SceneMeshes, AreTransformed) {
    const SceneFile file =
        read_scene_text(mesh("material = \"floor\"\nscale = 2\ntranslate = [0, 0, 1]"), directory_);
    expect_close(std::get<Mesh>(file.scene.objects[0].shape).vertices[5], {2, 0, 3});
}

TEST_F(SceneMeshes, RefusesUnknownParts) {
    EXPECT_EQ(
        refusal(mesh("material = \"wall\"\nmaterials = { carpt = \"floor\" }"), directory_),
        "s.toml:9: objects.a.materials.carpt: the mesh file has no material or group \"carpt\". Did you mean "
        "\"carpet\"? Allowed: carpet, paint, ground, back.");
    EXPECT_EQ(refusal(mesh("materials = { carpet = \"flor\" }"), directory_),
              "s.toml:8: objects.a.materials.carpet: unknown material \"flor\". Did you mean \"floor\"? "
              "Allowed: wall, "
              "floor.");
}

TEST_F(SceneMeshes, RefusesPartsWithoutMaterial) {
    EXPECT_EQ(refusal(mesh("materials = { carpet = \"floor\" }"), directory_),
              "s.toml:5: objects.a: the mesh file's material \"paint\" is not assigned to a material of the "
              "scene. Allowed: an entry "
              "in \"materials\" for it, or \"material\" for all parts that are not in \"materials\".");
    EXPECT_EQ(refusal(mesh(""), directory_),
              "s.toml:5: objects.a: key \"material\" is missing for shape \"mesh\".");
}

TEST_F(SceneMeshes, RefusesMissingEmptyAndOtherFiles) {
    const std::string missing = "shape = \"mesh\"\nmaterial = \"wall\"\nfile = ";
    EXPECT_EQ(refusal(object(missing + "\"rom.obj\""), "no-such-directory"),
              "s.toml:8: objects.a.file: there is no file \"rom.obj\". Paths are relative to the scene file; "
              "looked for "
              "no-such-directory/rom.obj.");
    EXPECT_TRUE(refusal(object(missing + "\"room.glb\""), directory_)
                    .starts_with("s.toml:8: objects.a.file: there is no file \"room.glb\"."));
    const std::string empty = refusal(object(missing + "\"empty.obj\""), directory_);
    EXPECT_TRUE(empty.starts_with((directory_ / "empty.obj").string() + ": no triangle")) << empty;
}

}  // namespace
}  // namespace stilb::io
