#include "papers/head_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "fit/mesh_fit.h"
#include "geometry/harmonics/surface.h"
#include "io/mesh/harmonics_file.h"
#include "io/mesh_checks.h"
#include "support/source_directory.h"

namespace stilb::papers {
namespace {

TEST(HeadShape, HasASizeInAllDirections) {
    for (const Vec3& direction : geometry::even_grid(60).directions()) {
        EXPECT_GT(head_radius(direction), 0.06);
        EXPECT_LT(head_radius(direction), 0.19);
    }
}

TEST(HeadShape, IsTheSameOnBothSides) {
    for (const Vec3& d : geometry::even_grid(20).directions())
        EXPECT_NEAR(head_radius(d), head_radius({-d.x, d.y, d.z}), 1e-12);
}

TEST(HeadShape, TheNoseIsFoundInFront) {
    const auto at = [](double azimuth_deg, double elevation_deg) {
        const double a = azimuth_deg * M_PI / 180, e = elevation_deg * M_PI / 180;
        return head_radius({std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)});
    };
    EXPECT_GT(at(0, -17), 1.15 * at(20, -17));
    EXPECT_GT(at(0, -17), 1.05 * at(0, -28));
}

TEST(HeadShape, TheMeshIsClosedAndItsFrontsAreSeenFromOutsideOnly) {
    const Mesh mesh = head_mesh();
    EXPECT_EQ(mesh.triangles.size(), 32648U);
    EXPECT_EQ(mesh.vertices.size(), 16326U);  // Euler: vertices - edges + faces = 2
    EXPECT_EQ(io::open_edges(mesh), 0U);
    for (const Triangle& t : mesh.triangles) {
        const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
        EXPECT_GT(dot(a, cross(b - a, c - a)), 0);
    }
}

TEST(HeadShape, TheSceneHasItsSeries) {
    const auto path = source_directory() / "scenes/head/head.json";
    const io::HarmonicsFile file = io::read_harmonics(path);
    const fit::MeshFit fit = fit::fit_mesh(head_mesh(), {.degree = 32, .center = file.center}, "head");
    ASSERT_EQ(file.coefficients.size(), fit.coefficients.size());
    for (std::size_t i = 0; i < fit.coefficients.size(); ++i)
        EXPECT_NEAR(file.coefficients[i], fit.coefficients[i], 1e-6) << i;  // the OBJ file has seven digits
}

}  // namespace
}  // namespace stilb::papers
