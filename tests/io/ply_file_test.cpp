#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "io/mesh_checks.h"

namespace stilb::io {
namespace {

using Triangles = std::vector<Triangle>;

const std::string kVertices = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kPlySquare = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

std::string text_file(const std::string& header, const std::string& body) {
    return "ply\nformat ascii 1.0\n" + header + "end_header\n" + body;
}

MeshFile read_ply_text(const std::string& content) { return read_ply(content, "room"); }

/// Writes numbers as a binary PLY has them.
class Bytes {
  public:
    explicit Bytes(std::endian order) : order_(order) {}
    template <class Number>
    Bytes& add(std::initializer_list<Number> numbers) {
        for (const Number number : numbers) {
            std::string bytes(sizeof(Number), '\0');
            std::memcpy(bytes.data(), &number, sizeof(Number));
            if (order_ != std::endian::native) std::reverse(bytes.begin(), bytes.end());
            content_ += bytes;
        }
        return *this;
    }
    const std::string& content() const { return content_; }

  private:
    std::endian order_;
    std::string content_;
};

std::string binary_header(std::endian order, const std::string& elements) {
    const std::string name = order == std::endian::little ? "binary_little_endian" : "binary_big_endian";
    return "ply\nformat " + name + " 1.0\n" + elements + "end_header\n";
}

constexpr std::array kOrders{std::endian::little, std::endian::big};

TEST(PlyFile, text) {
    const MeshFile file =
        read_ply_text(text_file("comment made by hand\nobj_info none\n" + kVertices + kFaces,
                                "0 0 0\n1 0 0\n1.5 1e0 -2\n0 1 0\n3 0 1 2\n"));
    EXPECT_EQ(file.mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1.5, 1, -2}, {0, 1, 0}}));
    EXPECT_EQ(file.mesh.triangles, (Triangles{{0, 1, 2}}));
    EXPECT_EQ(file.material_names, std::vector<std::string>{""});
    EXPECT_EQ(file.group_names, std::vector<std::string>{""});
    EXPECT_EQ(file.material_of_triangle, std::vector<std::uint32_t>{0});
    EXPECT_EQ(file.group_of_triangle, std::vector<std::uint32_t>{0});
}

TEST(PlyFile, vertex_normals) {
    const std::string header =
        kVertices + "property float nx\nproperty float ny\nproperty float nz\n" + kFaces;
    const std::string rows = "0 0 0 0 0 2\n1 0 0 0 3 4\n1 1 0 0 0 0\n0 1 0 0 0 -1\n3 0 1 2\n";
    const Mesh mesh = read_ply_text(text_file(header, rows)).mesh;
    EXPECT_EQ(mesh.normals, (std::vector<Vec3>{{0, 0, 1}, {0, 0.6, 0.8}, {}, {0, 0, -1}}));
    EXPECT_TRUE(mesh.corner_normals.empty());
    // Two of three are none.
    const std::string two = kVertices + "property float nx\nproperty float ny\n" + kFaces;
    EXPECT_TRUE(read_ply_text(text_file(two, "0 0 0 0 1\n1 0 0 0 1\n1 1 0 0 1\n0 1 0 0 1\n3 0 1 2\n"))
                    .mesh.normals.empty());
}

TEST(PlyFile, text_with_other_line_ends_blank_lines_and_no_last_end) {
    EXPECT_EQ(
        read_ply_text("ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float x\r\nproperty float "
                      "y\r\nproperty float z\r\n"
                      "element face 1\r\nproperty list uchar int vertex_index\r\nend_header\r\n"
                      "0 0 0\r\n\r\n 1\t0 0 \r\n0 1 0\r\n3 0 1 2")
            .mesh.triangles,
        (Triangles{{0, 1, 2}}));
}

