// The display mesh: it fits together, is refined at shadows, and its direct light is that of run::measure.
#include "walk/display/display_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "base/parallel.h"
#include "math/random.h"
#include "run/run.h"
#include "stilb/error.h"
#include "walk/walk_rooms.h"

namespace stilb::walk {
namespace {

struct Probe {
    MeasuringPoint point;
    double interpolated_lx = 0, stated_error_lx = 0;
};

/// A point of a triangle, with what the page would show there.
Probe probe_in(const DisplayMesh& mesh, const Triangle& triangle, const math::Barycentric& at) {
    const std::array<double, 3> weights{at.b0, at.b1, at.b2};
    Probe probe;
    Vec3 normal;
    for (std::size_t i = 0; i < 3; ++i) {
        const DisplayVertex& vertex = mesh.vertices[triangle[i]];
        probe.point.position += weights[i] * vertex.position;
        normal += weights[i] * vertex.normal;
        for (std::size_t v = triangle[i]; v < mesh.direct_lx.size(); v += mesh.vertices.size())
            probe.interpolated_lx += weights[i] * mesh.direct_lx[v];
        probe.stated_error_lx += weights[i] * mesh.direct_error_lx[triangle[i]];
    }
    probe.point.normal = normalized(normal);
    return probe;
}

double area_m2(const DisplayMesh& mesh, const Triangle& t) {
    const Vec3& a = mesh.vertices[t[0]].position;
    return length(cross(mesh.vertices[t[1]].position - a, mesh.vertices[t[2]].position - a)) / 2;
}

/// Points spread evenly over the mesh's area.
std::vector<Probe> probes_on(const DisplayMesh& mesh, std::size_t count) {
    std::vector<double> areas;
    for (const Triangle& triangle : mesh.triangles) areas.push_back(area_m2(mesh, triangle));
    const math::DiscreteDistribution by_area(areas);
    std::vector<Probe> probes;
    for (std::size_t i = 0; i < count; ++i) {
        math::SampleStream stream(math::RandomKey{5}, i);
        const std::size_t triangle = by_area.choose(stream.next()).index;
        const auto [u, v] = stream.next_two();
        probes.push_back(probe_in(mesh, mesh.triangles[triangle], math::sample_triangle(u, v)));
    }
    return probes;
}

std::vector<Reading> direct_readings(const Scene& scene, const std::vector<Probe>& probes) {
    IlluminancePoints points;
    for (const Probe& probe : probes) points.points.push_back(probe.point);
    RunOptions options;
    options.method = "path";
    options.bounces = 0;
    options.paths = 1024;
    const std::vector<Sensor> sensors{{"probes", points}};
    return run::measure(scene, sensors, options).sensors[0].readings;
}

struct Agreement {
    std::size_t close = 0, covered = 0, count = 0;
};

/// How many probes are within 2 % of the truth (and 1 % of the mean, where it is dark), and how many within
/// their stated error.
Agreement agreement(const std::vector<Probe>& probes, const std::vector<Reading>& readings) {
    double mean_lx = 0;
    for (const Reading& reading : readings)
        mean_lx += reading.estimate.value / static_cast<double>(readings.size());
    Agreement result;
    for (std::size_t i = 0; i < probes.size(); ++i) {
        const statistics::Estimate& truth = readings[i].estimate;
        const double noise_lx = (truth.upper - truth.lower) / 2;
        const double error_lx = std::abs(probes[i].interpolated_lx - truth.value);
        ++result.count;
        result.close += error_lx <= 0.02 * truth.value + 0.01 * mean_lx + noise_lx ? 1 : 0;
        result.covered += error_lx <= probes[i].stated_error_lx + noise_lx ? 1 : 0;
    }
    return result;
}

bool is_under_box(const Vec3& p) {
    return p.z < 1e-3 && p.x > kBox.min.x && p.x < kBox.max.x && p.y > kBox.min.y && p.y < kBox.max.y;
}

TEST(DisplayMesh, ShowsTheDirectLightWithinItsStatedError) {
    const DisplayedScene displayed(furnished_room(), 0.3);
    std::vector<Probe> probes = probes_on(displayed.mesh, 2000);
    std::erase_if(probes, [](const Probe& probe) { return is_under_box(probe.point.position); });
    const Agreement found = agreement(probes, direct_readings(displayed.scene, probes));
    EXPECT_GE(static_cast<double>(found.close), 0.95 * static_cast<double>(found.count));
    EXPECT_GE(static_cast<double>(found.covered), 0.9 * static_cast<double>(found.count));
}

/// Edges by the positions of their ends, with the number of triangles on each.
using Key = std::tuple<double, double, double>;
Key key_of(const Vec3& p) { return {p.x, p.y, p.z}; }
std::map<std::pair<Key, Key>, int> uses_of_edges(const DisplayMesh& mesh) {
    std::map<std::pair<Key, Key>, int> uses;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            Key a = key_of(mesh.vertices[t[i]].position), b = key_of(mesh.vertices[t[(i + 1) % 3]].position);
            if (b < a) std::swap(a, b);
            ++uses[{a, b}];
        }
    }
    return uses;
}

