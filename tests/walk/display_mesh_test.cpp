// The display mesh: it fits together, is refined at shadows, and its direct light is that of run::measure.
#include "walk/display_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "math/random.h"
#include "run/run.h"
#include "stilb/error.h"
#include "walk/walk_rooms.h"

namespace stilb::walk {
namespace {

constexpr Box kRoom{{0, 0, 0}, {4, 3, 2.5}}, kBox{{1.2, 1, 0}, {1.9, 1.6, 0.8}};
constexpr Sphere kBall{{2.9, 1.9, 0.35}, 0.35};

Scene furnished_room() {
    Scene scene;
    add_walls(scene, kRoom, {diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5)});
    add_object(scene, kBox, diffuse(0.3));
    add_object(scene, kBall, diffuse(0.3));
    add_point_light(scene, {0.8, 0.7, 2.1}, Rgb::grey(150));
    add_area_light(scene, Rectangle{{2.6, 1.2, 2.45}, {0, 0.4, 0}, {0.5, 0, 0}}, Rgb::grey(2500));
    return scene;
}

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
    options.paths = 16'384;
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
    for (const Reading& reading : readings) mean_lx += reading.estimate.value / static_cast<double>(readings.size());
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
    std::printf("close %zu covered %zu of %zu; %zu triangles\n", found.close, found.covered, found.count, displayed.mesh.triangles.size());
    EXPECT_GE(static_cast<double>(found.close), 0.95 * static_cast<double>(found.count));
    EXPECT_GE(static_cast<double>(found.covered), 0.9 * static_cast<double>(found.count));
}

}  // namespace
}  // namespace stilb::walk