TEST(PlyFile, binary_of_both_orders) {
    for (const std::endian order : kOrders) {
        Bytes body(order);
        body.add<float>({0, 0, 0, 1, 0, 0, 1, 1.5F, 0, 0, 1, 0})
            .add<std::uint8_t>({4})
            .add<std::int32_t>({0, 1, 2, 3});
        const MeshFile file = read_ply_text(binary_header(order, kVertices + kFaces) + body.content());
        EXPECT_EQ(file.mesh.vertices[2], (Vec3{1, 1.5, 0}));
        EXPECT_EQ(file.mesh.triangles.size(), 2U);
    }
}

template <class Number>
void expect_type_read(const std::string& type, std::endian order) {
    SCOPED_TRACE(type);
    const bool is_whole = std::numeric_limits<Number>::is_integer;
    const std::string count_type = is_whole ? type : "uchar";
    const std::string header = binary_header(
        order, "element vertex 3\nproperty " + type + " x\nproperty " + type + " y\nproperty " + type +
                   " z\nelement face 1\nproperty list " + count_type + " " + type + " vertex_index\n");
    Bytes body(order);
    body.add<Number>({0, 0, 100, 7, 0, 0, 0, 5, 0});
    if (is_whole) {
        body.add<Number>({3});
    } else {
        body.add<std::uint8_t>({3});
    }
    body.add<Number>({2, 0, 1});
    const MeshFile file = read_ply_text(header + body.content());
    EXPECT_EQ(file.mesh.vertices, (std::vector<Vec3>{{0, 0, 100}, {7, 0, 0}, {0, 5, 0}}));
    EXPECT_EQ(file.mesh.triangles, (Triangles{{2, 0, 1}}));
}

TEST(PlyFile, all_types_by_both_names) {
    for (const std::endian order : kOrders) {
        for (const char* type : {"char", "int8"}) expect_type_read<std::int8_t>(type, order);
        for (const char* type : {"uchar", "uint8"}) expect_type_read<std::uint8_t>(type, order);
        for (const char* type : {"short", "int16"}) expect_type_read<std::int16_t>(type, order);
        for (const char* type : {"ushort", "uint16"}) expect_type_read<std::uint16_t>(type, order);
        for (const char* type : {"int", "int32"}) expect_type_read<std::int32_t>(type, order);
        for (const char* type : {"uint", "uint32"}) expect_type_read<std::uint32_t>(type, order);
        for (const char* type : {"float", "float32"}) expect_type_read<float>(type, order);
        for (const char* type : {"double", "float64"}) expect_type_read<double>(type, order);
    }
}

TEST(PlyFile, other_elements_properties_and_lists_are_skipped) {
    const std::string elements =
        "element camera 2\nproperty list uchar short view\nproperty double fov\n"
        "element vertex 3\nproperty uchar red\nproperty float z\nproperty list uint8 float weights\nproperty "
        "float x\nproperty double y\nproperty float nx\n"
        "element face 1\nproperty list uchar float texcoord\nproperty list ushort ushort "
        "vertex_indices\nproperty int flags\n"
        "element edge 0\nproperty int vertex1\n";
    const std::string text =
        "2 10 20 0.5\n0 0.5\n255 3 1 9 1 2 nan\n255 7 0 4 5 0\n255 9 2 8 8 7 9 0\n2 0.5 0.5 3 2 1 0 -1\n";
    const auto expect_read = [](const std::string& content) {
        const MeshFile file = read_ply_text(content);
        EXPECT_EQ(file.mesh.vertices, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 7}, {7, 9, 9}}));
        EXPECT_EQ(file.mesh.triangles, (Triangles{{2, 1, 0}}));
    };
    expect_read(text_file(elements, text));
    for (const std::endian order : kOrders) {
        Bytes body(order);
        body.add<std::uint8_t>({2}).add<std::int16_t>({10, 20}).add<double>({0.5});
        body.add<std::uint8_t>({0}).add<double>({0.5});
        const auto add_vertex = [&](float z, std::initializer_list<float> weights, float x, double y) {
            body.add<std::uint8_t>({255}).add<float>({z}).add<std::uint8_t>(
                {static_cast<std::uint8_t>(weights.size())});
            body.add<float>(weights).add<float>({x}).add<double>({y}).add<float>({NAN});
        };
        add_vertex(3, {9}, 1, 2);
        add_vertex(7, {}, 4, 5);
        add_vertex(9, {8, 8}, 7, 9);
        body.add<std::uint8_t>({2})
            .add<float>({0.5, 0.5})
            .add<std::uint16_t>({3, 2, 1, 0})
            .add<std::int32_t>({-1});
        expect_read(binary_header(order, elements) + body.content());
    }
}

