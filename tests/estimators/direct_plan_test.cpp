#include "estimators/local/direct_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/scene_builder.h"

namespace stilb::estimators {
namespace {

constexpr std::uint64_t kMost = 32;
constexpr int kPlanSamples = 63;

/// Two tiles of readings of 100 lx, half of it direct, each with one lamp that may be hidden.
struct Problem {
    Scene scene = [] {
        Scene built;
        add_object(built, Box{{0, 0, 0}, {1, 1, 1}}, diffuse(0.5));
        return built;
    }();
    rays::RayCaster caster{scene};
    std::vector<transport::Receiver> receivers;
    std::vector<transport::DirectLight::Remainder> remainders;
    std::vector<double> weights;
    DirectPilot pilot;
    SplitPlans plans;

    Problem() {
        for (std::uint32_t j = 0; j < 2 * kPacketWidth; ++j) {
            receivers.emplace_back(j, MeasuringPoint{{0.5, 0.5, 0.5}, {0, 0, 1}}, caster);
            weights.push_back(1);
            pilot.direct.push_back(50);
            pilot.variances.push_back(0);
            plans.of_receivers.push_back({1, 1, 0, 50});
        }
        pilot.samples = kPlanSamples;
        remainders.resize(2);
        for (auto& remainder : remainders) remainder.lamps.fill(1);
    }
    std::vector<std::uint64_t> plan() const {
        return plan_direct(receivers, remainders, weights, pilot, plans, kMost);
    }
    void set_variance(std::size_t tile, double variance) {
        std::fill_n(pilot.variances.begin() + static_cast<std::ptrdiff_t>(tile * kPacketWidth), kPacketWidth,
                    variance);
    }
};

TEST(DirectPlan, IsTheBestPowerOfTwo) {
    Problem problem;
    problem.plans.variance_per_cost = 0.1;
    for (const double variance : {1000.0, 5000.0, 100.0, 0.0}) {
        problem.set_variance(0, variance);
        const double relative = variance / (100 * 100) + 0.25 / (kPlanSamples + 1);
        const auto loss = [&](std::uint64_t paths) {
            const auto m = static_cast<double>(paths);
            return kPacketWidth * (relative * m + problem.plans.variance_per_cost * kDirectRayCost / m);
        };
        const std::uint64_t planned = problem.plan()[0];
        for (std::uint64_t paths = 1; paths <= kMost; paths *= 2) EXPECT_LE(loss(planned), loss(paths));
    }
}

TEST(DirectPlan, TilesHaveTheirOwn) {
    Problem problem;
    problem.plans.variance_per_cost = 1;
    problem.set_variance(0, 50 * 50);
    const auto planned = problem.plan();
    EXPECT_LT(planned[0], planned[1]);
    EXPECT_LE(planned[1], kMost);
}

TEST(DirectPlan, SamplesWithEachPathWhereNothingElseVaries) {
    Problem problem;
    problem.plans.variance_per_cost = 0;
    EXPECT_EQ(problem.plan(), (std::vector<std::uint64_t>{1, 1}));
}

TEST(DirectPlan, ReadingsOfNoWeightTakeFewest) {
    Problem problem;
    problem.plans.variance_per_cost = 1;
    problem.set_variance(0, 50 * 50);
    std::fill_n(problem.weights.begin(), kPacketWidth, 0.0);
    EXPECT_EQ(problem.plan()[0], kMost);
}

}  // namespace
}  // namespace stilb::estimators
