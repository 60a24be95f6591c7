#include <gtest/gtest.h>

#include <boost/random/sobol.hpp>
#include <cmath>
#include <set>
#include <vector>

#include "math/random.h"
#include "statistics/hypothesis.h"
#include "support/moments.h"

namespace stilb::math {
namespace {

constexpr double kLeastChance = 1e-4;

TEST(Sobol, HasTheDirectionNumbersOfBoost) {
    // boost's i-th point is that of index gray(i + 1): it begins with point 1 and changes one bit a step.
    boost::random::sobol_engine<std::uint32_t, 32> engine(kSobolDimensions);
    for (std::uint32_t i = 1; i <= 5000; ++i) {
        for (unsigned d = 0; d < kSobolDimensions; ++d) {
            ASSERT_EQ(sobol(i ^ (i >> 1), d), engine()) << "point " << i << ", dimension " << d;
        }
    }
}

TEST(Sobol, EveryDimensionIsANetByItself) {
    for (unsigned d = 0; d < kSobolDimensions; ++d) {
        for (const std::uint32_t first : {0u, 256u, 7u * 256}) {
            std::set<std::uint32_t> cells;
            for (std::uint32_t i = 0; i < 256; ++i) cells.insert(sobol(first + i, d) >> 24);
            EXPECT_EQ(cells.size(), 256u) << "dimension " << d << " from " << first;
        }
    }
}

/// Whether each of the 2^bits cells 2^-a x 2^-(bits - a), for every a, holds exactly one of 2^bits points.
template <typename Coordinate>
void expect_net(unsigned bits, const Coordinate& coordinate) {
    for (unsigned a = 0; a <= bits; ++a) {
        std::set<std::pair<int, int>> cells;
        for (std::uint32_t i = 0; i < 1u << bits; ++i) {
            cells.emplace(static_cast<int>(std::ldexp(coordinate(i, 0), static_cast<int>(a))),
                          static_cast<int>(std::ldexp(coordinate(i, 1), static_cast<int>(bits - a))));
        }
        EXPECT_EQ(cells.size(), std::size_t{1} << bits) << a << " of " << bits << " bits";
    }
}

/// Without a shift the points are a net; with any shift they stay in the unit square, one to each strip.
TEST(EvenPoints, LieEvenlyUnderAnyShift) {
    constexpr std::uint32_t count = 64;
    expect_net(6, [](std::uint32_t i, unsigned d) { return even_point(i, count, {0, 0})[d]; });
    for (const std::array<double, 2> shift : {std::array{0.999999, 0.999999}, {0.3, 0.7}}) {
        std::set<int> strips, turned;
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto [x, y] = even_point(i, count, shift);
            ASSERT_TRUE(x >= 0 && x < 1 && y >= 0 && y < 1) << x << ' ' << y;
            strips.insert(static_cast<int>(x * count));
            turned.insert(static_cast<int>((y + 1 - shift[1]) * count + 0.5) % static_cast<int>(count));
        }
        EXPECT_EQ(strips.size(), count);
        EXPECT_EQ(turned.size(), count);
    }
}

TEST(Sobol, ItsFirstTwoDimensionsAreANet) {
    for (const unsigned bits : {4u, 8u, 12u}) {
        expect_net(bits, [](std::uint32_t i, unsigned d) { return sobol(i, d) * 0x1p-32; });
    }
}

TEST(ScrambledSobol, KeepsTheNet) {
    for (std::uint32_t scramble = 1; scramble < 20; ++scramble) {
        const std::uint32_t seeds[]{scramble * 0x9e3779b9u, scramble * 0x85ebca6bu};
        expect_net(
            10, [&](std::uint32_t i, unsigned d) { return unit_interval(scrambled_sobol(i, d, seeds[d])); });
    }
}

/// Coordinate `dimension` of point `index` under key `key`.
double coordinate(std::uint64_t key, std::uint64_t index, unsigned dimension) {
    SampleStream stream(RandomKey{1}.derived(key), index);
    for (unsigned d = 0; d < dimension; ++d) stream.next();
    return stream.next();
}

TEST(SampleStream, EveryPointIsUniformOverKeys) {
    constexpr int kKeys = 4000;
    for (const std::uint64_t index : {0u, 1u, 2u, 1000u, 123'456'789u}) {
        for (const unsigned dimension : {0u, 1u, 2u, 7u, 31u, 32u, 35u, 100u}) {
            std::vector<double> numbers;
            for (int key = 0; key < kKeys; ++key) numbers.push_back(coordinate(key, index, dimension));
            EXPECT_GT(statistics::uniformity_p(numbers), kLeastChance)
                << "point " << index << ", dimension " << dimension;
        }
    }
}

TEST(SampleStream, IsUniformBeyondTheSobolDimensions) {
    for (const unsigned dimension : {32u, 33u, 34u, 35u, 36u, 200u}) {
        std::vector<double> numbers;
        for (std::uint64_t i = 0; i < 20'000; ++i) numbers.push_back(coordinate(5, i, dimension));
        EXPECT_GT(statistics::uniformity_p(numbers), kLeastChance) << dimension;
    }
}

/// The chance of the counts of pairs of numbers on a grid of 16 x 16, were they independent.
template <typename Pair>
double independence_p(int count, const Pair& pair) {
    constexpr int kCells = 16;
    std::vector<double> observed(kCells * kCells);
    for (int i = 0; i < count; ++i) {
        const auto [a, b] = pair(i);
        ++observed[static_cast<std::size_t>(static_cast<int>(a * kCells) * kCells +
                                            static_cast<int>(b * kCells))];
    }
    const std::vector<double> expected(observed.size(), static_cast<double>(count) / (kCells * kCells));
    return statistics::chi2_test(observed, expected).p_value;
}

TEST(SampleStream, KeysAndDimensionsAreIndependent) {
    constexpr int kPairs = 20'000;
    // The same point under neighbouring keys, and two dimensions of one point, over keys.
    for (const unsigned d : {0u, 1u, 5u, 31u, 32u, 40u}) {
        const auto over_keys = [&](int i) {
            return std::pair{coordinate(2 * i, 3, d), coordinate(2 * i + 1, 3, d)};
        };
        EXPECT_GT(independence_p(kPairs, over_keys), kLeastChance) << "keys, dimension " << d;
        const auto over_dimensions = [&](int i) {
            return std::pair{coordinate(i, 3, d), coordinate(i, 3, d + 1)};
        };
        EXPECT_GT(independence_p(kPairs, over_dimensions), kLeastChance) << "dimensions " << d << " and next";
    }
    // Two derived keys' sequences: pairs of equal index must not follow each other.
    for (const unsigned d : {0u, 1u, 31u, 32u}) {
        statistics::RunningMoments correlation;
        for (std::uint64_t key = 0; key < 400; ++key) {
            statistics::RunningMoments products;
            for (std::uint64_t i = 0; i < 64; ++i) {
                products.add((coordinate(2 * key, i, d) - 0.5) * (coordinate(2 * key + 1, i, d) - 0.5));
            }
            correlation.add(products.mean());
        }
        EXPECT_LT(std::abs(correlation.mean()), 4 * correlation.standard_error()) << "dimension " << d;
    }
}

/// Variance over keys of the mean of a smooth function, of mean 1, at `count` points of four dimensions.
statistics::RunningMoments means_of_smooth_function(std::uint64_t count) {
    statistics::RunningMoments means;
    for (std::uint64_t key = 0; key < 400; ++key) {
        double sum = 0;
        for (std::uint64_t i = 0; i < count; ++i) {
            SampleStream stream(RandomKey{9}.derived(key), i);
            double product = 1;
            for (int d = 0; d < 4; ++d) product *= 0.5 + stream.next();
            sum += product;
        }
        means.add(sum / static_cast<double>(count));
    }
    return means;
}

TEST(SampleStream, VarianceFallsFasterThanWithRandomNumbers) {
    const statistics::RunningMoments few = means_of_smooth_function(16),
                                     many = means_of_smooth_function(1024);
    EXPECT_LT(std::abs(few.mean() - 1), 4 * few.standard_error());
    EXPECT_LT(std::abs(many.mean() - 1), 4 * many.standard_error());
    // 64 times the points: random numbers divide the variance by 64.
    EXPECT_GT(few.variance() / many.variance(), 1000);
}

}  // namespace
}  // namespace stilb::math