TEST(PlyFile, polygons_are_triangulated) {
    const MeshFile file = read_ply_text(
        text_file("element vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face "
                  "2\nproperty list uchar int vertex_index\n",
                  "0 0 0\n4 0 0\n1 1 0\n0 4 0\n4 0 1 2 3\n3 0 0 1\n"));
    ASSERT_EQ(file.mesh.triangles.size(), 2U);
    EXPECT_EQ(file.degenerate_triangles, 1U);
    double area = 0;
    for (const Triangle& t : file.mesh.triangles) {
        const Vec3& a = file.mesh.vertices[t[0]];
        const double part = cross(file.mesh.vertices[t[1]] - a, file.mesh.vertices[t[2]] - a).z / 2;
        EXPECT_GT(part, 0);
        area += part;
    }
    EXPECT_DOUBLE_EQ(area, 4);
}

TEST(PlyFile, strips_turn_every_second_triangle_and_start_again_at_minus_one) {
    const std::string header = kVertices + "element tristrips 2\nproperty list int int vertex_indices\n";
    const MeshFile file =
        read_ply_text(text_file(header, "0 0 0\n1 0 0\n0 1 0\n1 1 0\n9 0 1 2 3 -1 1 3 2 -1\n4 -1 0 1 2\n"));
    EXPECT_EQ(file.mesh.triangles, (Triangles{{0, 1, 2}, {2, 1, 3}, {1, 3, 2}, {0, 1, 2}}));
    for (const Triangle& t : file.mesh.triangles) {
        const Vec3& a = file.mesh.vertices[t[0]];
        EXPECT_GT(cross(file.mesh.vertices[t[1]] - a, file.mesh.vertices[t[2]] - a).z, 0);
    }
}

void expect_ply_refusal(const std::string& content, const std::string& message) {
    EXPECT_EQ(refusal(read_ply, content), "room" + message);
}

TEST(PlyFile, what_is_no_ply) {
    expect_ply_refusal("", ":1: this is not a PLY file: the first line must be ply");
    expect_ply_refusal("solid room\n", ":1: this is not a PLY file: the first line must be ply");
    expect_ply_refusal(std::string("\0\xff\xff", 3),
                       ":1: this is not a PLY file: the first line must be ply");
}

TEST(PlyFile, foreign_lines_of_the_header_are_left_out) {
    const MeshFile file =
        read_ply(std::string_view("ply\nformat ascii 1.0\nMade by hand\nelement vertex 3\nproperty float "
                                  "x\nproperty float y\nproperty "
                                  "float z\n"
                                  "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 "
                                  "0\n1 0 0\n0 1 0\n3 0 1 2\n"),
                 "room");
    EXPECT_EQ(file.mesh.triangles.size(), 1U);
    EXPECT_EQ(file.remarks,
              std::vector<std::string>{
                  "line 3: the header says \"Made\"; allowed are format, element, property, comment, "
                  "obj_info and end_header. The line is left out."});
}

TEST(PlyFile, normals_that_are_no_numbers_count_as_missing) {
    const MeshFile file = read_ply(
        std::string_view(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            "property float nx\nproperty float ny\nproperty float nz\nelement face 1\n"
            "property list uchar int vertex_indices\nend_header\n0 0 0 nan nan nan\n1 0 0 0 0 1\n0 1 0 0 inf "
            "1\n3 0 1 2\n"),
        "room");
    ASSERT_EQ(file.mesh.normals.size(), 3U);
    EXPECT_EQ(file.mesh.normals[0], Vec3{});
    EXPECT_EQ(file.mesh.normals[1], (Vec3{0, 0, 1}));
    EXPECT_EQ(file.mesh.normals[2], Vec3{});
}

