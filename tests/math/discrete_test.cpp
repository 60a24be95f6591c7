#include <gtest/gtest.h>

#include "math/sampling.h"
#include "statistics/hypothesis.h"
#include "support/random_pairs.h"

namespace stilb::math {
namespace {

constexpr double kLeastP = 1e-4;
const std::vector<double> kWeights{0, 3, 0, 0, 1, 0.25, 1e-3, 5, 0};

TEST(DiscreteDistribution, ChoosesInProportionToWeightsAndNeverZero) {
    const DiscreteDistribution distribution(kWeights);
    EXPECT_NEAR(distribution.total(), 9.251, 1e-12);
    constexpr int kDraws = 200'000;
    std::vector<double> observed(kWeights.size()), expected;
    for (const double weight : kWeights) expected.push_back(kDraws * weight / distribution.total());
    RandomPairs random(1);
    for (int i = 0; i < kDraws; ++i) {
        const auto choice = distribution.choose(random.next());
        ++observed[choice.index];
        EXPECT_NEAR(choice.probability, kWeights[choice.index] / distribution.total(), 1e-12);
    }
    EXPECT_GT(statistics::chi2_test(observed, expected).p_value, kLeastP);
}

TEST(DiscreteDistribution, TakesTheEndsOfItsRange) {
    const DiscreteDistribution distribution(kWeights);
    EXPECT_EQ(distribution.choose(0).index, 1u);
    EXPECT_EQ(distribution.choose(1 - 0x1p-53).index, 7u);
    for (const double weight : {1e-300, 1e300}) {
        EXPECT_EQ(DiscreteDistribution(std::vector{0.0, weight, 0.0}).choose(1 - 0x1p-53).index, 1u);
    }
}

TEST(DiscreteDistribution, RemaindersAreUniformWhateverWasChosen) {
    const DiscreteDistribution distribution(kWeights);
    std::vector<std::vector<double>> remainders(kWeights.size());
    RandomPairs random(2);
    for (int i = 0; i < 100'000; ++i) {
        const auto choice = distribution.choose(random.next());
        ASSERT_GE(choice.remainder, 0);
        ASSERT_LT(choice.remainder, 1);
        remainders[choice.index].push_back(choice.remainder);
    }
    for (const auto& numbers : remainders) {
        if (numbers.size() < 8) continue;
        EXPECT_GT(statistics::uniformity_p(numbers), kLeastP) << numbers.size();
    }
}

}  // namespace
}  // namespace stilb::math
