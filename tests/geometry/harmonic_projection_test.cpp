#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "geometry/harmonics/projection.h"
#include "support/harmonic_shapes.h"

namespace stilb::geometry {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<double> random_coefficients(int degree, std::uint64_t seed) {
    Numbers numbers(seed);
    std::vector<double> coefficients(math::harmonic_count(degree));
    for (double& c : coefficients) c = numbers.next() - 0.5;
    return coefficients;
}

/// By another way than the projection's: the series itself, point by point or by parallels.
std::vector<double> values_of(std::span<const double> coefficients, const ParallelGrid& grid) {
    const math::HarmonicSeries<double> series(coefficients);
    std::vector<double> values;
    for (std::size_t parallel = 0; parallel < grid.parallels(); ++parallel) {
        if (grid.first_phi == 0) {
            const auto own = series.on_parallel(grid.z[parallel], grid.azimuths);
            values.insert(values.end(), own.begin(), own.end());
            continue;
        }
        for (std::size_t k = 0; k < grid.azimuths; ++k)
            values.push_back(series.at(grid.direction(parallel, k)));
    }
    return values;
}

TEST(ParallelGrid, HasTheAreaOfTheSphere) {
    for (const ParallelGrid& grid : {gauss_grid(1), gauss_grid(40), even_grid(7), even_grid(317)}) {
        double sum = 0;
        for (const double weight : grid.weights_sr) sum += weight * static_cast<double>(grid.azimuths);
        EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-12);
        for (const Vec3& direction : grid.directions()) ASSERT_NEAR(length(direction), 1, 1e-15);
    }
}

/// As few nodes as possible: every coefficient comes back, so that all pairs of harmonics are orthonormal.
TEST(Projection, IsOrthonormalUpToDegree128) {
    constexpr int degree = 128;
    const std::vector<double> coefficients = random_coefficients(degree, 1);
    const ParallelGrid grid = gauss_grid(degree + 1);
    const std::vector<double> values = values_of(coefficients, grid);
    const std::vector<double> projected = project(grid, values, degree);
    for (std::size_t i = 0; i < projected.size(); ++i) ASSERT_NEAR(projected[i], coefficients[i], 1e-11) << i;

    // Parseval: the sum of squares is the integral of the square.
    double integral = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        integral += grid.weights_sr[i / grid.azimuths] * values[i] * values[i];
    EXPECT_NEAR(std::inner_product(projected.begin(), projected.end(), projected.begin(), 0.0), integral,
                1e-10 * integral);
}

TEST(Projection, OfOneHarmonicIsThatOneAlone) {
    constexpr int degree = 20;
    for (const auto& [l, m] : {std::pair{0, 0}, {3, -2}, {20, 20}, {20, -20}, {17, 0}, {19, 5}}) {
        std::vector<double> one(math::harmonic_count(degree));
        one[math::harmonic_number(l, m)] = 1;
        const ParallelGrid grid = gauss_grid(degree + 1);
        const std::vector<double> projected = project(grid, values_of(one, grid), degree);
        for (std::size_t i = 0; i < one.size(); ++i)
            ASSERT_NEAR(projected[i], one[i], 1e-13) << l << ' ' << m;
    }
}

TEST(Projection, DoesNotMistakeHigherDegreesForLowerOnes) {
    constexpr int high = 100;
    std::vector<double> coefficients = random_coefficients(high, 2);
    for (std::size_t i = 0; i < math::harmonic_count(high - 1); ++i) coefficients[i] = 0;
    const ParallelGrid enough = gauss_grid(67);  // 2 * 67 - 1 - 32 = 101
    for (const double c : project(enough, values_of(coefficients, enough), 32)) ASSERT_NEAR(c, 0, 1e-12);
    const ParallelGrid too_few = gauss_grid(50);
    const std::vector<double> aliased = project(too_few, values_of(coefficients, too_few), 32);
    EXPECT_GT(*std::max_element(aliased.begin(), aliased.end()), 1e-3);
}

TEST(ErrorsByDegree, AreThoseOfShorterSeries) {
    const std::vector<double> truth = random_coefficients(12, 3);
    const ParallelGrid grid = even_grid(23);
    std::vector<double> values = values_of(truth, grid);
    values[100] = kNaN;
    const std::vector<DegreeError> errors = errors_by_degree(grid, values, truth);
    ASSERT_EQ(errors.size(), 13u);
    for (const int degree : {0, 1, 7, 11}) {
        std::vector<double> shorter(
            truth.begin(), truth.begin() + static_cast<std::ptrdiff_t>(math::harmonic_count(degree)));
        const std::vector<double> own = values_of(shorter, grid);
        double squares = 0, weights = 0, maximum = 0;
        for (std::size_t i = 0; i < own.size(); ++i) {
            if (i == 100) continue;
            const double weight = grid.weights_sr[i / grid.azimuths], off = std::abs(own[i] - values[i]);
            squares += weight * off * off, weights += weight;
            maximum = std::max(maximum, off);
        }
        EXPECT_NEAR(errors[static_cast<std::size_t>(degree)].rms, std::sqrt(squares / weights), 1e-12);
        EXPECT_NEAR(errors[static_cast<std::size_t>(degree)].maximum, maximum, 1e-12);
    }
    EXPECT_LT(errors[12].maximum, 1e-12);
}

TEST(FillHoles, ContinuesWhatIsBesideThem) {
    const ParallelGrid grid = even_grid(20);
    std::vector<double> values(grid.size(), 2.5);
    for (std::size_t i = 0; i < 250; ++i) values[i] = kNaN;  // a cap, with the first parallel
    values[400] = values[401] = kNaN;
    fill_holes(grid, values);
    for (const double value : values) EXPECT_DOUBLE_EQ(value, 2.5);
}

TEST(FillHoles, TakesTheMeanOfNeighbours) {
    const ParallelGrid grid = even_grid(4);
    std::vector<double> values(grid.size(), 1);
    const std::size_t hole = 2 * grid.azimuths;  // at phi's seam
    values[hole] = kNaN;
    values[hole + 1] = 2, values[hole + grid.azimuths - 1] = 3, values[hole - grid.azimuths] = 4;
    fill_holes(grid, values);
    EXPECT_DOUBLE_EQ(values[hole], (2 + 3 + 4 + 1) / 4.);
}

TEST(FillHoles, NeedsSomethingToGoBy) {
    const ParallelGrid grid = even_grid(4);
    std::vector<double> values(grid.size(), kNaN);
    EXPECT_THROW(fill_holes(grid, values), std::invalid_argument);
}

}  // namespace
}  // namespace stilb::geometry