TEST(PlyFile, broken_headers) {
    expect_ply_refusal("ply\nformat ascii 1.0\nelement vertex 3\n",
                       ":3: the header has no end: a line end_header must close it");
    expect_ply_refusal("ply\nend_header\n",
                       ":2: the header has no format line; it needs one, such as: format ascii 1.0");
    expect_ply_refusal("ply\nformat binary_littel_endian 1.0\n",
                       ":2: the format is \"binary_littel_endian\"; it must be ascii, "
                       "binary_little_endian or binary_big_endian. Did you mean \"binary_little_endian\"?");
    expect_ply_refusal("ply\nformat ascii 2.0\n", ":2: the format's version is \"2.0\"; it must be 1.0");
    expect_ply_refusal(
        "ply\nformat ascii 1.0\nelemnt vertex 3\n",
        ":3: the header says \"elemnt\"; allowed are format, element, property, comment, obj_info "
        "and end_header. Did you mean \"element\"?");
    const std::string count = "; it must be a whole number, 0 or more: element NAME COUNT";
    for (const std::string wrong : {"-1", "3.5", "many", "99999999999999999999"})
        expect_ply_refusal("ply\nformat ascii 1.0\nelement vertex " + wrong,
                           ":3: the element \"vertex\" has the count \"" + wrong + "\"" + count);
    expect_ply_refusal("ply\nformat ascii 1.0\nelement vertex\n",
                       ":3: the element \"vertex\" has the count \"\"" + count);
    expect_ply_refusal("ply\nformat ascii 1.0\nproperty float x\n",
                       ":3: a property stands before any element; an element line must come first");
    const std::string types =
        "; allowed are char, uchar, short, ushort, int, uint, float, double, and int8 to float64.";
    const std::string start = "ply\nformat ascii 1.0\nelement vertex 1\n";
    expect_ply_refusal(start + "property flaot x\n",
                       ":4: the property's type is \"flaot\"" + types + " Did you mean \"float\"?");
    expect_ply_refusal(start + "property list uchar quaternion x\n",
                       ":4: the property's type is \"quaternion\"" + types);
    expect_ply_refusal(
        start + "property list float int x\n",
        ":4: a list's count is of a floating-point type; it must be of a whole-number type, such as uchar");
    expect_ply_refusal(start + "property float\n",
                       ":4: the property has no name; the form is: property TYPE NAME, or property list "
                       "COUNTTYPE TYPE NAME");
    expect_ply_refusal(start + "property float x\nproperty int x\n",
                       ":5: the property \"x\" is declared twice; once is right");
    expect_ply_refusal(start + "element vertex 2\n",
                       ":4: the element \"vertex\" is declared twice; once is right");
}

TEST(PlyFile, elements_that_lack_something) {
    expect_ply_refusal(text_file("element vertex 1\nproperty float x\nproperty float y\n", "0 0\n"),
                       ":3: the element vertex has no property z; it needs x, y and z");
    expect_ply_refusal(
        text_file(kVertices + "element face 1\nproperty int vertex_indices\n", kPlySquare + "3\n"),
        ":7: the element face has no list of vertices; it needs: property list uchar int vertex_indices");
    expect_ply_refusal(text_file(kFaces + kVertices, "3 0 1 2\n" + kPlySquare),
                       ":3: the element face stands before any vertex; the element vertex must come first");
    expect_ply_refusal(text_file("element nothing 1000000000000\n" + kVertices, kPlySquare),
                       ":3: the element nothing has rows but no property; it needs one");
}

