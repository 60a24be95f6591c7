#include "lights/photometric_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "stilb/error.h"

namespace stilb::lights {
namespace {

using Grid = PhotometricSolid::Grid;
using Intensity = std::function<double(const Vec3&)>;
constexpr double kDegree = kPi / 180;

std::vector<double> angles(double first, double last, std::size_t intervals) {
    std::vector<double> result;
    for (std::size_t i = 0; i <= intervals; ++i) {
        result.push_back(first + (last - first) * static_cast<double>(i) / static_cast<double>(intervals));
    }
    return result;
}

// Directions in the luminaire's frame, written from the definitions of the three types and not from the code.
Vec3 direction_of(PhotometryType type, double plane_deg, double polar_deg) {
    const double p = plane_deg * kDegree, q = polar_deg * kDegree;
    switch (type) {
        case PhotometryType::A:  // azimuth clockwise from C0, elevation above the horizon
            return {std::cos(q) * std::cos(p), -std::cos(q) * std::sin(p), -std::sin(q)};
        case PhotometryType::B:  // plane tipped from the nadir towards C0, then aside towards C270
            return {std::cos(q) * std::sin(p), -std::sin(q), std::cos(q) * std::cos(p)};
        case PhotometryType::C:
            break;
    }
    return {std::sin(q) * std::cos(p), std::sin(q) * std::sin(p), std::cos(q)};
}

Grid grid_of(PhotometryType type, std::vector<double> planes, std::vector<double> polar,
             const Intensity& intensity) {
    Grid grid{type, std::move(planes), std::move(polar), {}};
    for (const double plane : grid.planes_deg) {
        for (const double angle : grid.polar_deg) {
            grid.intensity_cd.push_back(intensity(direction_of(type, plane, angle)));
        }
    }
    return grid;
}

Grid full_sphere(PhotometryType type, std::size_t planes, std::size_t rings, const Intensity& intensity) {
    const double first = type == PhotometryType::C ? 0 : -180;
    const double pole = type == PhotometryType::C ? 0 : -90;
    return grid_of(type, angles(first, first + 360, planes), angles(pole, pole + 180, rings), intensity);
}

double isotropic(const Vec3&) { return 100; }
double cosine(const Vec3& d) { return 100 * std::max(d.z, 0.0); }
// Smooth, not symmetric in any way, positive.
double lopsided(const Vec3& d) {
    return 50 * (1.2 + d.x + 0.5 * d.y * d.z) * std::exp(0.7 * d.z + 0.3 * d.y);
}

// Intensities that no formula smooths: zero planes, zero rings, uneven steps; reaches one pole only.
Grid rough_grid(PhotometryType type) {
    const double first = type == PhotometryType::C ? 0 : -180;
    const double pole = type == PhotometryType::C ? 0 : -90;
    Grid grid{type, {}, {}, {}};
    for (const double plane : {0.0, 20.0, 45.0, 90.0, 100.0, 200.0, 300.0, 360.0}) {
        grid.planes_deg.push_back(first + plane);
    }
    for (const double angle : {0.0, 5.0, 30.0, 32.0, 80.0, 90.0, 120.0})
        grid.polar_deg.push_back(pole + angle);
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(0, 1000);
    for (std::size_t plane = 0; plane < grid.planes_deg.size(); ++plane) {
        for (std::size_t ring = 0; ring < grid.polar_deg.size(); ++ring) {
            const bool dark = plane == 2 || plane == 3 || ring == 4 || (plane == 5 && ring < 3);
            grid.intensity_cd.push_back(dark ? 0 : uniform(random));
        }
    }
    return grid;
}

// Midpoint rule in C and gamma, with nothing in common with the code under test but intensity_cd().
double midpoint_flux(const PhotometricSolid& solid, int planes, int rings, double last_deg = 180) {
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        const double gamma = (i + 0.5) * last_deg / rings;
        double ring = 0;
        for (int k = 0; k < planes; ++k) {
            ring += solid.intensity_cd(direction_of(PhotometryType::C, (k + 0.5) * 360 / planes, gamma));
        }
        sum += ring * std::sin(gamma * kDegree);
    }
    return sum * (2 * kPi / planes) * (last_deg * kDegree / rings);
}

TEST(PhotometricSolid, IsotropicHasFourPiTimesItsIntensity) {
    const std::vector<double> ends{0, 180};
    EXPECT_NEAR(PhotometricSolid({PhotometryType::C, {0}, ends, {100, 100}}).flux_lm(), 400 * kPi, 1e-10);
    for (const PhotometryType type : {PhotometryType::A, PhotometryType::B, PhotometryType::C}) {
        for (const std::size_t cells : {2, 7, 180, 3000}) {
            const PhotometricSolid solid(full_sphere(type, 4, cells, isotropic));
            EXPECT_NEAR(solid.flux_lm() / (400 * kPi), 1, 1e-13) << cells;
            EXPECT_DOUBLE_EQ(solid.intensity_cd(normalized(Vec3{0.3, -0.5, 0.2})), 100);
        }
    }
}

// Between the nodes lies a chord: the flux falls short by h^2/12 of itself, to first order.
TEST(PhotometricSolid, CosineHasPiTimesItsPeakWithinTheInterpolation) {
    for (const std::size_t cells : {18, 90, 720}) {
        const PhotometricSolid solid(grid_of(PhotometryType::C, {0}, angles(0, 90, cells), cosine));
        const double step = 90 * kDegree / static_cast<double>(cells);
        EXPECT_NEAR(solid.flux_lm() / (100 * kPi), 1 - step * step / 12, step * step * step * step);
        EXPECT_EQ(solid.peak_cd(), 100);
    }
}

TEST(PhotometricSolid, FluxIsThatOfFineQuadrature) {
    for (const PhotometryType type : {PhotometryType::A, PhotometryType::B, PhotometryType::C}) {
        const PhotometricSolid rough(rough_grid(type));
        EXPECT_NEAR(midpoint_flux(rough, 720, 1440) / rough.flux_lm(), 1, 2e-4);
        const PhotometricSolid smooth(full_sphere(type, 36, 36, lopsided));
        EXPECT_NEAR(midpoint_flux(smooth, 720, 720) / smooth.flux_lm(), 1, 1e-5);
    }
}

TEST(PhotometricSolid, ShareBelowIsThatOfFineQuadrature) {
    for (const PhotometryType type : {PhotometryType::A, PhotometryType::B, PhotometryType::C}) {
        const PhotometricSolid rough(rough_grid(type));
        EXPECT_NEAR(midpoint_flux(rough, 720, 720, 90) / rough.flux_lm(), rough.share_below(), 2e-4);
        for (const std::size_t rings : {1, 35, 36}) {  // the horizon within cells, and between them
            const PhotometricSolid smooth(full_sphere(type, 35, rings, lopsided));
            EXPECT_NEAR(midpoint_flux(smooth, 720, 720, 90) / smooth.flux_lm(), smooth.share_below(), 1e-5);
        }
    }
}

TEST(PhotometricSolid, ShareBelowOfOneSideIsExact) {
    for (const double uneven : {0.0, 1.0, 7.0}) {
        const Grid down{PhotometryType::C, {0, 90, 360}, {0, 31, 90}, {1, 2, uneven, 1, 3, 0, 1, 2, uneven}};
        EXPECT_EQ(PhotometricSolid(down).share_below(), 1);
        Grid up = down;
        up.polar_deg = {90, 120, 180};
        EXPECT_EQ(PhotometricSolid(up).share_below(), 0);
        Grid forwards = down;
        forwards.type = PhotometryType::B;
        forwards.planes_deg = {-90, 11, 90};
        EXPECT_EQ(PhotometricSolid(forwards).share_below(), 1);
    }
}

TEST(PhotometricSolid, NarrowCellsKeepTheirPrecision) {
    // A cone of a millionth of a radian, linear from 1 cd to 0: flux = pi r^2 / 3.
    const double radius_deg = 1e-4, radius = radius_deg * kDegree;
    const PhotometricSolid solid({PhotometryType::C, {0}, {0, radius_deg}, {1, 0}});
    EXPECT_NEAR(solid.flux_lm() / (kPi * radius * radius / 3), 1, 1e-11);
    // u2 = 1/2: of the mass x^2 (3 - 2 x) / 1, half lies below x = 1/2.
    const Vec3 middle = solid.sample_direction(0.25, 0.5);
    EXPECT_NEAR(std::hypot(middle.x, middle.y) / radius, 0.5, 1e-9);
}

TEST(PhotometricSolid, OneDistributionInThreeGridsIsOneDistribution) {
    const PhotometricSolid a(full_sphere(PhotometryType::A, 36, 18, lopsided));
    const PhotometricSolid b(full_sphere(PhotometryType::B, 36, 18, lopsided));
    const PhotometricSolid c(full_sphere(PhotometryType::C, 36, 18, lopsided));
    // Directions that are nodes of all three: the axes, and the main circles' nodes shared by two of them.
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        for (const Vec3& d : {axis, -axis}) {
            EXPECT_NEAR(a.intensity_cd(d), lopsided(d), 1e-9);
            EXPECT_NEAR(b.intensity_cd(d), lopsided(d), 1e-9);
            EXPECT_NEAR(c.intensity_cd(d), lopsided(d), 1e-9);
        }
    }
    for (double angle = -90; angle <= 90; angle += 10) {
        const Vec3 upright = direction_of(PhotometryType::C, 0, 90 + angle);
        EXPECT_NEAR(a.intensity_cd(upright), lopsided(upright), 1e-9);
        EXPECT_NEAR(b.intensity_cd(upright), lopsided(upright), 1e-9);
        EXPECT_NEAR(c.intensity_cd(upright), lopsided(upright), 1e-9);
        const Vec3 level = direction_of(PhotometryType::A, angle, 0);
        EXPECT_NEAR(a.intensity_cd(level), lopsided(level), 1e-9);
        EXPECT_NEAR(c.intensity_cd(level), lopsided(level), 1e-9);
    }
    double exact = 0;
    constexpr int kCells = 720;
    for (int i = 0; i < kCells; ++i) {
        const double gamma = (i + 0.5) * 180 / kCells;
        for (int k = 0; k < kCells; ++k) {
            exact += lopsided(direction_of(PhotometryType::C, (k + 0.5) * 360 / kCells, gamma)) *
                     std::sin(gamma * kDegree);
        }
    }
    exact *= 2 * kPi * kPi / (kCells * kCells);
    for (const PhotometricSolid* solid : {&a, &b, &c}) EXPECT_NEAR(solid->flux_lm() / exact, 1, 0.005);
    for (const PhotometryType type : {PhotometryType::A, PhotometryType::B, PhotometryType::C}) {
        const PhotometricSolid fine(full_sphere(type, 720, 360, lopsided));
        EXPECT_NEAR(fine.flux_lm() / exact, 1, 2e-5);
    }
}

