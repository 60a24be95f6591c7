#include "lights/solid_angle/solid_angle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "statistics/hypothesis.h"
#include "support/direction_grid.h"
#include "support/quadrature.h"
#include "support/random_pairs.h"

namespace stilb::lights {
namespace {

using Corners = std::array<Vec3, 3>;

/// [Van Oosterom, Strackee 1983], in extended precision.
double solid_angle_sr(const Corners& triangle, const Vec3& from) {
    using Real = long double;
    using Vector = std::array<Real, 3>;
    const auto difference = [](const Vec3& a, const Vec3& b) {
        return Vector{static_cast<Real>(a.x) - b.x, static_cast<Real>(a.y) - b.y,
                      static_cast<Real>(a.z) - b.z};
    };
    const auto scalar = [](const Vector& p, const Vector& q) {
        return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    };
    const Vector a = difference(triangle[0], from), b = difference(triangle[1], from),
                 c = difference(triangle[2], from);
    const Vector u = difference(triangle[1], triangle[0]), v = difference(triangle[2], triangle[0]);
    const Real determinant = a[0] * (u[1] * v[2] - u[2] * v[1]) + a[1] * (u[2] * v[0] - u[0] * v[2]) +
                             a[2] * (u[0] * v[1] - u[1] * v[0]);
    const Real at_a = std::sqrt(scalar(a, a)), at_b = std::sqrt(scalar(b, b)), at_c = std::sqrt(scalar(c, c));
    const Real denominator =
        at_a * at_b * at_c + scalar(a, b) * at_c + scalar(a, c) * at_b + scalar(b, c) * at_a;
    return static_cast<double>(2 * std::atan2(std::abs(determinant), denominator));
}

/// The part s0..s1, t0..t1 of a parallelogram.
double solid_angle_sr(const Rectangle& r, const Vec3& from, double s0 = 0, double s1 = 1, double t0 = 0,
                      double t1 = 1) {
    const auto at = [&](double s, double t) { return r.corner + s * r.edge_u + t * r.edge_v; };
    return solid_angle_sr(Corners{at(s0, t0), at(s1, t0), at(s1, t1)}, from) +
           solid_angle_sr(Corners{at(s0, t0), at(s1, t1), at(s0, t1)}, from);
}

/// Where `point` = corner + s u + t v lies.
struct PlaneCoordinates {
    double s, t;
};
PlaneCoordinates coordinates_of(const Vec3& point, const Vec3& corner, const Vec3& u, const Vec3& v) {
    const Vec3 p = point - corner;
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v);
    const double determinant = uu * vv - uv * uv;
    return {(dot(p, u) * vv - dot(p, v) * uv) / determinant, (dot(p, v) * uu - dot(p, u) * uv) / determinant};
}

/// Edges of [0, 1], finer towards `focus` down to 1e-4.
std::vector<double> edges_towards(double focus) {
    std::vector<double> edges{0, 1};
    for (double distance = 1e-4; distance < 1; distance *= 2) {
        for (const double edge : {focus - distance, focus + distance}) {
            if (edge > 0 && edge < 1) edges.push_back(edge);
        }
    }
    for (double edge = 0.1; edge < 0.95; edge += 0.1) edges.push_back(edge);
    std::sort(edges.begin(), edges.end());
    return edges;
}

std::size_t interval_of(const std::vector<double>& edges, double value) {
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, value);
    return static_cast<std::size_t>(above - edges.begin() - 1);
}

/// How exactly a solid angle is defined: the observer's height over the plane is known to the rounding of its
/// coordinates.
double relative_tolerance(const Rectangle& r, const Vec3& from) {
    const Vec3 to_corner = r.corner - from;
    const double height = std::abs(dot(to_corner, normalized(cross(r.edge_u, r.edge_v))));
    return 1e-10 + 1e-15 * length(to_corner) / height;
}