TEST(PlyFile, absurd_counts_are_refused_before_any_allocation) {
    const std::string many =
        "element vertex 4000000000000\nproperty float x\nproperty float y\nproperty float z\n";
    expect_ply_refusal(text_file(many, kPlySquare),
                       ":3: the element vertex needs 4000000000000 rows of at least 6 bytes, but 24 bytes "
                       "are left; the count is wrong or "
                       "the file is cut off");
    expect_ply_refusal(binary_header(std::endian::little, many) + "1234",
                       ":3: the element vertex needs 4000000000000 rows of at least 12 bytes, but 4 bytes "
                       "are left; the count is wrong or "
                       "the file is cut off");
    expect_ply_refusal(binary_header(std::endian::big,
                                     "element hair 9223372036854775807\nproperty list uint double strand\n"),
                       ":3: the element hair needs 9223372036854775807 rows of at least 4 bytes, but 0 "
                       "bytes are left; the count is wrong or "
                       "the file is cut off");
    // A list whose length the file cannot hold, read and skipped.
    for (const std::string list : {"vertex_indices", "unused"}) {
        const std::string elements = kVertices + "element face 1\nproperty list uint int " + list +
                                     "\nproperty list uchar int vertex_index\n";
        Bytes body(std::endian::little);
        body.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}).add<std::uint32_t>({4294967295U, 0, 1, 2});
        expect_ply_refusal(
            binary_header(std::endian::little, elements) + body.content(),
            ": element face, row 1 of 1: the file ends too early: it is cut off, or the count is wrong");
    }
}

TEST(PlyFile, data_that_are_cut_off) {
    const std::string cut = "the file ends too early: it is cut off, or the count is wrong";
    expect_ply_refusal(text_file(kVertices, "0.0000 0 0\n1.00000 0 0\n1 1 0\n"),
                       ":10: element vertex, row 4 of 4: " + cut);
    expect_ply_refusal(
        text_file(kVertices, "0.0000 0 0\n1.00000 0 0\n1 1 0\n0.0 1"),
        ":11: element vertex, row 4 of 4: the line ends too early; it needs all values that the "
        "header declares");
    expect_ply_refusal(text_file(kVertices + kFaces, kPlySquare + "3 0 1\n"),
                       ":14: element face, row 1 of 1: the line ends too early; it needs all values that the "
                       "header declares");
    for (const std::endian order : kOrders) {
        Bytes body(order);
        body.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0})
            .add<std::uint8_t>({3})
            .add<std::int32_t>({0, 1});
        const std::string content = binary_header(order, kVertices + kFaces) + body.content();
        expect_ply_refusal(content, ": element face, row 1 of 1: " + cut);
        expect_ply_refusal(content.substr(0, content.size() - 5), ": element face, row 1 of 1: " + cut);
    }
}

TEST(PlyFile, every_shorter_file_is_refused) {
    for (const std::endian order : kOrders) {
        Bytes body(order);
        body.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0})
            .add<std::uint8_t>({3})
            .add<std::int32_t>({0, 1, 2});
        const std::string content = binary_header(order, kVertices + kFaces) + body.content();
        EXPECT_EQ(refusal(read_ply, content), "accepted");
        for (std::size_t size = 0; size < content.size(); ++size)
            EXPECT_NE(refusal(read_ply, std::string_view(content).substr(0, size)), "accepted") << size;
    }
}

