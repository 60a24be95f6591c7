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
    EXPECT_EQ(guess_placement(room(5, 4, 2.5)).up, UpAxis::z);
    EXPECT_EQ(guess_placement(room(5, 2.5, 4)).up, UpAxis::y);
}

PlacementGuess with_z_up(const MeshFile& file) {
    ImportOptions options;
    options.up = UpAxis::z;
    return guess_placement(file, options);
}

TEST(UnitGuess, AStoreyTellsTheUnit) {
    const auto scale = [](double height) { return with_z_up(room(2 * height, 2 * height, height)).scale; };
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
    const PlacementGuess guess = with_z_up(hall);
    EXPECT_EQ(guess.scale, 0.3048);
    EXPECT_EQ(guess.unit, "feet");
    EXPECT_EQ(guess.scale_reason, "because a door is then 2.07 m high");
}

/// A panel on four legs, y upwards.
MeshFile table(const Vec3& size) {
    MeshFile file;
    const double leg = 0.05 * size.x, top = 0.95 * size.y;
    add_box(file, "top", {0, top, 0}, size);
    for (const double x : {0.0, size.x - leg})
        for (const double z : {0.0, size.z - leg}) add_box(file, "leg", {x, 0, z}, {x + leg, top, z + leg});
    return file;
}

TEST(UnitGuess, FurnitureIsMostlyInCentimetresWithYUpwards) {
    for (const double metres : {1.0, 0.01}) {
        const PlacementGuess guess = guess_placement(table(Vec3{1.6, 0.75, 0.8} / metres));
        EXPECT_EQ(guess.scale, metres);
        EXPECT_EQ(guess.up, UpAxis::y);
        EXPECT_NEAR(guess.size_m.z, 0.75, 1e-9);
        EXPECT_EQ(guess.scale_reason, "because the model is then as large as furniture");
    }
    // A cupboard, whose sides are those of a room.
    MeshFile cupboard;
    add_box(cupboard, "", {0, 0, 0}, {92, 147, 36});
    EXPECT_EQ(guess_placement(cupboard).scale, 0.01);
    EXPECT_EQ(guess_placement(cupboard).up, UpAxis::y);
}

TEST(UnitGuess, ALevelSheetIsAFloor) {
    MeshFile sheet;
    sheet.mesh = {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
    sheet.group_names = {""};
    sheet.group_of_triangle = {0, 0};
    EXPECT_EQ(guess_placement(sheet).up, UpAxis::z);
    EXPECT_EQ(guess_placement(sheet).scale, 1);
}

TEST(UnitGuess, KeepsWhatIsStated) {
    ImportOptions options;
    options.scale = 0.01;
    EXPECT_EQ(guess_placement(room(5, 4, 2.5), options).scale, 0.01);
    options.up = UpAxis::y;
    EXPECT_EQ(guess_placement(room(5, 4, 2.5), options).up, UpAxis::y);
}

TEST(Base64, IsReadBack) {
    for (const std::string text : {"", "a", "ab", "abc", "abcd", "\xff\x01\x80"}) {
        EXPECT_EQ(from_base64(base64(text)), text);
    }
    EXPECT_EQ(from_base64("a*b="), std::nullopt);
}

}  // namespace
}  // namespace stilb::io
