#include "fit/mesh_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "stilb/error.h"
#include "support/harmonic_shapes.h"
#include "support/prisms.h"
#include "support/scene_builder.h"

namespace stilb::fit {
namespace {

const Vec3 kCenter{0.3, -2, 5};

std::string refusal(const Mesh& mesh, const MeshFitOptions& options) {
    try {
        fit_mesh(mesh, options, "mesh.ply");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

void expect_parts(const std::string& message, const std::vector<std::string>& parts) {
    for (const std::string& part : parts)
        EXPECT_NE(message.find(part), std::string::npos) << part << "\n" << message;
}

/// Vertices on the surface about kCenter.
Mesh mesh_of(const geometry::HarmonicSurface& surface, int subdivisions) {
    Mesh mesh = icosphere({{}, 1}, subdivisions);
    for (Vec3& vertex : mesh.vertices) vertex = kCenter + surface.radius().at(vertex) * vertex;
    return mesh;
}

double largest_difference(std::span<const double> a, std::span<const double> b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

std::vector<double> rough_coefficients(int degree) {
    Numbers numbers(8);
    std::vector<double> coefficients(math::harmonic_count(degree));
    for (double& c : coefficients) c = (numbers.next() - 0.5) * 1.6 / (degree + 1);
    coefficients[0] = kUnitSphere;
    return coefficients;
}

/// What is left is that triangles lie inside arcs: a quarter for every division.
TEST(MeshFit, GivesBackTheSeriesThatAMeshWasMadeOf) {
    constexpr int degree = 8;
    const std::vector<double> truth = rough_coefficients(degree);
    const geometry::HarmonicSurface surface{math::HarmonicSeries<double>(truth)};
    std::vector<double> off;
    for (const int subdivisions : {5, 6}) {
        const MeshFit fit =
            fit_mesh(mesh_of(surface, subdivisions), {.degree = degree, .center = kCenter}, "");
        off.push_back(largest_difference(fit.coefficients, truth));
        EXPECT_EQ(fit.survey.share(), 0);
        EXPECT_LT(fit.errors.back().rms, 1e-3);
    }
    EXPECT_LT(off[1], 1.5e-3);
    EXPECT_NEAR(off[0] / off[1], 4, 0.5);
}

TEST(MeshFit, OfASphereIsOneCoefficient) {
    const MeshFit fit = fit_mesh(icosphere({kCenter, 2}, 6), {.degree = 6}, "");
    EXPECT_NEAR(length(fit.center - kCenter), 0, 1e-3);
    EXPECT_GT(*fit.margin, 1.99);
    EXPECT_NEAR(fit.coefficients[0], 2 * kUnitSphere, 1e-3);
    for (std::size_t i = 1; i < fit.coefficients.size(); ++i) EXPECT_NEAR(fit.coefficients[i], 0, 2e-3);
    EXPECT_NEAR(fit.size, 4, 1e-2);
}

TEST(MeshFit, OfASphereOffItsCentreIsItsDistanceFromThere) {
    const Vec3 offset{0.3, -0.2, 0.1};
    const MeshFit fit = fit_mesh(icosphere({kCenter, 1}, 6), {.degree = 24, .center = kCenter - offset}, "");
    const math::HarmonicSeries<double> series(fit.coefficients);
    Numbers numbers(4);
    for (int i = 0; i < 500; ++i) {
        const Vec3 direction = numbers.direction();
        const double along = dot(direction, offset);
        const double exact = along + std::sqrt(1 - squared_length(offset) + along * along);
        ASSERT_NEAR(series.at(direction), exact, 3e-4);
    }
    EXPECT_LT(fit.errors[24].rms, fit.errors[4].rms);
}

TEST(MeshFit, RefusesWhatIsNotStarShaped) {
    const std::string message = refusal(u_prism(), {.degree = 8});
    expect_parts(message, {"mesh.ply: not star-shaped about (",
                           "% of the directions meet the surface more than once", "0.5 % are tolerated",
                           "theta", "phi", "% of the size between", "center", "force", "tolerance"});
}

/// Seen from the middle of its base, each arm of the U hides behind the wall of the gap: directions towards
/// the far ends of the arms are the worst.
TEST(MeshFit, TakesTheOutermostSurfaceOnRequest) {
    const MeshFit fit = fit_mesh(
        u_prism(), {.degree = 6, .center = Vec3{1.5, 0.5, 0.5}, .otherwise = NotStarShaped::take_outermost},
        "");
    EXPECT_GT(fit.survey.folded_share, 0.02);
    ASSERT_FALSE(fit.survey.worst_folds.empty());
    const Fold worst = fit.survey.worst_folds[0];
    EXPECT_GT(worst.direction.y, 0.5);
    // From (1.5, 0.5) past the corner (1, 1) and out of the arm's outer wall at (0, 2): in between lies the
    // gap's corner only; steeper ways cross the gap.
    EXPECT_GT(worst.depth, 1);
    const math::HarmonicSeries<double> series(fit.coefficients);
    EXPECT_GT(series.at(normalized(Vec3{-1, 2.4, 0})), 1.5);
}

TEST(MeshFit, NamesHolesAndClosesThem) {
    Mesh mesh = icosphere({kCenter, 1}, 5);
    std::erase_if(mesh.triangles, [&](const Triangle& t) { return mesh.vertices[t[0]].z > kCenter.z + 0.9; });
    MeshFitOptions options{.degree = 10, .center = kCenter};
    expect_parts(refusal(mesh, options), {"% do not meet it", "theta", "no surface"});
    options.tolerated_share = 0.1;
    const MeshFit fit = fit_mesh(mesh, options, "");
    EXPECT_NEAR(fit.survey.missed_share, 0.05, 0.01);
    EXPECT_GT(fit.survey.misses.at(0).z, 0.85);
    EXPECT_NEAR(fit.coefficients[0], kUnitSphere, 2e-3);
    EXPECT_LT(fit.errors.back().maximum, 2e-3);
}

TEST(MeshFit, CountsShellsWithinEachOther) {
    Mesh mesh = icosphere({{}, 1}, 3);
    const Mesh inner = icosphere({{}, 0.4}, 3);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), inner.vertices.begin(), inner.vertices.end());
    for (const auto& [a, b, c] : inner.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
    EXPECT_EQ(refusal(mesh, {.degree = 2}).find("tolerance "), std::string::npos);  // none would do
    const MeshFit fit = fit_mesh(mesh, {.degree = 2, .otherwise = NotStarShaped::take_outermost}, "");
    EXPECT_NEAR(fit.survey.folded_share, 1, 1e-12);
    EXPECT_NEAR(fit.survey.worst_folds[0].depth, 0.6, 0.01);
    EXPECT_NEAR(fit.coefficients[0], kUnitSphere, 0.05);
}

TEST(MeshFit, WantsItsCentreInside) {
    expect_parts(refusal(icosphere({{}, 1}, 3), {.degree = 4, .center = Vec3{1e4, 0, 0}}),
                 {"mesh.ply: ", "do not meet", "center inside"});
    expect_parts(refusal(icosphere({{}, 1}, 3), {.degree = 4, .center = Vec3{5, 0, 0}}), {"not star-shaped"});
}

/// Close to a corner of a long box low degrees swing below 0.
TEST(MeshFit, NamesTheWayOutWhereTheRadiusComesToZero) {
    const Mesh box = triangulated(Box{{0, 0, 0}, {20, 1, 1}});
    expect_parts(refusal(box, {.degree = 6, .center = Vec3{0.02, 0.02, 0.02}}),
                 {"mesh.ply: the series of degree 6", "center", "lower degree"});
}

/// Poles and axes are where rays run along coordinate planes.
TEST(RadialCaster, LosesNoRayOfAClosedMesh) {
    const RadialCaster caster(icosphere({{0.01, 0.02, 0.03}, 1}, 5));
    for (const Vec3& center : {Vec3{0, 0, 0}, Vec3{0.1, -0.2, 0.05}}) {
        const std::vector<Vec3> directions = geometry::even_grid(317).directions();
        const std::vector<double> outer = caster.outermost(center, directions);
        const std::vector<double> inner = caster.innermost(center, directions);
        for (std::size_t i = 0; i < outer.size(); ++i) ASSERT_NEAR(outer[i], inner[i], 2e-6) << i;
    }
}

}  // namespace
}  // namespace stilb::fit