/// Whether a point's density is that of its direction when drawn uniformly in area.
bool is_drawn_by_area(const SolidAngleSample& sample, const Rectangle& r, const Vec3& from) {
    const Vec3 normal = cross(r.edge_u, r.edge_v);  // its length is the area
    const double distance = length(sample.point - from);
    const double pdf = std::pow(distance, 3) / std::abs(dot(r.corner - from, normal));
    return std::abs(sample.pdf_per_sr / pdf - 1) < relative_tolerance(r, from);
}

/// Chance of the samples' counts in cells of the emitter, that should be in proportion to the cells' solid
/// angles; to their areas where the emitter is too small for anything but sampling by area. 0 where a density
/// is wrong.
double p_of_parallelogram(const Rectangle& r, const Vec3& from, std::uint64_t seed) {
    constexpr int kSamples = 100'000;
    const PlaneCoordinates foot = coordinates_of(from, r.corner, r.edge_u, r.edge_v);
    const std::vector<double> s_edges = edges_towards(foot.s);
    const std::vector<double> t_edges = edges_towards(foot.t);
    const double total = solid_angle_sr(r, from);
    const double tolerance = relative_tolerance(r, from);
    const auto first = sample_by_solid_angle(r, from, 0.3, 0.4);
    const bool by_area = total < 1e-6 && first && is_drawn_by_area(*first, r, from);
    std::vector<double> expected;
    for (std::size_t i = 0; i + 1 < s_edges.size(); ++i) {
        for (std::size_t j = 0; j + 1 < t_edges.size(); ++j) {
            const double area = (s_edges[i + 1] - s_edges[i]) * (t_edges[j + 1] - t_edges[j]);
            const double solid_angle =
                solid_angle_sr(r, from, s_edges[i], s_edges[i + 1], t_edges[j], t_edges[j + 1]);
            expected.push_back(kSamples * (by_area ? area : solid_angle / total));
        }
    }
    std::vector<double> observed(expected.size());
    RandomPairs random(seed);
    for (int i = 0; i < kSamples; ++i) {
        const auto [u1, u2] = random.next_pair();
        const auto sample = sample_by_solid_angle(r, from, u1, u2);
        if (!sample) return 0;
        const bool right_pdf = by_area ? is_drawn_by_area(*sample, r, from)
                                       : std::abs(sample->pdf_per_sr * total - 1) < tolerance;
        const PlaneCoordinates at = coordinates_of(sample->point, r.corner, r.edge_u, r.edge_v);
        const bool inside = std::min({at.s, at.t, 1 - at.s, 1 - at.t}) > -1e-12;
        if (!right_pdf || !inside) return 0;
        ++observed[interval_of(s_edges, at.s) * (t_edges.size() - 1) + interval_of(t_edges, at.t)];
    }
    return statistics::chi2_test(observed, expected).p_value;
}

struct View {
    std::string name;
    Rectangle rectangle;
    Vec3 from;
};

/// Right-angled and skewed, tilted in space, from the middle, off-side, near, far and nearly edge-on.
std::vector<View> make_views(const Vec3& u, const Vec3& v) {
    const Vec3 corner{0.3, -0.2, 1.1};
    const Vec3 normal = normalized(cross(u, v));
    const Rectangle r{corner, u, v};
    std::vector<View> views;
    const auto add = [&](const std::string& name, double s, double t, double height) {
        views.push_back({name, r, corner + s * u + t * v + height * normal});
    };
    add("middle", 0.5, 0.5, 1);
    add("behind", 0.5, 0.5, -1);
    add("off side", 2.5, -1.5, 0.4);
    add("other side", -1.5, 2.5, -0.4);
    add("below a corner", 0, 0, 0.5);
    add("below an edge", 1, 0.4, 0.5);
    add("1 mm from it", 0.3, 0.6, 1e-3);
    add("1 um from it", 0.3, 0.6, 1e-6);
    add("1 um from its edge", 0, 0.6, 1e-6);
    add("1 mm above its plane, 1 cm outside", 1.01, 0.6, 1e-3);
    add("10 um above its plane, far outside", 4, 5, 1e-5);
    add("10 um above its plane, beside it", 0.5, -2, 1e-5);
    add("far", 0.5, 0.5, 1e3);
    add("far, off side", 1e3, -1e3, 1e3);
    add("very far", 1e5, 3e6, 1e7);
    return views;
}

