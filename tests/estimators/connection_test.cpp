#include "estimators/local/connection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <set>

#include "estimators/receivers.h"
#include "materials/black.h"
#include "materials/diffuse.h"
#include "materials/phong.h"
#include "sensors/place.h"
#include "support/random_pairs.h"
#include "support/scene_builder.h"
#include "transport/weights.h"

namespace stilb::estimators {
namespace {

/// Cosines are sums of products in single precision: near grazing their relative error is 1e-7 over the
/// cosine. Nodes at less than this cosine are left out of the comparison.
constexpr double kLeastCosine = 0.01;
constexpr double kTolerance = 2e-5;

Vec3 random_direction(RandomPairs& random) {
    const auto [a, b] = random.next_pair();
    return normalized(Vec3{a - 0.5, b - 0.5, random.next() - 0.5});
}
Vec3 random_point(RandomPairs& random) {
    const auto [a, b] = random.next_pair();
    return {4 * a, 3 * b, 2.8 * random.next()};
}

std::vector<MeasuringPoint> random_points(std::size_t count, RandomPairs& random) {
    std::vector<MeasuringPoint> points(count);
    for (MeasuringPoint& point : points) point = {random_point(random), random_direction(random)};
    return points;
}

TEST(Receivers, ArePermutedSoThatNeighboursStandTogether) {
    RandomPairs random(1);
    const std::vector<MeasuringPoint> points = random_points(1000, random);
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.8}}, Black{});
    const rays::RayCaster caster(scene);
    const std::vector<transport::Receiver> sorted = receivers_of(points, caster);
    double steps = 0, unsorted_steps = 0;
    std::set<std::uint32_t> readings;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const MeasuringPoint& point = points[sorted[i].reading()];
        readings.insert(sorted[i].reading());
        EXPECT_EQ(sorted[i].normal(), point.normal);
        EXPECT_EQ(sorted[i].position(), point.position);
        EXPECT_EQ(sorted[i].lifted(), place_of(point, caster).lifted);
        if (i == 0) continue;
        steps += length(sorted[i].position() - sorted[i - 1].position());
        unsorted_steps += length(points[i].position - points[i - 1].position);
    }
    EXPECT_LT(steps, unsorted_steps / 3);
    EXPECT_EQ(readings.size(), points.size());
    EXPECT_EQ(*readings.rbegin(), points.size() - 1);
    EXPECT_EQ(receivers_of(std::vector<MeasuringPoint>(3), caster).size(), 3u);  // all in one place
}

/// W f_r w G (theory T.1b), one node and point at a time, in double precision.
Rgb contribution_lx(const transport::LightVertex& node, const MeasuringPoint& point, double k_per_m2,
                    const rays::RayCaster& caster) {
    const Vec3 w = normalized(point.position - node.position), to = place_of(point, caster).lifted;
    const double cos_node = dot(w, node.normal), cos_point = -dot(w, point.normal);
    if (cos_node <= 0 || cos_point <= 0 || caster.occluded(node.lifted, to)) {
        return {};
    }
    const double g = cos_node * cos_point / squared_length(point.position - node.position);
    const Frame frame = Frame::of_surface(node.normal);
    // BRDFs see the ray, which goes between lifted points.
    const Vec3 out = frame.to_local(normalized(to - node.lifted));
    const Rgb brdf = evaluate_brdf_per_sr(*node.material, frame.to_local(node.incoming), out);
    const double weight =
        node.only_by_light ? 1 : 1 / (1 + transport::relative_brdf(*node.material, brdf) * g / k_per_m2);
    return node.flux_lm * brdf * (weight * g);
}

/// W f_r w G of a body with s in place of the cosine, likewise.
double body_contribution(const transport::LightVertex& node, const BodyPoint& body, double k_per_m2,
                         const rays::RayCaster& caster) {
    const Vec3 way = body.position - node.position, w = normalized(way);
    const double cos_node = dot(w, node.normal);
    if (cos_node <= 0 || caster.occluded(node.lifted, place_of(body, caster).lifted)) return 0;
    const double s = body.sensitivity->of(Frame::of_surface(body.axis).to_local(-w));
    const double g = cos_node * s / squared_length(way);
    const double reflectance = node.material->get_if<Diffuse>()->reflectance.luminance();
    return node.flux_lm.luminance() * reflectance / std::numbers::pi * g / (1 + g / k_per_m2);
}