/// In a closed room with closed bodies every edge has two triangles, or four where the patches of different
/// objects meet by chance. Where a vertex lies in the middle of another triangle's edge, edges have one.
TEST(DisplayMesh, HasNoCracks) {
    Scene scene = furnished_room();
    scene.lights.pop_back();  // the panel has a rim
    scene.objects.pop_back();
    const DisplayedScene displayed(scene, 0.3);
    std::vector<bool> fronts(2 * displayed.patches.count());
    std::fill_n(fronts.begin(), displayed.patches.count(), true);
    const DisplayMesh mesh = make_display_mesh(displayed.scene, displayed.caster, displayed.patches, fronts);
    EXPECT_GT(mesh.triangles.size(), displayed.patches.count());
    std::set<Key> vertices;
    for (const DisplayVertex& vertex : mesh.vertices) vertices.insert(key_of(vertex.position));
    for (const auto& [edge, uses] : uses_of_edges(mesh)) {
        const auto& [x, y, z] = edge.first;
        const auto& [x2, y2, z2] = edge.second;
        ASSERT_EQ(uses % 2, 0) << x << ' ' << y << ' ' << z << " to " << x2 << ' ' << y2 << ' ' << z2;
        ASSERT_FALSE(vertices.contains(key_of(0.5 * (Vec3{x, y, z} + Vec3{x2, y2, z2}))));
    }
}

