// The unit and the vertical axis of OBJ models.
#include "io/import/obj/unit_guess.h"

#include <gtest/gtest.h>

#include "io/text/text.h"

namespace stilb::io {
namespace {

/// A box of this size in units of the file, as one group.
void add_box(MeshFile& file, const std::string& group, const Vec3& min, const Vec3& max) {
    const Mesh box = triangulated(Box{min, max});
    const auto first = static_cast<std::uint32_t>(file.mesh.vertices.size());
    file.mesh.vertices.insert(file.mesh.vertices.end(), box.vertices.begin(), box.vertices.end());
    for (const auto& [a, b, c] : box.triangles) {
        file.mesh.triangles.push_back({first + a, first + b, first + c});
        file.group_of_triangle.push_back(static_cast<std::uint32_t>(file.group_names.size()));
    }
    file.group_names.push_back(group);
}

MeshFile room(double width, double depth, double height) {
    MeshFile file;
    add_box(file, "room", {0, 0, 0}, {width, depth, height});
    return file;
}

TEST(UnitGuess, FloorsAndCeilingsLieAcrossTheVertical) {
    EXPECT_EQ(guess_up(room(5, 4, 2.5)).up, UpAxis::z);
    EXPECT_EQ(guess_up(room(5, 2.5, 4)).up, UpAxis::y);
}

TEST(UnitGuess, AStoreyTellsTheUnit) {
    const auto scale = [](double height) {
        return guess_scale(room(2 * height, 2 * height, height), UpAxis::z).scale;
    };
    EXPECT_EQ(scale(2.5), 1);
    EXPECT_EQ(scale(12), 1);    // a hall in metres, though it could be a room in feet
    EXPECT_EQ(scale(0.75), 1);  // a table in metres
    EXPECT_EQ(scale(2500), 1e-3);
    EXPECT_EQ(scale(270), 1e-2);
    EXPECT_EQ(scale(108), 0.0254);  // 9 feet
    EXPECT_EQ(scale(1e7), 1);       // none
}

TEST(UnitGuess, ADoorDecides) {
    MeshFile hall = room(30, 40, 9);
    add_box(hall, "Entrance_Door", {0, 0, 0}, {3, 0.2, 6.8});  // 2.07 m in feet
    const ScaleGuess guess = guess_scale(hall, UpAxis::z);
    EXPECT_EQ(guess.scale, 0.3048);
    EXPECT_EQ(guess.reason, "scale = 0.3048 (feet), because a door is then 2.07 m high.");
}

TEST(Base64, IsReadBack) {
    for (const std::string text : {"", "a", "ab", "abc", "abcd", "\xff\x01\x80"}) {
        EXPECT_EQ(from_base64(base64(text)), text);
    }
    EXPECT_EQ(from_base64("a*b="), std::nullopt);
}

}  // namespace
}  // namespace stilb::io