TEST(PlyFile, wrong_values) {
    expect_ply_refusal(
        text_file(kVertices, "0 0 0\n1 nan 0\n1 1 0\n0 1 0\n"),
        ":9: element vertex, row 2 of 4: y is nan; it must be a finite number, at most 1e30 in size");
    expect_ply_refusal(
        text_file(kVertices, "0 0 0\n1 0 1e31\n1 1 0\n0 1 0\n"),
        ":9: element vertex, row 2 of 4: z is 1e+31; it must be a finite number, at most 1e30 in size");
    expect_ply_refusal(
        text_file(kVertices, "0 0 0 7\n1 0 1\n1 1 0\n0 1 0\n"),
        ":8: element vertex, row 1 of 4: \"7\" follows the last value; each row needs a line of its own");
    const auto face = [](const std::string& row) { return text_file(kVertices + kFaces, kPlySquare + row); };
    expect_ply_refusal(
        face("3 0 1 4\n"),
        ":14: element face, row 1 of 1: the vertex number is 4; it must be a whole number from 0 to 3");
    expect_ply_refusal(
        face("3 0 1 -1\n"),
        ":14: element face, row 1 of 1: the vertex number is -1; it must be a whole number from 0 to 3");
    expect_ply_refusal(
        face("3 0 1 1.5\n"),
        ":14: element face, row 1 of 1: the vertex number is 1.5; it must be a whole number from 0 to 3");
    expect_ply_refusal(face("0\n"),
                       ":14: element face, row 1 of 1: the face has no corners; it needs three or more");
    expect_ply_refusal(face("2 0 1\n"),
                       ": no triangle found (1 without area left out), so there is no surface; a PLY file "
                       "needs an element vertex and an element face (or tristrips)");
    expect_ply_refusal(
        face("-3 0 1 2\n"),
        ":14: element face, row 1 of 1: the list vertex_indices has the length -3; it must be a "
        "whole number, 0 or more");
    expect_ply_refusal(
        face("1e300 0 1 2\n"),
        ":14: element face, row 1 of 1: the list vertex_indices has the length 1e+300; it must be "
        "a whole number, 0 or more");
    for (const std::endian order : kOrders) {
        const float infinite = std::numeric_limits<float>::infinity();
        Bytes vertices(order);
        vertices.add<float>({0, 0, 0, 1, -infinite, 0, 1, 1, 0, 0, 1, 0});
        expect_ply_refusal(
            binary_header(order, kVertices) + vertices.content(),
            ": element vertex, row 2 of 4: y is -inf; it must be a finite number, at most 1e30 in size");
        Bytes strips(order);
        strips.add<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}).add<std::int8_t>({-2}).add<std::int32_t>({0});
        expect_ply_refusal(
            binary_header(order, kVertices + "element tristrips 1\nproperty list char int vertex_indices\n") +
                strips.content(),
            ": element tristrips, row 1 of 1: the list vertex_indices has the length -2; it must be a whole "
            "number, 0 or more");
    }
}

TEST(PlyFile, what_follows_the_last_row) {
    const std::string file = text_file(kVertices + kFaces, kPlySquare + "3 0 1 2\n");
    EXPECT_EQ(refusal(read_ply, file + "\n \r\n"), "accepted");
    expect_ply_refusal(
        file + "3 0 2 3\n",
        ": 8 bytes follow the last row that the header declares; its counts are wrong or the file "
        "is damaged");
}

TEST(PlyFile, no_triangle) {
    const std::string remedy =
        ", so there is no surface; a PLY file needs an element vertex and an element face (or tristrips)";
    expect_ply_refusal(text_file(kVertices, kPlySquare), ": no triangle found" + remedy);
    expect_ply_refusal(text_file(kVertices + kFaces, kPlySquare + "3 0 1 1\n"),
                       ": no triangle found (1 without area left out)" + remedy);
}

TEST(PlyFile, igea_is_a_closed_head) {
    if (!std::filesystem::exists(shared_mesh("igea.ply"))) GTEST_SKIP() << "../shared/data/meshes is absent";
    const MeshFile file = read_mesh_file(shared_mesh("igea.ply"));
    EXPECT_EQ(file.mesh.vertices.size(), 134345U);
    EXPECT_EQ(file.mesh.triangles.size(), 2 * 134345U - 4);  // Euler: a closed surface without handles
    EXPECT_EQ(file.degenerate_triangles, 0U);
    EXPECT_EQ(open_edges(file.mesh), 0U);
    EXPECT_GT(enclosed_volume(file.mesh), 0);
}

}  // namespace
}  // namespace stilb::io