TEST(DisplayMesh, IsFineAtShadowsAndCoarseElsewhere) {
    const DisplayedScene displayed(furnished_room(), 0.3);
    double longest_m = 0;
    std::size_t lit = 0;
    for (const Triangle& t : displayed.mesh.triangles) {
        // On the floor, triangles with corners in light and in shadow of the bulb.
        const auto is_in_light = [&](std::uint32_t v) { return displayed.mesh.direct_lx[v] > 0; };
        const auto count = std::ranges::count_if(t, is_in_light);
        const Vec3& a = displayed.mesh.vertices[t[0]].position;
        if (count == 0 || count == 3 || a.z != 0 || is_under_box(a)) continue;
        ++lit;
        for (std::size_t i = 0; i < 3; ++i) {
            longest_m = std::max(longest_m, length(displayed.mesh.vertices[t[i]].position -
                                                   displayed.mesh.vertices[t[(i + 1) % 3]].position));
        }
    }
    EXPECT_GT(lit, 50U);
    EXPECT_LT(longest_m, 0.03);
    EXPECT_LT(displayed.mesh.triangles.size(), 60'000U);
}

TEST(DisplayMesh, KeepsToItsBudget) {
    DisplayOptions options;
    options.most_triangles = 5000;
    const DisplayedScene displayed(furnished_room(), 0.3, options);
    EXPECT_LT(displayed.mesh.triangles.size(), 6000U);
    EXPECT_GT(displayed.mesh.triangles.size(), 4000U);
}

/// Backs of walls and the insides of bodies are dark.
TEST(DisplayMesh, LeavesOutWhatNoLightReaches) {
    const DisplayedScene displayed(furnished_room(), 0.3);
    for (const DisplayPart& part : displayed.mesh.parts) EXPECT_TRUE(part.is_front);
    EXPECT_EQ(displayed.mesh.parts.size(), displayed.scene.objects.size());
    std::vector<bool> all(2 * displayed.patches.count(), true);
    const DisplayMesh both = make_display_mesh(displayed.scene, displayed.caster, displayed.patches, all);
    EXPECT_EQ(both.parts.size(), 2 * displayed.scene.objects.size() - 2);  // box and ball are sealed
}

TEST(DisplayMesh, TurnsTrianglesToTheirSide) {
    const DisplayedScene displayed(furnished_room(), 0.3);
    for (const Triangle& t : displayed.mesh.triangles) {
        const DisplayVertex &a = displayed.mesh.vertices[t[0]], &b = displayed.mesh.vertices[t[1]];
        const Vec3 normal =
            cross(b.position - a.position, displayed.mesh.vertices[t[2]].position - a.position);
        ASSERT_GT(dot(normal, a.normal), 0);
    }
}

TEST(DisplayMesh, StaysOnCurvedSurfacesAndOnItsPatches) {
    const DisplayedScene displayed(furnished_room(), 0.3);
    for (const DisplayVertex& vertex : displayed.mesh.vertices) {
        const std::uint32_t patch = displayed.patches.patch_of(vertex.side);
        const Vec3 on_patch = displayed.patches.position(patch, vertex.barycentric);
        if (displayed.patches.object_of(patch) != ObjectId{7}) {
            ASSERT_LT(length(vertex.position - on_patch), 1e-5);
            continue;
        }
        ASSERT_NEAR(length(vertex.position - kBall.center), kBall.radius, 1e-6);
        ASSERT_LT(length(vertex.normal - normalized(vertex.position - kBall.center)), 1e-5);
    }
}

/// The floor around a box that stands on it, on the side of the lamp: no vertex below the box darkens it.
TEST(DisplayMesh, HasNoBlobsWhereBodiesTouch) {
    Scene scene;
    add_object(scene, Rectangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, diffuse(0.5));
    add_object(scene, Box{{1.61, 1.37, 0}, {2.2, 2.51, 0.7}}, diffuse(0.5));
    add_point_light(scene, {0.5, 2, 2.5}, Rgb::grey(1000));
    DisplayOptions no_refinement;
    no_refinement.most_triangles = 0;
    for (const DisplayOptions& options : {DisplayOptions{}, no_refinement}) {
        const DisplayedScene displayed(scene, 0.25, options);
        std::size_t count = 0;
        for (const Triangle& t : displayed.mesh.triangles) {
            for (const double share : {0.1, 0.4, 0.8}) {
                const Probe probe =
                    probe_in(displayed.mesh, t, {share, (1 - share) / 3, 2 * (1 - share) / 3});
                const Vec3& p = probe.point.position;
                if (p.z > 1e-6 || p.x < 1.2 || p.x > 1.609 || p.y < 1.6 || p.y > 2.3) continue;
                const Vec3 to_lamp = Vec3{0.5, 2, 2.5} - p;
                const double truth_lx = 1000 * to_lamp.z / std::pow(length(to_lamp), 3);
                EXPECT_NEAR(probe.interpolated_lx, truth_lx, 0.06 * truth_lx) << p.x << ' ' << p.y;
                ++count;
            }
        }
        EXPECT_GT(count, 20U);
    }
}

TEST(DisplayMesh, RefusesTooManyPatches) {
    const Scene scene = furnished_room();
    const rays::RayCaster caster(scene);
    patches::Patches patches;
    patches.corners.resize(kMostWalkPatches + 1);
    try {
        make_display_mesh(scene, caster, patches, std::vector<bool>(2 * patches.count()));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("Choose a larger patch size"), std::string::npos);
    }
}

TEST(DisplayMesh, IsTheSameForAnyNumberOfThreads) {
    std::vector<DisplayMesh> meshes;
    for (const int threads : {1, 3}) {
        ThreadPool(threads).execute([&] { meshes.push_back(DisplayedScene(furnished_room(), 0.4).mesh); });
    }
    EXPECT_EQ(meshes[0].triangles, meshes[1].triangles);
    EXPECT_EQ(meshes[0].direct_lx, meshes[1].direct_lx);
    EXPECT_EQ(meshes[0].direct_error_lx, meshes[1].direct_error_lx);
}

}  // namespace
}  // namespace stilb::walk
