#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "io/mesh_checks.h"
#include "support/test_folder.h"

namespace stilb::io {
namespace {

const std::string kObjSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

using Triangles = std::vector<Triangle>;

MeshFile read_obj_text(const std::string& content) { return read_obj(content, "room"); }

TEST(ObjFile, triangle) {
    const MeshFile file =
        read_obj_text("# a comment\nv 1 2.5 -3e-1\nv +4 5 6 0.5 0.5 0.5\n\tv  7 8 9 1.0 \n\nf 1 2 3\n");
    EXPECT_EQ(file.mesh.vertices, (std::vector<Vec3>{{1, 2.5, -0.3}, {4, 5, 6}, {7, 8, 9}}));
    EXPECT_EQ(file.mesh.triangles, (Triangles{{0, 1, 2}}));
    EXPECT_EQ(file.degenerate_triangles, 0U);
    EXPECT_EQ(file.material_names, std::vector<std::string>{""});
    EXPECT_EQ(file.group_names, std::vector<std::string>{""});
}

TEST(ObjFile, what_is_written_is_read) {
    const Mesh mesh{{{0, 0, 0}, {1.25, 0, 0}, {0, -3e-7, 1}, {1, 123456, 1}}, {{0, 1, 2}, {3, 2, 1}}};
    const MeshFile file = read_obj_text(to_obj(mesh));
    EXPECT_EQ(file.mesh.vertices, mesh.vertices);
    EXPECT_EQ(file.mesh.triangles, mesh.triangles);
}

TEST(ObjFile, all_forms_of_corners) {
    std::string nine_of_each;
    for (int i = 0; i < 9; ++i) nine_of_each += "vt 0 0\nvn 0 0 1\n";
    for (const std::string face : {"1 2 3", "1/7 2/8 3/9", "1//7 2//8 3//9", "1/7/1 2/8/1 3/9/1", "-4 -3 -2",
                                   "1/ 2/ 3/", "-4/-1/-1 2 3", "1 2 3 # the floor"}) {
        EXPECT_EQ(read_obj_text(kObjSquare + nine_of_each + "f " + face).mesh.triangles,
                  (Triangles{{0, 1, 2}}))
            << face;
    }
}

TEST(ObjFile, texture_coordinates_are_kept_if_wanted) {
    const std::string text = kObjSquare + "vt 0 0.5 0\nvt 1\nvt 0.25 -2\nf 1/1 2/2 3/3 4/-1\nf 1 2 3\n";
    const MeshFile file = read_obj(text, "room", TextureCoordinates::kept);
    EXPECT_EQ(file.texture_coordinates, (std::vector<std::array<float, 2>>{{0, 0.5f}, {1, 0}, {0.25f, -2}}));
    ASSERT_EQ(file.corner_coordinates.size(), file.mesh.triangles.size());
    const std::array<std::uint32_t, 4> of_vertex{0, 1, 2, 2};
    for (std::size_t t = 0; t < 2; ++t) {
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(file.corner_coordinates[t][i], of_vertex[file.mesh.triangles[t][i]]);
    }
    EXPECT_EQ(file.corner_coordinates[2], (Triangle{kNoCoordinates, kNoCoordinates, kNoCoordinates}));
    EXPECT_TRUE(read_obj_text(text).texture_coordinates.empty());
    EXPECT_TRUE(read_obj_text(text).corner_coordinates.empty());
}

TEST(ObjFile, normals_of_corners) {
    const std::string normals = "vn 0 0 1\nvn 0 3 4\nvn 0 0 0\n";
    const Mesh mesh =
        read_obj_text(kObjSquare + normals + "f 1//1 2//-2 3//2 4//1\nf 1 2 3\nf 2//3 3//1 4//1\n").mesh;
    EXPECT_EQ(mesh.normals, (std::vector<Vec3>{{0, 0, 1}, {0, 0.6, 0.8}, {}}));
    ASSERT_EQ(mesh.corner_normals.size(), mesh.triangles.size());
    const std::array<std::uint32_t, 4> of_vertex{0, 1, 1, 0};
    for (std::size_t t = 0; t < 2; ++t) {
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(mesh.corner_normals[t][i], of_vertex[mesh.triangles[t][i]]);
    }
    EXPECT_EQ(mesh.corner_normals[2], (Triangle{kNoNormal, kNoNormal, kNoNormal}));
    EXPECT_EQ(mesh.corner_normals[3], (Triangle{2, 0, 0}));
}

TEST(ObjFile, faces_without_normals_may_come_first) {
    const Mesh mesh = read_obj_text(kObjSquare + "f 1 2 3\nvn 0 0 1\nf 1//1 3//1 4//1\nf 2 3 4\n").mesh;
    EXPECT_EQ(mesh.corner_normals,
              (Triangles{{kNoNormal, kNoNormal, kNoNormal}, {0, 0, 0}, {kNoNormal, kNoNormal, kNoNormal}}));
}

TEST(ObjFile, normals_that_no_face_names_are_left_out) {
    const Mesh mesh = read_obj_text(kObjSquare + "vn 0 0 1\nf 1 2 3\nf 1/ 2/ 3/\n").mesh;
    EXPECT_TRUE(mesh.normals.empty());
    EXPECT_TRUE(mesh.corner_normals.empty());
}

TEST(ObjFile, relative_numbers_count_from_the_face) {
    const MeshFile file = read_obj_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -1 -2 -3\n");
    EXPECT_EQ(file.mesh.triangles, (Triangles{{0, 1, 2}, {3, 2, 1}}));
}

TEST(ObjFile, concave_polygon_keeps_its_area_and_front) {
    const MeshFile file = read_obj_text("v 0 0 0\nv 4 0 0\nv 1 1 0\nv 0 4 0\nf 1 2 3 4\n");
    ASSERT_EQ(file.mesh.triangles.size(), 2U);
    double area = 0;
    for (const Triangle& t : file.mesh.triangles) {
        const Vec3& a = file.mesh.vertices[t[0]];
        const double part = cross(file.mesh.vertices[t[1]] - a, file.mesh.vertices[t[2]] - a).z / 2;
        EXPECT_GT(part, 0);
        area += part;
    }
    EXPECT_DOUBLE_EQ(area, 4);
}

TEST(ObjFile, line_ends_and_joined_lines) {
    const MeshFile file = read_obj_text(
        "v 0 0 0\r\nv 1 0 \\\r\n0\r\n# C:\\rooms\\\r\nv 0 1 0\r\nusemtl wall paint \r\nf 1 \\\r\n 2\\\r\n "
        "3\r\n");
    EXPECT_EQ(file.mesh.triangles, (Triangles{{0, 1, 2}}));
    EXPECT_EQ(file.material_names, std::vector<std::string>{"wall paint"});
}

TEST(ObjFile, byte_order_mark_and_names_in_utf8) {
    EXPECT_EQ(read_obj_text("\xef\xbb\xbf" + kObjSquare + "o T\xc3\xbcr\nf 1 2 3").group_names,
              std::vector<std::string>{"T\xc3\xbcr"});
}

TEST(ObjFile, materials_and_groups_of_each_triangle) {
    const MeshFile file = read_obj_text(
        kObjSquare +
        "f 1 2 3\nusemtl wood\ng desk\nf 1 2 3 4\nusemtl unused\nusemtl steel\no lamp\nf 1 2 4\n"
        "usemtl wood\nf 2 3 4\n");
    EXPECT_EQ(file.material_names, (std::vector<std::string>{"", "wood", "steel"}));
    EXPECT_EQ(file.material_of_triangle, (std::vector<std::uint32_t>{0, 1, 1, 2, 1}));
    EXPECT_EQ(file.group_names, (std::vector<std::string>{"", "desk", "lamp"}));
    EXPECT_EQ(file.group_of_triangle, (std::vector<std::uint32_t>{0, 1, 1, 2, 2}));
}

TEST(ObjFile, other_statements_change_nothing) {
    const std::string others =
        "mtllib a.mtl\nvt 0 0\nvn 0 0 1\nvp 0\ns off\nl 1 2\np 1\nlod 3\ncstype bezier\nend\n";
    EXPECT_EQ(read_obj_text(others + kObjSquare + "f 1 2 3\n").mesh.triangles.size(), 1U);
}

TEST(ObjFile, degenerate_triangles_are_left_out_and_counted) {
    // A corner twice, corners on a line (also where rounding keeps them off it), and one good triangle.
    const MeshFile file = read_obj_text(
        kObjSquare +
        "v 0.1 0.1 0.1\nv 0.3 0.3 0.3\nv 0.7 0.7 0.7\nf 1 1 2\nf 5 6 7\nusemtl good\nf 1 2 3\nf 1 2 2 3\n");
    EXPECT_EQ(file.degenerate_triangles, 3U);
    EXPECT_EQ(file.mesh.triangles.size(), 2U);
    EXPECT_EQ(file.material_names, std::vector<std::string>{"good"});
}

TEST(ObjFile, thin_triangles_stay) {
    EXPECT_EQ(read_obj_text("v 0 0 0\nv 10000 0 0\nv 0 0.0001 0\nf 1 2 3").mesh.triangles.size(), 1U);
    EXPECT_EQ(read_obj_text("v 0 0 0\nv 1e-9 0 0\nv 0 1e-9 0\nf 1 2 3").mesh.triangles.size(), 1U);
}

void expect_obj_refusal(const std::string& content, const std::string& message) {
    EXPECT_EQ(refusal(read_obj, content), "room" + message);
}

TEST(ObjFile, wrong_vertices) {
    const std::string rule = "; it must be a finite number, at most 1e30 in size";
    expect_obj_refusal("v 0 0 0\nv 1 nan 0\n", ":2: the vertex's y is \"nan\"" + rule);
    expect_obj_refusal("v -inf 0 0\n", ":1: the vertex's x is \"-inf\"" + rule);
    expect_obj_refusal("v 0 0 1e999\n", ":1: the vertex's z is \"1e999\"" + rule);
    expect_obj_refusal("v 0 0 -2e30\n", ":1: the vertex's z is \"-2e30\"" + rule);
    expect_obj_refusal("v 0 1,5 0\n", ":1: the vertex's y is \"1,5\"" + rule);
    expect_obj_refusal("v 0 0 0x10\n", ":1: the vertex's z is \"0x10\"" + rule);
    expect_obj_refusal("v 0 0 +-1\n", ":1: the vertex's z is \"+-1\"" + rule);
    expect_obj_refusal("v 0 0 1.2.3\n", ":1: the vertex's z is \"1.2.3\"" + rule);
    expect_obj_refusal("v 0 1\n", ":1: the vertex has 2 coordinates; it needs three: v x y z");
    expect_obj_refusal("v # none\n", ":1: the vertex has 0 coordinates; it needs three: v x y z");
}

/// As modellers leave them behind.
TEST(ObjFile, faces_of_one_or_two_corners_are_left_out_and_counted) {
    const MeshFile file = read_obj_text(kObjSquare + "f 1 2\nf 1 2 3\nf 4\n");
    EXPECT_EQ(file.mesh.triangles, (Triangles{{0, 1, 2}}));
    EXPECT_EQ(file.degenerate_triangles, 2U);
    expect_obj_refusal(kObjSquare + "f 1 2\n",
                       ": no triangle found (1 without area left out), so there is no surface; an "
                       "OBJ file needs faces, such as: f 1 2 3");
}

TEST(ObjFile, wrong_faces) {
    expect_obj_refusal(kObjSquare + "f", ":5: the face has no corners; it needs three or more: f 1 2 3");
    expect_obj_refusal(kObjSquare + "f # none\n",
                       ":5: the face has no corners; it needs three or more: f 1 2 3");
    const std::string range = ", but 4 vertices stand before it; they count from 1, or backwards from -1";
    expect_obj_refusal(kObjSquare + "f 1 2 5\nv 9 9 9\n",
                       ":5: the face's corner \"5\" names vertex 5" + range);
    expect_obj_refusal(kObjSquare + "vt 0 0\nf 1 2/1 -5/1\n",
                       ":6: the face's corner \"-5/1\" names vertex -5" + range);
    expect_obj_refusal(kObjSquare + "f 0 1 2\n", ":5: the face's corner \"0\" names vertex 0" + range);
    expect_obj_refusal(kObjSquare + "f 1 2 4294967297\n",
                       ":5: the face's corner \"4294967297\" names vertex 4294967297" + range);
    const std::string form = "; it must be a vertex number, alone or as v/vt, v//vn or v/vt/vn";
    for (const std::string corner :
         {"x", "1.5", "/1", "1/2/3/4", "1/a", "1e0", "99999999999999999999", "--1"})
        expect_obj_refusal(kObjSquare + "\nf 1 2 " + corner,
                           ":6: the face's corner is \"" + corner + "\"" + form);
}

/// What a surface has beside its shape does not matter where it is wrong.
TEST(ObjFile, normals_and_coordinates_that_do_not_exist_are_left_out) {
    const std::string start = kObjSquare + "vt 0 0\nvn 0 0 1\nvn 1 0 0\nf 1/1/1 2/1/1 ";
    const std::string remark =
        "line 8: the face's corner \"{}\" names a normal or a texture coordinate that "
        "does not stand before it; 1 such numbers are left out.";
    for (const std::string corner : {"3/1/3", "3/1/0", "3/1/-3", "3/2/1", "3/0/1", "3/-2/1"}) {
        const MeshFile file = read_obj(start + corner, "room", TextureCoordinates::kept);
        EXPECT_EQ(file.mesh.triangles, (Triangles{{0, 1, 2}})) << corner;
        EXPECT_EQ(file.remarks, std::vector{fmt::format(fmt::runtime(remark), corner)});
    }
    // The last that exist.
    for (const std::string corner : {"3/1/2", "3/-1/-2"})
        EXPECT_TRUE(read_obj_text(start + corner).remarks.empty()) << corner;
    const MeshFile without = read_obj_text(kObjSquare + "f 1/1 2/2 3/3 4/4\nf 1//7 2//7 3//7\n");
    EXPECT_EQ(without.mesh.triangles.size(), 3U);
    EXPECT_TRUE(without.mesh.normals.empty());
    ASSERT_EQ(without.remarks.size(), 1U);
    EXPECT_NE(without.remarks[0].find("7 such numbers"), std::string::npos) << without.remarks[0];
}

TEST(ObjFile, normals_that_are_no_numbers_count_as_missing) {
    for (const std::string normal : {"0 nan 1", "-nan(ind) 0 1", "0 1", "inf 0 0", "1e999 0 0", "x y z"}) {
        const MeshFile file = read_obj_text(kObjSquare + "vn 0 0 1\nvn " + normal + "\nf 1//1 2//2 3//1\n");
        ASSERT_EQ(file.mesh.normals.size(), 2U) << normal;
        EXPECT_EQ(file.mesh.normals[1], Vec3{}) << normal;
    }
}

TEST(ObjFile, unknown_statements_are_left_out_and_named) {
    const MeshFile file = read_obj_text("vw 1\n" + kObjSquare + "vw 2\nfoo bar\nf 1 2 3\n");
    EXPECT_EQ(file.mesh.triangles.size(), 1U);
    EXPECT_EQ(file.remarks, (std::vector<std::string>{
                                "line 1: \"vw\" is not an OBJ statement; such lines are left out.",
                                "line 7: \"foo\" is not an OBJ statement; such lines are left out."}));
}

TEST(ObjFile, names_in_latin_1_become_utf8) {
    const MeshFile file = read_obj_text(
        "g K\xfc"
        "che\nusemtl W\xe4nde\n" +
        kObjSquare + "f 1 2 3\n");
    EXPECT_EQ(file.group_names, std::vector<std::string>{"K\xc3\xbc"
                                                         "che"});
    EXPECT_EQ(file.material_names, std::vector<std::string>{"W\xc3\xa4nde"});
}

TEST(ObjFile, lines_are_counted_through_joined_lines) {
    expect_obj_refusal(
        "v 0 \\\n0 \\\n0\nf 1 \\\n2 3\n",
        ":4: the face's corner \"2\" names vertex 2, but 1 vertices stand before it; they count "
        "from 1, or backwards from -1");
    expect_obj_refusal("v 0 0 \\", ":1: the file ends after a backslash, which continues the line");
}

TEST(ObjFile, what_is_no_obj) {
    expect_obj_refusal(
        std::string("\x7f"
                    "ELF\x02\x01\x01\0\0",
                    9),
        ":1: byte 0x02 is not text, so this is not an OBJ file; it must be plain text (ASCII or UTF-8)");
    expect_obj_refusal(
        std::string("v 0 0 0\nv 1 0 0\n\0", 17),
        ":3: byte 0x00 is not text, so this is not an OBJ file; it must be plain text (ASCII or UTF-8)");
    expect_obj_refusal(
        "\x89PNG\r\n",
        ":1: \"\\x89PNG\" is not an OBJ statement (is this a text file in the OBJ format?); allowed "
        "are v, f, g, o, usemtl and others that are ignored");
    expect_obj_refusal(
        kObjSquare + "face 1 2 3\n",
        ":5: \"face\" is not an OBJ statement (is this a text file in the OBJ format?); allowed are "
        "v, f, g, o, usemtl and others that are ignored");
    expect_obj_refusal(
        "surf 0 1 0 1 1 2 3 4\n",
        ":1: the statement \"surf\" is not supported, and its surface would be missing; export "
        "polygons (f) instead");
}

TEST(ObjFile, no_triangle) {
    expect_obj_refusal(
        "", ": no triangle found, so there is no surface; an OBJ file needs faces, such as: f 1 2 3");
    expect_obj_refusal(
        kObjSquare, ": no triangle found, so there is no surface; an OBJ file needs faces, such as: f 1 2 3");
    expect_obj_refusal(kObjSquare + "f 1 1 2\n",
                       ": no triangle found (1 without area left out), so there is no surface; an OBJ file "
                       "needs faces, such as: f 1 2 3");
}

struct SharedMesh {
    std::string name;
    std::size_t vertices, triangles;  // as counted by grep -c "^v " and from the faces' corners
};

TEST(ObjFile, shared_meshes) {
    if (!std::filesystem::exists(shared_mesh("spot.obj"))) GTEST_SKIP() << "../shared/data/meshes is absent";
    for (const auto& [name, vertices, triangles] : {SharedMesh{"beetle.obj", 1148, 2053},
                                                    {"spot.obj", 2930, 5856},
                                                    {"stanford-bunny.obj", 35947, 69451},
                                                    {"suzanne.obj", 507, 968}}) {
        const MeshFile file = read_mesh_file(shared_mesh(name));
        EXPECT_EQ(file.mesh.vertices.size(), vertices) << name;
        EXPECT_EQ(file.mesh.triangles.size() + file.degenerate_triangles, triangles) << name;
        EXPECT_EQ(file.material_of_triangle.size(), file.mesh.triangles.size()) << name;
    }
    const MeshFile spot = read_mesh_file(shared_mesh("spot.obj"));
    EXPECT_EQ(open_edges(spot.mesh), 0U);
    EXPECT_GT(enclosed_volume(spot.mesh), 0);
}

TEST(MeshFile, files_that_cannot_be_read) {
    const auto message = [](const std::filesystem::path& path) {
        try {
            read_mesh_file(path);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    EXPECT_EQ(message("nowhere/room.obj"), "nowhere/room.obj: cannot be read: No such file or directory");
    EXPECT_EQ(message("room.stl"),
              "room.stl: the extension \".stl\" is not a supported mesh format: use .obj, .ply, .gltf "
              "or .glb");
    const TestFolder folder;
    const std::filesystem::path directory = folder / "folder.obj";
    std::filesystem::create_directory(directory);
    EXPECT_EQ(message(directory),
              directory.string() + ": cannot be read, because it is a folder. Name a file.");
    EXPECT_EQ(message("/tmp"), "/tmp: cannot be read, because it is a folder. Name a file.");
}

TEST(MeshFile, extension_in_any_case) {
    const TestFolder folder;
    EXPECT_EQ(read_mesh_file(folder.write("square.OBJ", std::string(kObjSquare) + "f 1 2 3 4\n"))
                  .mesh.triangles.size(),
              2U);
}

}  // namespace
}  // namespace stilb::io
