// Readings by an estimator in independent replicates, without a run around it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "estimators/estimator.h"
#include "statistics/hypothesis.h"
#include "statistics/interval.h"
#include "transport/receiver.h"

namespace stilb::estimators {

inline constexpr std::size_t kReplicates = 32;

using Maker = std::unique_ptr<Estimator> (*)(const Problem&);

/// `samples`: of each replicate; rounded up to the method's granularity.
inline std::vector<statistics::Estimate> estimates_of(const Estimator& method, std::size_t readings,
                                                      math::RandomKey key, std::uint64_t samples) {
    const std::uint64_t granularity = method.batch_granularity();
    const std::uint64_t count = (samples + granularity - 1) / granularity * granularity;
    std::vector<double> means(kReplicates * readings);
    parallel_for(kReplicates, [&](std::size_t r) {
        Tally sums(readings);
        method.run_batch({key.derived(r), 0, count}, sums);
        for (std::size_t j = 0; j < readings; ++j) {
            const Rgb mean = sums.sum[j] * (1 / static_cast<double>(count));
            means[r * readings + j] = (method.known_part()[j] + mean).luminance();
        }
    });
    return statistics::estimate_readings({means, readings});
}

/// A scene in which some points are measured without a limit on reflections.
struct MeasuredScene {
    MeasuredScene(Scene made, std::vector<Measurand> asked)
        : scene(std::move(made)), caster(scene), measurands(std::move(asked)) {}

    Problem problem() const {
        return {.scene = scene,
                .caster = caster,
                .max_reflections = transport::kUnlimited,
                .preparation_key = {math::RandomKey{1}},
                .measurands = measurands};
    }
    std::vector<statistics::Estimate> by(Maker make, std::uint64_t samples, std::uint64_t seed = 1) const {
        return estimates_of(*make(problem()), measurands.size(), math::RandomKey{seed}, samples);
    }

    Scene scene;
    rays::RayCaster caster;
    std::vector<Measurand> measurands;
};

/// How many standard errors lie between two estimates, as of a normal distribution; exact ones must agree to
/// rounding errors.
inline double distance_of(const statistics::Estimate& a, const statistics::Estimate& b) {
    const double rounding = 1e-6 * std::max(std::abs(a.value), std::abs(b.value));
    if (std::abs(a.value - b.value) <= rounding) return 0;
    return std::abs(statistics::equivalent_z(statistics::z_score(a, b), kReplicates - 1));
}

}  // namespace stilb::estimators