const Vec3 kEdgeU{0.8, 0.6, 0.0};
const Vec3 kEdgeV{-0.36, 0.48, 0.8};  // at right angles to kEdgeU, of length 1

TEST(SphericalRectangleSampling, IsUniformInSolidAngle) {
    for (const double length_v : {1.0, 1e-3, 30.0}) {
        for (const View& view : make_views(kEdgeU, length_v * kEdgeV)) {
            EXPECT_GT(p_of_parallelogram(view.rectangle, view.from, 7), kLeastP)
                << view.name << ", " << length_v;
        }
    }
}

TEST(SphericalRectangleSampling, SkewedParallelogramIsUniformInSolidAngle) {
    for (const View& view : make_views(kEdgeU, kEdgeV + 0.7 * kEdgeU)) {
        EXPECT_GT(p_of_parallelogram(view.rectangle, view.from, 8), kLeastP) << view.name;
    }
}

/// Counts of a triangle's samples in subtriangles against their solid angles. 0 where a density is wrong.
double p_of_triangle(const Corners& t, const Vec3& from, std::uint64_t seed) {
    constexpr int kSamples = 100'000;
    constexpr std::size_t kSide = 12;
    const Vec3 u = (t[1] - t[0]) / kSide, v = (t[2] - t[0]) / kSide;
    const double total = solid_angle_sr(t, from);
    const double tolerance = relative_tolerance({t[0], u, v}, from);
    // Cell (i, j) of the parallelogram grid has a lower triangle and, inside the diagonal, an upper one.
    std::vector<double> observed(2 * kSide * kSide), expected(2 * kSide * kSide);
    for (std::size_t i = 0; i < kSide; ++i) {
        for (std::size_t j = 0; i + j < kSide; ++j) {
            const Vec3 at = t[0] + static_cast<double>(i) * u + static_cast<double>(j) * v;
            const std::size_t cell = 2 * (i * kSide + j);
            expected[cell] = kSamples / total * solid_angle_sr(Corners{at, at + u, at + v}, from);
            if (i + j + 1 < kSide) {
                expected[cell + 1] =
                    kSamples / total * solid_angle_sr(Corners{at + u, at + u + v, at + v}, from);
            }
        }
    }
    RandomPairs random(seed);
    for (int n = 0; n < kSamples; ++n) {
        const auto [u1, u2] = random.next_pair();
        const auto sample = sample_by_solid_angle(t, from, u1, u2);
        if (!sample || std::abs(sample->pdf_per_sr * total - 1) > tolerance) return 0;
        const PlaneCoordinates at = coordinates_of(sample->point, t[0], u, v);
        if (std::min({at.s, at.t, kSide - at.s - at.t}) < -1e-11) return 0;
        const auto i = std::min(static_cast<std::size_t>(std::max(at.s, 0.0)), kSide - 1);
        const auto j = std::min(static_cast<std::size_t>(std::max(at.t, 0.0)), kSide - 1 - i);
        const bool upper =
            at.s - static_cast<double>(i) + at.t - static_cast<double>(j) > 1 && i + j + 1 < kSide;
        ++observed[2 * (i * kSide + j) + (upper ? 1 : 0)];
    }
    return statistics::chi2_test(observed, expected).p_value;
}