TEST(Connections, ConnectsBodiesBesideSurfaceElements) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.8}}, diffuse(0.5));
    add_object(scene, Box{{1, 1, 0.5}, {1.7, 1.6, 1.2}}, diffuse(0.5));
    const rays::RayCaster caster(scene);
    const Material matt = diffuse(0.7);
    RandomPairs random(31);
    const std::vector<MeasuringPoint> points = random_points(21, random);
    const std::vector<Vec3> at{{2.5, 1.2, 1.4}, {0.4, 2.3, 2.2}, {2.1, 0.4, 0.6}};
    std::vector<Measurand> measurands(points.begin(), points.end());
    for (const Sensor& sensor : {Sensor{"", Cylindrical{at}}, Sensor{"", Spherical{at}},
                                 Sensor{"", Semicylindrical{at, {0.6, -0.8, 0}}},
                                 Sensor{"", Hemispherical{at, normalized(Vec3{1, 2, -3})}}}) {
        for (const Measurand& measurand : sensor.measurands()) measurands.push_back(measurand);
    }
    std::vector<transport::Receiver> receivers;
    for (std::size_t j = 0; j < measurands.size(); ++j) {
        receivers.push_back(
            *transport::receiver_of_illuminance(static_cast<std::uint32_t>(j), measurands[j], caster));
    }
    const std::vector<transport::Receiver> sorted = sorted_receivers(receivers);
    for (std::size_t j = 0; j < sorted.size(); ++j) EXPECT_EQ(sorted[j].is_body(), j >= points.size());
    std::vector<transport::LightVertex> nodes;
    for (int n = 0; n < 300; ++n) {
        transport::LightVertex node;
        node.position = random_point(random);
        node.normal = node.shading_normal = random_direction(random);
        node.lifted = node.position + 1e-5 * node.normal;
        node.incoming = node.normal;
        node.material = &matt;
        node.flux_lm = {{random.next(), random.next(), random.next()}};
        nodes.push_back(node);
    }
    constexpr double k = 0.2;
    const std::vector<PointTile> tiles =
        tiles_of(sorted, std::vector<double>(sorted.size(), k), caster, transport::kUnlimited);
    Tally sums(measurands.size());
    Connections(caster, tiles).collect(nodes, sums);
    for (std::size_t j = 0; j < measurands.size(); ++j) {
        double expected = 0;
        for (const transport::LightVertex& node : nodes) {
            if (const auto* body = std::get_if<BodyPoint>(&measurands[j])) {
                expected += body_contribution(node, *body, k, caster);
            } else {
                expected += contribution_lx(node, points[j], k, caster).luminance();
            }
        }
        if (j >= points.size()) {
            EXPECT_GT(expected, 0) << j;
        }
        EXPECT_NEAR(sums.sum[j].luminance(), expected, 1e-4 * expected) << j;
    }
}

TEST(Connections, CollectsWhatAScalarEvaluationDoes) {
    Scene scene;
    add_object(scene, Box{{0, 0, 0}, {4, 3, 2.8}}, diffuse(0.5));
    add_object(scene, Box{{1, 1, 0.5}, {1.7, 1.6, 1.2}}, diffuse(0.5));
    add_object(scene, Sphere{{3, 2, 1}, 0.4}, diffuse(0.5));
    const rays::RayCaster caster(scene);
    const std::array<Material, 3> materials{Diffuse{{{0.7, 0.5, 0.2}}},
                                            Phong{{{0.3, 0.2, 0.1}}, {{0.2, 0.3, 0.4}}, 12}, diffuse(0.9)};
    // Fewer points than a packet, a packet and one more; more nodes than a block.
    for (const std::size_t count : {1u, 5u, 16u, 17u, 101u}) {
        RandomPairs random(20 + count);
        const std::vector<MeasuringPoint> points = random_points(count, random);
        std::vector<double> k(count);
        for (std::size_t j = 0; j < count; ++j) {
            k[j] = j % 4 == 0 ? std::numeric_limits<double>::infinity() : 0.01 + random.next();
        }
        std::vector<transport::LightVertex> nodes;
        for (int n = 0; n < 600; ++n) {
            transport::LightVertex node;
            node.position = random_point(random);
            node.normal = node.shading_normal = random_direction(random);
            node.lifted = node.position + 1e-5 * node.normal;
            do node.incoming = random_direction(random);
            while (dot(node.incoming, node.normal) <= 0);
            node.material = &materials[static_cast<std::size_t>(n) % materials.size()];
            node.flux_lm = {{random.next(), random.next(), random.next()}};
            node.only_by_light = n % 5 == 0;
            const bool grazes = std::any_of(points.begin(), points.end(), [&](const MeasuringPoint& point) {
                const Vec3 w = normalized(point.position - node.position);
                return std::min(std::abs(dot(w, node.normal)), std::abs(dot(w, point.normal))) < kLeastCosine;
            });
            if (!grazes) nodes.push_back(node);
        }
        ASSERT_GT(nodes.size(), 64u);
        Tally sums(count);
        const std::vector<transport::Receiver> sorted = receivers_of(points, caster);
        std::vector<double> sorted_k;
        for (const transport::Receiver& receiver : sorted) sorted_k.push_back(k[receiver.reading()]);
        const std::vector<PointTile> tiles = tiles_of(sorted, sorted_k, caster, transport::kUnlimited);
        Connections(caster, tiles).collect(nodes, sums);
        std::uint64_t rays = 0;
        for (std::size_t j = 0; j < count; ++j) {
            Rgb expected;
            double largest = 0;
            for (const transport::LightVertex& node : nodes) {
                const Rgb added = contribution_lx(node, points[j], k[j], caster);
                expected += added;
                largest = std::max(largest, added.luminance());
                const Vec3 w = points[j].position - node.position;
                rays += dot(w, node.normal) > 0 && dot(w, points[j].normal) < 0;
            }
            for (std::size_t b = 0; b < kBands; ++b) {
                EXPECT_NEAR(sums.sum[j][b], expected[b], kTolerance * expected[b] + 1e-9)
                    << j << " of " << count;
            }
            EXPECT_NEAR(sums.largest[j], largest, kTolerance * largest + 1e-9) << j << " of " << count;
        }
        EXPECT_EQ(sums.rays, rays);
        EXPECT_EQ(sums.invalid, 0u);
    }
}

}  // namespace
}  // namespace stilb::estimators