TEST(PhotometricSolid, LightsOnlyWithinItsAngles) {
    const PhotometricSolid down({PhotometryType::C, {0}, {0, 90}, {10, 10}});
    EXPECT_EQ(down.intensity_cd({0, 0, 1}), 10);
    EXPECT_EQ(down.intensity_cd({1, 0, 0}), 10);
    EXPECT_EQ(down.intensity_cd(direction_of(PhotometryType::C, 33, 90.01)), 0);
    EXPECT_EQ(down.intensity_cd({0, 0, -1}), 0);
    const PhotometricSolid window({PhotometryType::A, {-30, 30}, {-20, 20}, {5, 5, 5, 5}});
    EXPECT_EQ(window.intensity_cd({1, 0, 0}), 5);
    EXPECT_EQ(window.intensity_cd(direction_of(PhotometryType::A, -30, 20)), 5);
    EXPECT_EQ(window.intensity_cd(direction_of(PhotometryType::A, 30.01, 0)), 0);
    EXPECT_EQ(window.intensity_cd(direction_of(PhotometryType::A, -30.01, 0)), 0);
    EXPECT_EQ(window.intensity_cd(direction_of(PhotometryType::A, 0, 20.01)), 0);
    EXPECT_EQ(window.intensity_cd({-1, 0, 0}), 0);
}

