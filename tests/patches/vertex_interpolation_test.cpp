// Interpolation between patches: right where surfaces are smooth, and nothing leaks across edges.
#include "patches/vertex_interpolation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "support/random_pairs.h"
#include "support/scene_builder.h"

namespace stilb::patches {
namespace {

/// Of which the values at patches are those of a function at their middles.
struct Field {
    Patches patches;
    VertexInterpolation interpolation{patches};
    std::vector<double> at_vertices;

    Field(const Scene& scene, double size_m, const std::function<double(const Vec3&)>& function)
        : patches(make_patches(scene, size_m)) {
        std::vector<double> of_patches;
        for (std::uint32_t p = 0; p < patches.count(); ++p) of_patches.push_back(function(patches.middle(p)));
        at_vertices = interpolation.at_vertices<double>(of_patches);
    }
    double at(std::uint32_t patch, const math::Barycentric& place) const {
        return interpolation.at<double>(at_vertices, patch, place);
    }
};

constexpr std::array<math::Barycentric, 4> kPlaces{
    {{1, 0, 0}, {0, 1, 0}, {0.2, 0.5, 0.3}, {1. / 3, 1. / 3, 1. / 3}}};

/// The largest error over places of patches; `counts` says where to look.
double largest_error(const Field& field, const std::function<double(const Vec3&)>& function,
                     const std::function<bool(const Vec3&)>& counts) {
    double largest = 0;
    for (std::uint32_t p = 0; p < field.patches.count(); ++p) {
        if (!counts(field.patches.middle(p))) continue;
        for (const math::Barycentric& place : kPlaces) {
            const double expected = function(field.patches.position(p, place));
            largest = std::max(largest, std::abs(field.at(p, place) - expected));
        }
    }
    return largest;
}

bool everywhere(const Vec3&) { return true; }

/// The unit square in uneven triangles: a grid whose inner vertices are moved, of which edges are then halved
/// here and not there.
Mesh uneven_square() {
    constexpr std::uint32_t n = 9;
    Mesh mesh;
    RandomPairs random(5);
    for (std::uint32_t j = 0; j <= n; ++j) {
        for (std::uint32_t i = 0; i <= n; ++i) {
            const bool is_inner = i > 0 && i < n && j > 0 && j < n;
            const auto [u, v] = random.next_pair();
            const double dx = is_inner ? 0.4 * (u - 0.5) : 0, dy = is_inner ? 0.4 * (v - 0.5) : 0;
            mesh.vertices.push_back({(i + dx) / n, (j + dy) / n, 0.5});
        }
    }
    for (std::uint32_t j = 0; j < n; ++j) {
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i;
            mesh.triangles.push_back({a, a + 1, a + n + 2});
            mesh.triangles.push_back({a, a + n + 2, a + n + 1});
        }
    }
    return mesh;
}

Scene scene_with(const Shape& shape) {
    Scene scene;
    add_object(scene, shape, diffuse(0.5));
    return scene;
}

TEST(VertexInterpolation, KeepsConstants) {
    Scene scene = scene_with(uneven_square());
    add_object(scene, Sphere{{2, 2, 2}, 1}, diffuse(0.5));
    add_object(scene, Box{{4, 4, 4}, {5, 6, 7}}, diffuse(0.5));
    const auto three = [](const Vec3&) { return 3.0; };
    EXPECT_LT(largest_error(Field(scene, 0.13, three), three, everywhere), 1e-5);
}

TEST(VertexInterpolation, IsExactForLinearFunctionsAwayFromRims) {
    const auto linear = [](const Vec3& p) { return 2 + 3 * p.x - 5 * p.y; };
    const auto is_inner = [](const Vec3& p) {
        return std::min({p.x, p.y, 1 - p.x, 1 - p.y}) > 0.15;  // more than one patch
    };
    for (const double size_m : {0.2, 0.1, 0.05}) {
        const Field field(scene_with(uneven_square()), size_m, linear);
        EXPECT_LT(largest_error(field, linear, is_inner), 1e-5) << size_m;
        EXPECT_LT(largest_error(field, linear, everywhere), 8 * size_m)
            << "first order along rims: " << size_m;
    }
}

/// A linear function of space is curved over a sphere: the error is of second order.
TEST(VertexInterpolation, IsOfSecondOrderOnRoundSurfaces) {
    const auto height = [](const Vec3& p) { return p.z; };
    const auto error = [&](double size_m) {
        return largest_error(Field(scene_with(Sphere{{0, 0, 0}, 1}), size_m, height), height, everywhere);
    };
    EXPECT_LT(error(0.1), 0.01);
    EXPECT_GT(error(0.1) / error(0.025), 10);
}

/// Two triangles with a common edge.
TEST(SmoothVertices, AreDividedBeyondFortyDegrees) {
    const std::array<Triangle, 2> triangles{{{0, 1, 2}, {1, 0, 3}}};
    const std::array<MaterialId, 2> materials{};
    const auto count_at = [&](double angle_deg) {
        const double angle = angle_deg * kPi / 180;
        const std::array<Vec3, 2> normals{{{0, 0, 1}, {0, std::sin(angle), std::cos(angle)}}};
        return divide_at_creases(triangles, normals, materials).original.size();
    };
    EXPECT_EQ(count_at(39.99), 4u);
    EXPECT_EQ(count_at(40.01), 6u);
}

TEST(VertexInterpolation, StaysBetweenThePatchesAround) {
    const auto step = [](const Vec3& p) { return p.x < 0.43 ? 0.0 : 1.0; };
    const Field field(scene_with(uneven_square()), 0.07, step);
    const auto [least, most] = std::ranges::minmax(field.at_vertices);
    EXPECT_GE(least, 0);
    EXPECT_LE(most, 1 + 1e-6);
}

/// Each face of a box has a value of its own, and so has each of two materials in one plane.
TEST(VertexInterpolation, DoesNotLeakAcrossEdgesAndMaterials) {
    const auto face = [](const Vec3& p) {
        constexpr double e = 1e-6;
        return p.x < e ? 1.0 : p.x > 1 - e ? 2.0 : p.y < e ? 3.0 : p.y > 1 - e ? 4.0 : p.z < e ? 5.0 : 6.0;
    };
    const Field box(scene_with(Box{{0, 0, 0}, {1, 1, 1}}), 0.1, face);
    for (std::uint32_t p = 0; p < box.patches.count(); ++p) {
        for (const math::Barycentric& place : kPlaces)
            EXPECT_NEAR(box.at(p, place), face(box.patches.middle(p)), 1e-5);
    }

    Scene scene;
    const MaterialId first = add_material(scene, diffuse(0.5)), second = add_material(scene, diffuse(0.6));
    const Mesh square = triangulated(Rectangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    scene.objects.push_back({"two materials", square, {first, second}});
    const auto half = [](const Vec3& p) { return p.x > p.y ? 1.0 : 2.0; };
    const Field materials(scene, 0.1, half);
    for (std::uint32_t p = 0; p < materials.patches.count(); ++p) {
        for (const math::Barycentric& place : kPlaces) {
            EXPECT_NEAR(materials.at(p, place), half(materials.patches.middle(p)), 1e-5);
        }
    }
}

/// A fold that ends in the middle of a plane: the patches around its end are one smooth surface, yet nothing
/// passes from side to side along the fold.
TEST(VertexInterpolation, DoesNotLeakAcrossAFoldThatEnds) {
    // The fold runs from (0, 0, 0) to (0, 1, 0.3): two faces rise to it, the others lie in the plane around.
    const Mesh mesh{{{0, 0, 0}, {0, 1, 0.3}, {-0.5, 1, 0}, {0.5, 1, 0}, {-1, -1, 0}, {1, -1, 0}},
                    {{0, 1, 2}, {0, 3, 1}, {0, 2, 4}, {0, 4, 5}, {0, 5, 3}}};
    const auto side = [](const Vec3& p) { return p.x < 0 ? 1.0 : 2.0; };
    const Field field(scene_with(mesh), 0.1, side);
    const auto is_end = [&](const Float3& v) { return length(field.patches.center + Vec3(v)) < 1e-6; };
    EXPECT_EQ(std::ranges::count_if(field.patches.vertices, is_end), 1);
    for (std::uint32_t p = 0; p < field.patches.count(); ++p) {
        const Vec3 middle = field.patches.middle(p);
        if (middle.z < 0.05) continue;  // the faces that rise, away from where the fold ends
        for (const math::Barycentric& place : kPlaces) EXPECT_NEAR(field.at(p, place), side(middle), 1e-5);
    }
}

/// Twelve sides are round, six are edges.
TEST(VertexInterpolation, KnowsRoundFromEdged) {
    const auto vertices_at_a_place = [](std::uint32_t sides) {
        Mesh tube;
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            tube.vertices.push_back({std::cos(angle), std::sin(angle), 0});
            tube.vertices.push_back({std::cos(angle), std::sin(angle), 1});
            const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
            tube.triangles.push_back({a, b, b + 1});
            tube.triangles.push_back({a, b + 1, a + 1});
        }
        return make_patches(scene_with(tube), 10).vertices.size() / (2 * sides);
    };
    EXPECT_EQ(vertices_at_a_place(12), 1u);
    EXPECT_EQ(vertices_at_a_place(6), 2u);
}

TEST(VertexInterpolation, TakesAnythingThatCanBeAveraged) {
    const Patches patches = make_patches(scene_with(Sphere{{0, 0, 0}, 1}), 0.2);
    const VertexInterpolation interpolation(patches);
    const std::vector<Rgb> colours(patches.count(), Rgb{{1, 2, 3}});
    const std::vector<Vec3> normals(patches.count(), Vec3{3, 2, 1});
    const auto colour_at_vertices = interpolation.at_vertices<Rgb>(colours);
    const auto normal_at_vertices = interpolation.at_vertices<Vec3>(normals);
    const math::Barycentric place{0.5, 0.2, 0.3};
    EXPECT_NEAR(interpolation.at<Rgb>(colour_at_vertices, 7, place).band[1], 2, 1e-6);
    EXPECT_NEAR(interpolation.at<Vec3>(normal_at_vertices, 7, place).x, 3, 1e-6);
}

}  // namespace
}  // namespace stilb::patches
