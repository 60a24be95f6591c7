#include <gtest/gtest.h>

#include <cmath>

#include "checks/checks.h"
#include "materials/black.h"
#include "support/scene_builder.h"

namespace stilb::checks {
namespace {

/// A sphere of 20 x 40 cells, closed.
Mesh ball() {
    constexpr std::uint32_t rings = 20, sectors = 40;
    constexpr double pi = 3.14159265358979;
    Mesh mesh;
    mesh.vertices = {{0, 0, 1}, {0, 0, -1}};
    const auto at = [](std::uint32_t ring, std::uint32_t sector) {
        return 2 + (ring - 1) * sectors + sector % sectors;
    };
    for (std::uint32_t r = 1; r < rings; ++r) {
        for (std::uint32_t s = 0; s < sectors; ++s) {
            const double theta = pi * r / rings, phi = 2 * pi * s / sectors;
            mesh.vertices.push_back(
                {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
        }
    }
    for (std::uint32_t s = 0; s < sectors; ++s) {
        mesh.triangles.push_back({0, at(1, s), at(1, s + 1)});
        mesh.triangles.push_back({1, at(rings - 1, s + 1), at(rings - 1, s)});
        for (std::uint32_t r = 1; r + 1 < rings; ++r) {
            mesh.triangles.push_back({at(r, s), at(r + 1, s), at(r + 1, s + 1)});
            mesh.triangles.push_back({at(r, s), at(r + 1, s + 1), at(r, s + 1)});
        }
    }
    return mesh;
}

std::vector<std::string> warnings_of(const Mesh& mesh, const std::vector<Light>& lights = {}) {
    Scene scene;
    add_object(scene, mesh, Black{});
    scene.lights = lights;
    return hole_warnings(scene, {find_components(mesh)});
}

TEST(Holes, NoneInAClosedMesh) { EXPECT_TRUE(warnings_of(ball()).empty()); }

TEST(Holes, AMissingTriangle) {
    Mesh mesh = ball();
    mesh.triangles.erase(mesh.triangles.begin() + 100);
    const auto warnings = warnings_of(mesh);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("it nearly closes, except for 3 open edges"), std::string::npos)
        << warnings[0];
}

TEST(Holes, SheetsAndOpenBoxesAreMeantSo) {
    EXPECT_TRUE(warnings_of(triangulated(Rectangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})).empty());
    Mesh box = triangulated(Box{{0, 0, 0}, {1, 1, 1}});
    box.triangles.erase(box.triangles.begin(), box.triangles.begin() + 2);
    EXPECT_TRUE(warnings_of(box).empty());
}

/// Both ends of a tube have opposite vector areas, but are no small holes.
TEST(Holes, TubesAreMeantSo) {
    constexpr std::uint32_t sides = 24;
    Mesh tube;
    for (std::uint32_t s = 0; s < sides; ++s) {
        const double phi = 2 * 3.14159265358979 * s / sides;
        for (const double z : {0.0, 1.0})
            tube.vertices.push_back({0.1 * std::cos(phi), 0.1 * std::sin(phi), z});
        const std::uint32_t a = 2 * s, b = 2 * ((s + 1) % sides);
        tube.triangles.push_back({a, b, b + 1});
        tube.triangles.push_back({a, b + 1, a + 1});
    }
    EXPECT_TRUE(warnings_of(tube).empty());
}

TEST(Holes, ManyObjectsAreOneSentence) {
    Mesh mesh = ball();
    mesh.triangles.erase(mesh.triangles.begin() + 100);
    Scene scene;
    scene.materials = {{"wall", Black{}}};
    std::vector<geometry::ConnectedComponents> components;
    for (const char* name : {"a", "b", "c", "d"}) {
        scene.objects.push_back({name, mesh, {MaterialId{0}}});
        components.push_back(find_components(mesh));
    }
    const auto warnings = hole_warnings(scene, components);
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_EQ(warnings[0].substr(0, 80),
              "objects \"a\", \"b\", \"c\" and 1 more: they or parts of them nearly close, except for");
    EXPECT_NE(warnings[0].find("12 open edges"), std::string::npos);
}

TEST(Holes, AnEmittersFrontsMustFaceOneSide) {
    Mesh mesh = ball();
    std::swap(mesh.triangles[100][0], mesh.triangles[100][1]);
    EXPECT_TRUE(warnings_of(mesh).empty());
    const auto warnings = warnings_of(mesh, {{"lamp", AreaLight{ObjectId{0}, Rgb::grey(1)}}});
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("light \"lamp\": at 3 edges"), std::string::npos) << warnings[0];
}

}  // namespace
}  // namespace stilb::checks