TEST(PhotometricSolid, BoundIsNeverLessThanTheIntensity) {
    const std::vector<PhotometricSolid> solids{
        PhotometricSolid({PhotometryType::C, {0}, {0, 90}, {10, 10}}),
        PhotometricSolid({PhotometryType::C,
                          {0, 90, 180, 270, 360},
                          {0, 1, 2, 60, 180},
                          {9, 1, 0, 5, 0, 9, 2, 0, 6, 0, 9, 30, 0, 0, 0, 9, 1, 0, 7, 1, 9, 1, 0, 5, 0}}),
        PhotometricSolid({PhotometryType::A, {-30, 30}, {-20, 20}, {5, 1, 2, 5}}),
        PhotometricSolid({PhotometryType::B, {-90, 0, 90}, {-60, 0, 60}, {1, 2, 3, 4, 5, 6, 7, 8, 9}})};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (const PhotometricSolid& solid : solids) {
        double mean = 0, mean_bound = 0;
        for (int i = 0; i < 100000; ++i) {
            const Vec3 any{uniform(random), uniform(random), uniform(random)};
            const Vec3 direction = normalized(any);
            const double bound = solid.intensity_bound_cd(direction);
            ASSERT_GE(bound, solid.intensity_cd(direction)) << i;
            ASSERT_LE(bound, solid.peak_cd());
            mean += solid.intensity_cd(direction);
            mean_bound += bound;
        }
        if (&solid == &solids[0]) {
            EXPECT_LT(mean_bound, 1.1 * mean);  // all planes are alike
        }
        for (const Vec3& pole : {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{0, 1, 0}, Vec3{0, -1, 0}}) {
            EXPECT_GE(solid.intensity_bound_cd(pole), solid.intensity_cd(pole));
        }
    }
}