TEST(SphericalTriangleSampling, IsUniformInSolidAngle) {
    for (const double scale : {1e-3, 1.0, 1e3}) {
        for (const double width : {1e-3, 1.0}) {  // slivers too
            const Corners triangle{scale * Vec3{1, 0.2, 0.1}, scale * Vec3{-0.5, 0.7, 0.3},
                                   scale * (Vec3{1, 0.2, 0.1} + width * Vec3{-0.3, -1.1, 0.4})};
            const Vec3 middle = (triangle[0] + triangle[1] + triangle[2]) / 3;
            const Vec3 normal = normalized(cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
            for (const double height : {1e-6, 1e-3, 0.1, 1.0, -1.0, 30.0}) {
                const Vec3 inside = middle + scale * height * normal;
                const Vec3 outside = inside + 2 * (triangle[1] - triangle[0]);
                EXPECT_GT(p_of_triangle(triangle, inside, 21), kLeastP)
                    << scale << ' ' << width << ' ' << height;
                if (solid_angle_sr(triangle, outside) < 1e-6) continue;  // may be drawn by area
                EXPECT_GT(p_of_triangle(triangle, outside, 22), kLeastP)
                    << scale << ' ' << width << ' ' << height;
            }
        }
    }
}

TEST(SphericalTriangleSampling, OrderOfCornersDoesNotMatterForTheLaw) {
    const Corners t{Vec3{0, 0, 1}, {1, 0, 1}, {0.2, 2, 1.5}};
    for (const Corners& order :
         {Corners{t[1], t[2], t[0]}, Corners{t[2], t[1], t[0]}, Corners{t[0], t[2], t[1]}}) {
        EXPECT_GT(p_of_triangle(order, {0.1, 0.2, 0.8}, 23), kLeastP);
    }
}

// Estimates against quadrature over the emitter's area: integral of f(w) dw = integral of f(w) cos / d^2 dA.

using DirectionFunction = std::function<double(const Vec3&)>;

const std::vector<DirectionFunction>& test_functions() {
    static const std::vector<DirectionFunction> functions{
        [](const Vec3&) { return 1.0; },
        [](const Vec3& w) { return 2 + w.x - 0.5 * w.y; },
        [](const Vec3& w) { return 1 + w.z * w.z; },
        [](const Vec3& w) { return std::exp(0.7 * w.x + 0.4 * w.y); },
    };
    return functions;
}

double seen_from(const Vec3& from, const Vec3& point, const Vec3& area_vector, const DirectionFunction& f) {
    const Vec3 to_point = point - from;
    const double distance = length(to_point);
    return f(to_point / distance) * std::abs(dot(to_point, area_vector)) / (distance * distance * distance);
}

template <typename Shape>
void expect_estimates(const Shape& shape, const Vec3& from,
                      const std::function<double(const DirectionFunction&)>& quadrature) {
    constexpr int kSamples = 400'000;
    for (std::size_t i = 0; i < test_functions().size(); ++i) {
        const DirectionFunction& f = test_functions()[i];
        const double exact = quadrature(f);
        RandomPairs random(31 + i);
        double sum = 0, squares = 0;
        for (int n = 0; n < kSamples; ++n) {
            const auto [u1, u2] = random.next_pair();
            const auto sample = sample_by_solid_angle(shape, from, u1, u2);
            if (!sample) continue;
            const double value = f(normalized(sample->point - from)) / sample->pdf_per_sr;
            sum += value;
            squares += value * value;
        }
        const double mean = sum / kSamples;
        const double error = std::sqrt(std::max(0.0, squares / kSamples - mean * mean) / kSamples);
        EXPECT_LT(error, 1e-3 * exact) << i;
        EXPECT_LT(std::abs(mean - exact), 4 * error + 1e-9 * exact) << i;
    }
}

constexpr int kParts = 64;

TEST(SolidAngleSampling, RectangleEstimatesMatchQuadrature) {
    for (const double skew : {0.0, 0.6}) {
        const Rectangle r{{0.3, -0.2, 1.1}, kEdgeU, 1.7 * kEdgeV + skew * kEdgeU};
        for (const Vec3& from : {Vec3{0, 0, 0}, Vec3{2, -1, 0.5}, Vec3{-300, 800, 500}}) {
            expect_estimates(r, from, [&](const DirectionFunction& f) {
                return integrate(0, 1, kParts, [&](double s) {
                    return integrate(0, 1, kParts, [&](double t) {
                        return seen_from(from, r.corner + s * r.edge_u + t * r.edge_v,
                                         cross(r.edge_u, r.edge_v), f);
                    });
                });
            });
        }
    }
}

TEST(SolidAngleSampling, TriangleEstimatesMatchQuadrature) {
    const Corners triangle{Vec3{1, 0.2, 0.1}, {-0.5, 0.7, 0.3}, {0.7, -0.9, 0.5}};
    const Vec3 u = triangle[1] - triangle[0], v = triangle[2] - triangle[0];
    for (const Vec3& from : {Vec3{0, 0, -0.5}, Vec3{2, -1, 0.5}, Vec3{-3e5, 8e5, 5e5}}) {
        expect_estimates(triangle, from, [&](const DirectionFunction& f) {
            return integrate(0, 1, kParts, [&](double s) {
                return integrate(0, 1 - s, kParts, [&](double t) {
                    return seen_from(from, triangle[0] + s * u + t * v, cross(u, v), f);
                });
            });
        });
    }
}

TEST(SolidAngleSampling, DiskEstimatesMatchQuadrature) {
    const Disk disk{{0.3, -0.2, 1.1}, normalized(Vec3{1, 2, -3}), 0.7};
    const Frame frame = Frame::around(disk.normal);
    for (const Vec3& from : {Vec3{0, 0, 0}, Vec3{2, -1, 0.5}, Vec3{-300, 800, 500}}) {
        expect_estimates(disk, from, [&](const DirectionFunction& f) {
            return integrate(0, disk.radius, kParts, [&](double radius) {
                return integrate(-kPi, kPi, kParts, [&](double phi) {
                    const Vec3 point =
                        disk.center + radius * std::cos(phi) * frame.u + radius * std::sin(phi) * frame.v;
                    return seen_from(from, point, radius * disk.normal, f);
                });
            });
        });
    }
}

TEST(DiskSampling, PointsLieOnTheDisk) {
    const Disk disk{{0.3, -0.2, 1.1}, normalized(Vec3{1, 2, -3}), 0.7};
    RandomPairs random(41);
    int found = 0;
    for (int i = 0; i < 10'000; ++i) {
        const auto [u1, u2] = random.next_pair();
        const auto sample = sample_by_solid_angle(disk, {0, 0, 0}, u1, u2);
        if (!sample) continue;
        ++found;
        ASSERT_LE(length(sample->point - disk.center), disk.radius);
        ASSERT_NEAR(dot(sample->point - disk.center, disk.normal), 0, 1e-15);
    }
    EXPECT_GT(found, 7000);
}

TEST(SphereSampling, IsUniformInItsCone) {
    for (const double distance : {1 + 1e-6, 1.1, 3.0, 1e3, 1e6}) {
        const Sphere sphere{{0, 0, 0}, 0.25};
        const Vec3 from = distance * sphere.radius * normalized(Vec3{1, -2, 0.5});
        const Frame frame = Frame::around(normalized(sphere.center - from));
        const double one_minus_cos =
            1 / (distance * distance) / (1 + std::sqrt((distance - 1) * (distance + 1)) / distance);
        // Counted by 1 - cos and azimuth, both uniform: a cone of a millionth is a point to a grid of
        // directions.
        constexpr std::size_t kRings = 20, kSectors = 20;
        std::vector<double> observed(kRings * kSectors);
        constexpr int kSamples = 100'000;
        RandomPairs random(51);
        for (int i = 0; i < kSamples; ++i) {
            const auto [u1, u2] = random.next_pair();
            const auto sample = sample_by_solid_angle(sphere, from, u1, u2);
            ASSERT_TRUE(sample);
            ASSERT_NEAR(sample->pdf_per_sr * 2 * kPi * one_minus_cos, 1, 1e-9);
            const Vec3 normal = (sample->point - sphere.center) / sphere.radius;
            ASSERT_NEAR(length(normal), 1, 1e-13);
            ASSERT_GT(dot(normal, from - sample->point), -1e-9) << "hidden side";
            const Vec3 w = frame.to_local(normalized(sample->point - from));
            const double share = (w.x * w.x + w.y * w.y) / (1 + w.z) / one_minus_cos;
            const double turn = std::atan2(w.y, w.x) / (2 * kPi) + 0.5;
            const auto ring = std::min(static_cast<std::size_t>(share * kRings), kRings - 1);
            const auto sector = std::min(static_cast<std::size_t>(turn * kSectors), kSectors - 1);
            ++observed[ring * kSectors + sector];
        }
        const std::vector<double> expected(observed.size(),
                                           static_cast<double>(kSamples) / (kRings * kSectors));
        EXPECT_GT(statistics::chi2_test(observed, expected).p_value, kLeastP) << distance;
    }
}

TEST(SphereSampling, FindsNothingFromInsideOrOnIt) {
    EXPECT_FALSE(sample_by_solid_angle(Sphere{{1, 2, 3}, 2}, {1, 2, 3}, 0.5, 0.5));
    EXPECT_FALSE(sample_by_solid_angle(Sphere{{0, 0, 0}, 2}, {2, 0, 0}, 0.5, 0.5));
}

TEST(SolidAngleSampling, EdgeOnFindsNothing) {
    const Rectangle right{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    const Rectangle skewed{{0, 0, 1}, {1, 0, 0}, {0.5, 1, 0}};
    const Corners triangle{Vec3{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    const Disk disk{{0, 0, 1}, {0, 0, 1}, 1};
    for (const Vec3& from : {Vec3{3, 4, 1}, Vec3{0.25, 0.25, 1}, Vec3{0, 0, 1}, Vec3{0.5, 0, 1}}) {
        EXPECT_FALSE(sample_by_solid_angle(right, from, 0.3, 0.6));
        EXPECT_FALSE(sample_by_solid_angle(skewed, from, 0.3, 0.6));
        EXPECT_FALSE(sample_by_solid_angle(triangle, from, 0.3, 0.6));
        EXPECT_FALSE(sample_by_solid_angle(disk, from, 0.3, 0.6));
    }
}

TEST(SolidAngleSampling, IsFiniteAtTheEndsOfTheRandomNumbers) {
    constexpr double kLargest = 0x1.fffffffffffffp-1;
    for (const View& view : make_views(kEdgeU, kEdgeV)) {
        const Rectangle& r = view.rectangle;
        Rectangle skewed = r;
        skewed.edge_v += 0.7 * r.edge_u;
        const Corners triangle{r.corner, r.corner + r.edge_u, r.corner + r.edge_v};
        for (const double u1 : {0.0, 0x1p-53, 0.5, kLargest}) {
            for (const double u2 : {0.0, 0x1p-53, 0.5, kLargest}) {
                for (const auto& sample :
                     {sample_by_solid_angle(r, view.from, u1, u2),
                      sample_by_solid_angle(skewed, view.from, u1, u2),
                      sample_by_solid_angle(triangle, view.from, u1, u2),
                      sample_by_solid_angle(Sphere{r.corner, 0.01}, view.from, u1, u2)}) {
                    if (!sample) continue;
                    EXPECT_TRUE(is_finite(sample->point)) << view.name;
                    EXPECT_TRUE(std::isfinite(sample->pdf_per_sr) && sample->pdf_per_sr > 0) << view.name;
                }
            }
        }
    }
}

}  // namespace
}  // namespace stilb::lights
