// Patches cover the surfaces, whole and without T-junctions.
#include "patches/patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "geometry/harmonics/surface.h"
#include "geometry/mesh_topology.h"
#include "materials/mirror.h"
#include "stilb/error.h"
#include "support/closed_meshes.h"
#include "support/harmonic_shapes.h"
#include "support/scene_builder.h"

namespace stilb::patches {
namespace {

Scene scene_of(const Shape& shape) {
    Scene scene;
    add_object(scene, shape, diffuse(0.5));
    return scene;
}

double total_area_m2(const Patches& patches) {
    double sum = 0;
    for (const float area : patches.areas_m2) sum += area;
    return sum;
}

std::array<double, 3> edge_lengths(const Patches& patches, std::uint32_t patch) {
    const auto& [a, b, c] = patches.corners[patch];
    const Vec3 u(patches.vertices[a]), v(patches.vertices[b]), w(patches.vertices[c]);
    return {length(v - u), length(w - v), length(u - w)};
}

struct EdgeCounts {
    std::size_t shared_by_two = 0, others = 0;
};

/// Edges between places, whichever vertices stand there; shared ones must be run along in both directions.
EdgeCounts edges_between_places(const Patches& patches) {
    std::vector<Vec3> places;
    for (const Float3& vertex : patches.vertices) places.emplace_back(vertex);
    EdgeCounts counts;
    geometry::Edges(patches.corners, geometry::welded(places)).for_each([&](auto first, auto last) {
        const bool is_shared = last - first == 2 && first[0].upwards != first[1].upwards;
        ++(is_shared ? counts.shared_by_two : counts.others);
    });
    return counts;
}

TEST(Patches, FlatSurfacesKeepTheirArea) {
    const Mesh polygon{{{0, 0, 1}, {3, 0.1, 1}, {3.3, 2, 1}, {1, 2.7, 1}, {-0.5, 1, 1}},
                       {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}};
    const std::array<Shape, 4> shapes{polygon, Rectangle{{9, 2, 1}, {3, 1, 0}, {0, 1, 2}},
                                      Box{{-1, -2, 0}, {5, 1, 0.01}}, acute_wedge(3).mesh};
    for (const Shape& shape : shapes) {
        for (const double size_m : {10.0, 0.3, 0.04}) {
            const double area = total_area_m2(make_patches(scene_of(shape), size_m));
            EXPECT_NEAR(area, area_m2(shape), 2e-7 * area_m2(shape)) << shape.index() << ", " << size_m;
        }
    }
}

TEST(Patches, InstancesAreDividedAsCopies) {
    const auto mesh = std::make_shared<const Mesh>(icosphere({{}, 1}, 1));
    const geometry::Transform mirrored{{-1, 0, 0}, {0, 2, 0.3}, {0, 0, 1}, {4, 5, 6}};
    Scene instance, copy;
    add_object(instance, Instance{mesh, mirrored}, diffuse(0.5));
    add_object(copy, triangulated(Instance{mesh, mirrored}), diffuse(0.5));
    const Patches a = make_patches(instance, 0.4), b = make_patches(copy, 0.4);
    EXPECT_GT(a.count(), 500u);
    EXPECT_EQ(a.corners, b.corners);
    EXPECT_EQ(a.count(), b.count());
    for (std::uint32_t p = 0; p < a.count(); ++p) EXPECT_EQ(a.middle(p), b.middle(p));
}

/// Inscribed polygons: the missing area goes with the square of the edges.
TEST(Patches, RoundSurfacesComeCloserWithTheSquareOfTheSize) {
    const std::array<Shape, 2> shapes{Sphere{{1, 2, 3}, 0.5},
                                      Disk{{1, 2, 3}, normalized(Vec3{1, 1, 1}), 0.5}};
    for (const Shape& shape : shapes) {
        const auto missing = [&](double size_m) {
            return 1 - total_area_m2(make_patches(scene_of(shape), size_m)) / area_m2(shape);
        };
        EXPECT_LT(missing(10), 0.025) << "the coarsest, however large the size";
        // Edges of a division are 2^-k of the coarsest: sizes a factor of 4 apart have edges that are, too.
        const double coarse = missing(0.1), fine = missing(0.025);
        EXPECT_GT(fine, 0);
        EXPECT_NEAR(coarse / fine, 16, 1);
    }
}

TEST(Patches, AllVerticesOfRoundSurfacesLieOnThem) {
    const Sphere sphere{{1, 2, 3}, 0.5};
    const Patches patches = make_patches(scene_of(sphere), 0.05);
    for (const Float3& vertex : patches.vertices) {
        EXPECT_NEAR(length(patches.center + Vec3(vertex) - sphere.center), sphere.radius, 1e-6);
    }
    const Disk disk{{1, 2, 3}, normalized(Vec3{1, 1, 1}), 0.5};
    const Patches flat = make_patches(scene_of(disk), 0.05);
    std::size_t on_rim = 0;
    for (const Float3& vertex : flat.vertices) {
        const Vec3 way = flat.center + Vec3(vertex) - disk.center;
        EXPECT_NEAR(dot(way, disk.normal), 0, 1e-6);
        EXPECT_LT(length(way), disk.radius + 1e-6);
        on_rim += length(way) > disk.radius - 1e-6 ? 1 : 0;
    }
    EXPECT_EQ(on_rim, 96u);  // 6, halved until 2 sin(pi / n) 0.5 m <= 0.05 m
}

/// Every edge of a closed surface belongs to exactly two patches, whose fronts lie on the same side.
TEST(Patches, ClosedSurfacesStayClosed) {
    for (const ClosedMeshEntry& entry : kClosedMeshes) {
        for (const double size_m : {1.0, 0.11, 0.03}) {
            const Patches patches = make_patches(scene_of(entry.make(2).mesh), size_m);
            const EdgeCounts edges = edges_between_places(patches);
            EXPECT_EQ(edges.others, 0u) << entry.name << ", " << size_m;
            EXPECT_EQ(2 * edges.shared_by_two, 3 * patches.count()) << entry.name << ", " << size_m;
        }
    }
    EXPECT_EQ(edges_between_places(make_patches(scene_of(Sphere{{1, 2, 3}, 0.7}), 0.04)).others, 0u);
}

/// Whether an edge is halved depends on its ends alone, so walls that are objects of their own fit together.
TEST(Patches, ObjectsThatShareAnEdgeShareItsVertices) {
    Scene scene;
    const Material grey = diffuse(0.5);
    add_walls(scene, {{0, 0, 0}, {4, 2.7, 3.1}}, {grey, grey, grey, grey, grey, grey});
    const Patches patches = make_patches(scene, 0.17);
    EXPECT_GT(patches.count(), 1000u);
    EXPECT_EQ(edges_between_places(patches).others, 0u);
}

TEST(Patches, NoEdgeIsLongerThanTheSizeAndFewAreMuchShorter) {
    Scene scene = scene_of(Box{{0, 0, 0}, {4, 3, 0.9}});
    add_object(scene, Sphere{{2, 2, 2}, 0.5}, diffuse(0.5));
    add_object(scene, acute_wedge(3).mesh, diffuse(0.5));
    add_object(scene, Disk{{2, 2, 1}, {0, 0, 1}, 0.8}, diffuse(0.5));
    const double size_m = 0.1;
    const Patches patches = make_patches(scene, size_m);
    double sum_m = 0;
    for (std::uint32_t p = 0; p < patches.count(); ++p) {
        const auto lengths = edge_lengths(patches, p);
        EXPECT_LE(std::ranges::max(lengths), size_m * (1 + 1e-6));
        sum_m += std::ranges::max(lengths);
    }
    EXPECT_GT(sum_m / static_cast<double>(patches.count()), size_m / 2);
}

/// Halving at the longest edge: right-angled isosceles triangles stay what they are, those of the icosahedron
/// keep most of their angles.
TEST(Patches, AnglesStayLarge) {
    const auto smallest_sine = [](const Shape& shape, double size_m) {
        const Patches patches = make_patches(scene_of(shape), size_m);
        double least = 1;
        for (std::uint32_t p = 0; p < patches.count(); ++p) {
            auto l = edge_lengths(patches, p);
            std::ranges::sort(l);
            least = std::min(least, 2 * patches.areas_m2[p] / (l[1] * l[2]));
        }
        return least;
    };
    for (const double size_m : {0.5, 0.3, 0.1, 0.03}) {
        EXPECT_NEAR(smallest_sine(Box{{0, 0, 0}, {1, 1, 1}}, size_m), std::numbers::sqrt2 / 2, 1e-4);
        EXPECT_GT(smallest_sine(Sphere{{0, 0, 0}, 1}, size_m), 0.45);
    }
}

TEST(Patches, FrontsStayFronts) {
    const std::array<Shape, 3> shapes{Box{{-1, -1, -1}, {1, 1, 1}}, Sphere{{0, 0, 0}, 1},
                                      icosphere({{}, 1}, 1)};
    for (const Shape& shape : shapes) {
        const Patches patches = make_patches(scene_of(shape), 0.2);
        const auto count = static_cast<std::uint32_t>(patches.count());
        for (std::uint32_t p = 0; p < count; ++p) {
            EXPECT_GT(dot(patches.normal_of(p), patches.middle(p)), 0.8 * length(patches.middle(p)) / 2);
            const auto& [a, b, c] = patches.corners[p];
            const Vec3 u(patches.vertices[a]), v(patches.vertices[b]), w(patches.vertices[c]);
            EXPECT_NEAR(dot(normalized(cross(v - u, w - u)), patches.normal_of(p)), 1, 1e-6);
            EXPECT_EQ(patches.other_side(p), p + count);
            EXPECT_EQ(patches.patch_of(p + count), p);
            EXPECT_EQ(patches.normal_of(p + count), -patches.normal_of(p));
        }
    }
}

TEST(Patches, KnowTheirObjectAndMaterial) {
    Scene scene = scene_of(Rectangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const MaterialId glossy = add_material(scene, Mirror{}), other = add_material(scene, diffuse(0.2));
    const Mesh two{{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {2, 2, 1}},
                   {{0, 1, 2}, {0, 0, 4}, {0, 2, 3}}};  // the one in the middle has no area
    scene.objects.push_back({"two materials", two, {glossy, glossy, other}});
    add_area_light(scene, Sphere{{0, 0, 3}, 0.2}, Rgb::grey(1));
    const Patches patches = make_patches(scene, 0.1);
    ASSERT_EQ(patches.first_of_object.size(), 4u);
    for (std::uint32_t p = 0; p < patches.count(); ++p) {
        const Vec3 middle = patches.middle(p);
        const std::uint32_t object = middle.z > 2 ? 2 : middle.z > 0.5 ? 1 : 0;
        EXPECT_EQ(patches.object_of(p), ObjectId{object});
        const MaterialId in_mesh = middle.x > middle.y ? glossy : other;
        EXPECT_EQ(patches.materials[p], object == 1 ? in_mesh : scene.objects[object].materials[0]);
    }
}

TEST(Patches, TheSizeForACountMakesAboutSoMany) {
    Scene office = scene_of(Box{{0, 0, 0}, {5, 4, 2.8}});
    add_object(office, Box{{1, 1, 0.7}, {2.6, 1.8, 0.74}}, diffuse(0.5));
    add_object(office, Sphere{{4, 3, 1}, 0.4}, diffuse(0.5));
    for (const double count : {1e4, 1e5}) {
        const auto made = static_cast<double>(make_patches(office, patch_size_m(office, count)).count());
        EXPECT_GT(made, count / 2);
        EXPECT_LT(made, count * 2);
    }
}

TEST(Patches, ASizeThatMakesNoSenseIsRefused) {
    const Scene scene = scene_of(Box{{0, 0, 0}, {4, 4, 4}});
    EXPECT_THROW(make_patches(scene, 0), InputError);
    EXPECT_THROW(make_patches(scene, std::nan("")), InputError);
    EXPECT_THROW(make_patches(scene, 1e-5), InputError);
    EXPECT_EQ(make_patches(Scene{}, 1).count(), 0u);
}

TEST(Patches, OfBodiesByHarmonicsAreClosedAndComeToTheSurface) {
    Harmonics body(rough_surface(8, 3));
    body.center = {1, 2, 3};
    body.scale = 0.5;
    double error_before = 1;
    for (const double size_m : {0.2, 0.1, 0.05}) {
        const Patches patches = make_patches(scene_of(body), size_m);
        EXPECT_EQ(edges_between_places(patches).others, 0u);
        for (const Float3& vertex : patches.vertices) {
            const Vec3 place = Vec3(vertex) + patches.center;
            EXPECT_LT(length(body.point_towards(place - body.center) - place), 1e-6);
        }
        const double error = std::abs(total_area_m2(patches) / area_m2(body) - 1);
        EXPECT_LT(error, 0.5 * error_before) << size_m;
        error_before = error;
    }
    EXPECT_LT(error_before, 0.01);
}

}  // namespace
}  // namespace stilb::patches