TEST(PhotometricSolid, TypeCPlanesMayStartAnywhere) {
    const PhotometricSolid from_zero(
        {PhotometryType::C, {0, 90, 180, 270, 360}, {0, 180}, {1, 1, 2, 2, 3, 3, 4, 4, 1, 1}});
    const PhotometricSolid from_south(
        {PhotometryType::C, {270, 360, 450, 540, 630}, {0, 180}, {4, 4, 1, 1, 2, 2, 3, 3, 4, 4}});
    for (double plane = -170; plane < 360; plane += 7) {
        const Vec3 d = direction_of(PhotometryType::C, plane, 50);
        EXPECT_NEAR(from_zero.intensity_cd(d), from_south.intensity_cd(d), 1e-12);
    }
}

// Counts of samples in cells of C and gamma against the integral of intensity_cd() over each cell.
double p_value_of_sampling(const PhotometricSolid& solid) {
    constexpr std::size_t kPlanes = 24, kRings = 18, kFine = 24, kSamples = 1'000'000;
    std::vector<double> expected(kPlanes * kRings, 0), counted(kPlanes * kRings, 0);
    double total = 0;
    for (std::size_t i = 0; i < kRings * kFine; ++i) {
        const double gamma = (static_cast<double>(i) + 0.5) * 180 / (kRings * kFine);
        for (std::size_t k = 0; k < kPlanes * kFine; ++k) {
            const double plane = (static_cast<double>(k) + 0.5) * 360 / (kPlanes * kFine);
            const double share =
                solid.intensity_cd(direction_of(PhotometryType::C, plane, gamma)) * std::sin(gamma * kDegree);
            expected[(i / kFine) * kPlanes + k / kFine] += share;
            total += share;
        }
    }
    std::mt19937_64 random(20);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (std::size_t n = 0; n < kSamples; ++n) {
        const double u1 = uniform(random), u2 = uniform(random);
        const Vec3 d = solid.sample_direction(u1, u2);
        double plane = std::atan2(d.y, d.x) / (2 * kPi);
        if (plane < 0) plane += 1;
        const double gamma = std::acos(std::clamp(d.z, -1.0, 1.0)) / kPi;
        const auto cell = [](double share, std::size_t count) {
            return std::min(static_cast<std::size_t>(share * static_cast<double>(count)), count - 1);
        };
        counted[cell(gamma, kRings) * kPlanes + cell(plane, kPlanes)] += 1;
    }
    // Cells of few samples go together: chi-square wants at least some tens in each.
    double chi2 = 0, rest_expected = 0, rest_counted = 0;
    int cells = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const double e = expected[i] / total * kSamples;
        if (e < 50) {
            rest_expected += e;
            rest_counted += counted[i];
            continue;
        }
        chi2 += (counted[i] - e) * (counted[i] - e) / e;
        ++cells;
    }
    if (rest_expected >= 50) {
        chi2 += (rest_counted - rest_expected) * (rest_counted - rest_expected) / rest_expected;
        ++cells;
    } else {
        EXPECT_LE(rest_counted, rest_expected + 6 * std::sqrt(rest_expected) + 1);
    }
    return boost::math::cdf(complement(boost::math::chi_squared(cells - 1), chi2));
}

