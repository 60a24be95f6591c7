#include "lights/solid_angle/projected_solid_angle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "exact/configuration_factors.h"
#include "math/sampling.h"

namespace stilb::lights {
namespace {

double exact_sr(const Shape& shape, const SurfacePoint& at) {
    const exact::Receiver receiver{at.position, at.normal};
    if (const auto* r = std::get_if<Rectangle>(&shape))
        return exact::illuminance_by_rectangle_lx(receiver, r->corner, r->edge_u, r->edge_v, 1);
    if (const auto* d = std::get_if<Disk>(&shape))
        return exact::illuminance_by_disk_lx(receiver, {d->center, d->normal, d->radius}, 1);
    if (const auto* s = std::get_if<Sphere>(&shape))
        return exact::illuminance_by_sphere_lx(receiver, s->center, s->radius, 1);
    const Mesh& mesh = std::get<Mesh>(shape);
    return exact::illuminance_by_polygon_lx(receiver, mesh.vertices, 1);
}

Shape triangle(const Vec3& a, const Vec3& b, const Vec3& c) { return Mesh{{a, b, c}, {{0, 1, 2}}}; }

Vec3 random_vector(math::SampleStream& stream) {
    const auto [x, y] = stream.next_two();
    return {2 * x - 1, 2 * y - 1, 2 * stream.next() - 1};
}

Vec3 random_direction(math::SampleStream& stream) {
    const auto [u1, u2] = stream.next_two();
    return math::sample_sphere(u1, u2).direction;
}

/// A shape, and the part of it whose share of samples is known.
struct ProjectedCase {
    Shape whole, part;
};

/// Shapes about the origin of size 1, skewed and small ones too.
std::vector<ProjectedCase> random_cases(math::RandomKey key) {
    std::vector<ProjectedCase> cases;
    for (std::uint64_t i = 0; i < 40; ++i) {
        math::SampleStream stream(key, i, 0);
        const double size = i % 4 == 3 ? 0.01 : 1;
        const Vec3 corner = size * random_vector(stream), u = size * random_vector(stream),
                   v = size * random_vector(stream);
        const double share = 0.2 + 0.6 * stream.next();
        const Vec3 normal = random_direction(stream);
        cases.push_back({Rectangle{corner, u, v}, Rectangle{corner, share * u, v}});
        cases.push_back({Rectangle{corner, u, v}, Rectangle{corner, u, share * v}});
        cases.push_back({triangle(corner, corner + u, corner + v),
                         triangle(corner, corner + share * u, corner + share * v)});
        cases.push_back({Disk{corner, normal, size}, Disk{corner, normal, share * size}});
        cases.push_back({Sphere{corner, size}, Sphere{corner, share * size}});
    }
    return cases;
}

/// Whether the ray through a point of the whole meets the part.
bool is_in(const Shape& part, const SurfacePoint& at, const Vec3& point) {
    if (const auto* d = std::get_if<Disk>(&part)) return length(point - d->center) <= d->radius;
    if (const auto* s = std::get_if<Sphere>(&part)) {
        const Vec3 direction = normalized(point - at.position), towards = s->center - at.position;
        return length(cross(towards, direction)) <= s->radius;
    }
    const auto side = [&](const Vec3& a, const Vec3& b, const Vec3& normal) {
        return dot(cross(b - a, point - a), normal) >= 0;
    };
    if (const auto* r = std::get_if<Rectangle>(&part)) {
        const Vec3 normal = cross(r->edge_u, r->edge_v), end = r->corner + r->edge_u + r->edge_v;
        return side(end - r->edge_v, end, normal) && side(end, end - r->edge_u, normal);
    }
    const auto& v = std::get<Mesh>(part).vertices;
    return side(v[1], v[2], cross(v[1] - v[0], v[2] - v[0]));
}

TEST(ProjectedSolidAngle, AgreesWithTheExactFactors) {
    std::size_t lit = 0, cut = 0;
    const std::vector<ProjectedCase> cases = random_cases({1});
    for (std::size_t c = 0; c < cases.size(); ++c) {
        const EmitterElement element = emitter_elements(cases[c].whole).front();
        ASSERT_TRUE(has_closed_form(element));
        for (std::uint64_t i = 0; i < 200; ++i) {
            math::SampleStream stream(math::RandomKey{2}.derived(c), i, 0);
            const SurfacePoint at{3 * random_vector(stream), random_direction(stream)};
            if (const auto* s = std::get_if<Sphere>(&cases[c].whole);
                s && length(at.position - s->center) <= s->radius)
                continue;
            const double expected = exact_sr(cases[c].whole, at);
            EXPECT_NEAR(projected_solid_angle_sr(element, at), expected, 1e-11) << c << " " << i;
            const double all_sides = expected + exact_sr(cases[c].whole, {at.position, -at.normal});
            lit += expected > 0;
            cut += expected > 0 && expected < all_sides;
        }
    }
    EXPECT_GT(lit, 8000u);
    EXPECT_GT(cut, 2500u);  // crossed by the horizon
}

TEST(ProjectedSolidAngle, SamplesAreUniform) {
    const std::vector<ProjectedCase> cases = random_cases({3});
    double squares = 0, worst = 0;
    int tests = 0;
    for (std::size_t c = 0; c < cases.size(); ++c) {
        const EmitterElement element = emitter_elements(cases[c].whole).front();
        for (std::uint64_t place = 0; place < 20; ++place) {
            math::SampleStream placing(math::RandomKey{4}.derived(c), place, 0);
            const SurfacePoint at{2 * random_vector(placing), random_direction(placing)};
            if (const auto* s = std::get_if<Sphere>(&cases[c].whole);
                s && length(at.position - s->center) <= s->radius)
                continue;
            const double whole = exact_sr(cases[c].whole, at), part = exact_sr(cases[c].part, at);
            if (!(whole > 0) || !(part > 0.001 * whole) || !(part < 0.999 * whole)) continue;
            constexpr int count = 1000;
            int inside = 0;
            for (std::uint64_t i = 0; i < count; ++i) {
                math::SampleStream stream(math::RandomKey{5}.derived(c).derived(place), i, 0);
                const auto sample = sample_projected(element, at, stream);
                ASSERT_TRUE(sample) << c << " " << place;
                ASSERT_NEAR(sample->projected_solid_angle_sr, whole, 1e-11);
                const Vec3 towards = sample->point.position - at.position;
                ASSERT_GE(dot(towards, at.normal), -1e-9);
                ASSERT_LE(dot(towards, sample->point.normal), 1e-9);
                inside += is_in(cases[c].part, at, sample->point.position);
            }
            const double share = part / whole;
            const double z = (inside - count * share) / std::sqrt(count * share * (1 - share));
            squares += z * z;
            worst = std::max(worst, std::abs(z));
            ++tests;
        }
    }
    EXPECT_GT(tests, 800);
    EXPECT_LT(worst, 4.5);
    EXPECT_NEAR(squares / tests, 1, 5 * std::sqrt(2. / tests));
}

TEST(ProjectedSolidAngle, NothingArrivesInThePlaneOfAFlatEmitterAndBehindIt) {
    const Shape square = Rectangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const EmitterElement element = emitter_elements(square).front();
    EXPECT_EQ(projected_solid_angle_sr(element, {{3, 0.5, 0}, {-1, 0, 0}}), 0);
    EXPECT_EQ(projected_solid_angle_sr(element, {{0.5, 0.5, -1}, {0, 0, 1}}), 0);
    EXPECT_EQ(projected_solid_angle_sr(element, {{0.5, 0.5, 1}, {0, 0, 1}}), 0);
    math::SampleStream stream({6}, 0);
    EXPECT_FALSE(sample_projected(element, {{3, 0.5, 0}, {-1, 0, 0}}, stream));
    EXPECT_FALSE(sample_projected(element, {{0.5, 0.5, 1}, {0, 0, 1}}, stream));
}

TEST(ProjectedSolidAngle, ASquareOverheadFillsTheSkyAndAFarOneKeepsItsDigits) {
    const EmitterElement wide =
        emitter_elements(Rectangle{{-1e6, -1e6, 1}, {0, 2e6, 0}, {2e6, 0, 0}}).front();
    EXPECT_NEAR(projected_solid_angle_sr(wide, {{0, 0, 0}, {0, 0, 1}}), kPi, 1e-9);
    const EmitterElement far = emitter_elements(Rectangle{{0, 0, 1000}, {0, 0.1, 0}, {0.1, 0, 0}}).front();
    EXPECT_NEAR(projected_solid_angle_sr(far, {{0, 0, 0}, {0, 0, 1}}), 1e-8, 1e-8 * 1e-7);
}

}  // namespace
}  // namespace stilb::lights