TEST(PhotometricSolid, SamplesFollowTheIntensity) {
    EXPECT_GT(p_value_of_sampling(PhotometricSolid({PhotometryType::C, {0}, {0, 180}, {1, 1}})), 1e-4);
    EXPECT_GT(
        p_value_of_sampling(PhotometricSolid(grid_of(PhotometryType::C, {0}, angles(0, 90, 18), cosine))),
        1e-4);
    EXPECT_GT(p_value_of_sampling(PhotometricSolid({PhotometryType::C, {0}, {0, 40, 180}, {0, 8, 0}})), 1e-4);
    EXPECT_GT(p_value_of_sampling(PhotometricSolid(full_sphere(PhotometryType::C, 24, 36, lopsided))), 1e-4);
    for (const PhotometryType type : {PhotometryType::A, PhotometryType::B, PhotometryType::C}) {
        EXPECT_GT(p_value_of_sampling(PhotometricSolid(rough_grid(type))), 1e-4);
    }
}

// The map from u to the direction must have the density as its Jacobian: finite differences, point by point.
TEST(PhotometricSolid, DensityIsTheInverseOfTheMapsStretching) {
    const PhotometricSolid solid(rough_grid(PhotometryType::C));
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(0.01, 0.99);
    constexpr double kStep = 1e-6;
    int checked = 0;
    for (int n = 0; n < 2000; ++n) {
        const double u1 = uniform(random), u2 = uniform(random);
        const auto derivative = [&](double d1, double d2) {
            const Vec3 up = solid.sample_direction(u1 + d1, u2 + d2);
            return (up - solid.sample_direction(u1 - d1, u2 - d2)) / (2 * kStep);
        };
        const double stretching = length(cross(derivative(kStep, 0), derivative(0, kStep)));
        const double expected = 1 / solid.pdf_per_sr(solid.sample_direction(u1, u2));
        if (std::abs(stretching / expected - 1) < 1e-3) ++checked;
    }
    EXPECT_GE(checked, 1980);  // the map has kinks at the grid's lines, which some differences straddle
}

TEST(PhotometricSolid, DensityIntegratesToOne) {
    for (const PhotometryType type : {PhotometryType::A, PhotometryType::B, PhotometryType::C}) {
        const PhotometricSolid solid(rough_grid(type));
        double integral = 0;
        constexpr int kSide = 720;
        for (int i = 0; i < kSide; ++i) {
            for (int k = 0; k < kSide; ++k) {  // equal areas: steps in cos gamma
                const double gamma = std::acos(1 - (i + 0.5) * 2 / kSide) / kDegree;
                integral += solid.pdf_per_sr(direction_of(PhotometryType::C, (k + 0.5) * 360 / kSide, gamma));
            }
        }
        EXPECT_NEAR(integral * 4 * kPi / (kSide * kSide), 1, 2e-4);
        const Vec3 d = direction_of(type, 13, 3);
        EXPECT_DOUBLE_EQ(solid.pdf_per_sr(d), solid.intensity_cd(d) / solid.flux_lm());
    }
}

// A direction of zero density would be an infinite weight; Sobol' points do contain 0, 1/2, 1/4 ...
TEST(PhotometricSolid, ExtremeNumbersGiveDirectionsOfPositiveDensity) {
    std::vector<double> extremes{0, 0x1p-60, 0x1p-53, 0x1p-32, 1 - 0x1p-32, 1 - 0x1p-53};
    for (int i = 1; i < 64; ++i) extremes.push_back(i / 64.0);
    std::vector<PhotometricSolid> solids{
        PhotometricSolid({PhotometryType::C, {0}, {0, 180}, {1, 1}}),
        PhotometricSolid({PhotometryType::C, {0}, {0, 90, 180}, {0, 1, 0}}),
        PhotometricSolid({PhotometryType::C, {0, 180, 360}, {0, 180}, {0, 0, 1, 1, 0, 0}}),
        PhotometricSolid({PhotometryType::C,
                          {0, 90, 180, 270, 360},
                          {0, 90, 180},
                          {0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0}})};
    // A plane that is dark but for its last ring, where samples come from by the next plane's share alone.
    solids.push_back(PhotometricSolid({PhotometryType::C,
                                       {0, 90, 180, 270, 360},
                                       {0, 45, 90},
                                       {0, 0, 18, 50, 60, 0, 0, 0, 18, 50, 60, 0, 0, 0, 18}}));
    for (const PhotometryType type : {PhotometryType::A, PhotometryType::B, PhotometryType::C}) {
        solids.emplace_back(rough_grid(type));
    }
    for (const PhotometricSolid& solid : solids) {
        for (const double u1 : extremes) {
            for (const double u2 : extremes) {
                const Vec3 d = solid.sample_direction(u1, u2);
                ASSERT_NEAR(length(d), 1, 1e-14);
                ASSERT_GT(solid.pdf_per_sr(d), 0) << u1 << ' ' << u2;
            }
        }
    }
}

TEST(PhotometricSolid, PolarAngleGrowsWithItsNumber) {
    const PhotometricSolid solid(rough_grid(PhotometryType::C));
    double last = 2;
    for (int i = 0; i < 100'000; ++i) {
        const double z = solid.sample_direction(0.3, i * 1e-5).z;
        ASSERT_LE(z, last);
        last = z;
    }
}

// The isotropic sphere has a closed form: z = 1 - 2 u2, azimuth 2 pi u1.
TEST(PhotometricSolid, InversionIsExact) {
    const PhotometricSolid one_cell({PhotometryType::C, {0}, {0, 180}, {1, 1}});
    const PhotometricSolid many(full_sphere(PhotometryType::C, 36, 72, isotropic));
    for (const PhotometricSolid* solid : {&one_cell, &many}) {
        for (const double u1 : {1e-9, 0.1, 0.7}) {
            for (const double u2 : {1e-12, 1e-6, 0.3, 0.5, 0.999999}) {
                const Vec3 d = solid->sample_direction(u1, u2);
                EXPECT_NEAR(d.z, 1 - 2 * u2, 1e-14);
                const double equator = 2 * std::sqrt(u2 * (1 - u2));
                EXPECT_NEAR(d.x / equator, std::cos(2 * kPi * u1), 1e-9);
                EXPECT_NEAR(d.y / equator, std::sin(2 * kPi * u1), 1e-9);
            }
        }
    }
}

void expect_rejected(const Grid& grid, const std::string& part) {
    try {
        PhotometricSolid solid(grid);
        ADD_FAILURE() << "accepted, expected: " << part;
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

TEST(PhotometricSolid, RejectsWhatIsNoDistribution) {
    const auto c = PhotometryType::C;
    expect_rejected({c, {}, {0, 90}, {}}, "needs at least one");
    expect_rejected({c, {0}, {0}, {1}}, "two angles or more");
    expect_rejected({c, {0}, {0, 90}, {0, 0}}, "all intensities are 0");
    expect_rejected({c, {0}, {0, 90}, {1, -1}}, "intensity -1 cd");
    expect_rejected({c, {0}, {0, 90}, {1, NAN}}, "intensity nan cd");
    expect_rejected({c, {0}, {0, 90}, {1, 1, 1}}, "3 intensities for 1 planes of 2 angles");
    expect_rejected({c, {0}, {0, 190}, {1, 1}}, "polar angle 190 is outside");
    expect_rejected({c, {0}, {0, NAN}, {1, 1}}, "polar angle nan is outside");
    expect_rejected({c, {0}, {90, 90}, {1, 1}}, "angles must increase");
    expect_rejected({c, {0, 180}, {0, 90}, {1, 1, 1, 1}}, "span 180 degrees");
    expect_rejected({PhotometryType::B, {0}, {0, 90}, {1, 1}}, "needs at least two");
    expect_rejected({PhotometryType::A, {-200, 0}, {0, 90}, {1, 1, 1, 1}}, "plane angle -200 is outside");
    expect_rejected({c, {0}, {0, 90}, {1e308, 1e308}}, "out of range");
}

}  // namespace
}  // namespace stilb::lights
