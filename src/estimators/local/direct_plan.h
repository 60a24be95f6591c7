// Planning of the number of samples of direct light.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "estimators/local/split_plan.h"
#include "transport/direct/direct_light.h"

namespace stilb::estimators {

/// Samples of the direct light that has no closed form, for planning.
struct DirectPilot {
    std::vector<double> direct;     ///< of each reading: all direct light, by its mean [lx or cd/m2]
    std::vector<double> variances;  ///< of each receiver: of a sample [(lx or cd/m2)^2]
    int samples = 0;
};

/// The cost of a sample per shadow ray, in the unit of SplitPlans: most of it is the choice of a point of the
/// lamp.
inline constexpr double kDirectRayCost = 9;

/// For each tile of receivers, the number of selected light paths for each sample of its direct light, a
/// power of two up to `most`: as worthwhile as the light paths of `plans`. A pilot of few samples may see
/// nothing, or all, of a lamp of which a part is seen, so that its variance has a lower bound by their
/// number. `weights`: of every reading.
std::vector<std::uint64_t> plan_direct(std::span<const transport::Receiver> receivers,
                                       std::span<const transport::DirectLight::Remainder> remainders,
                                       std::span<const double> weights, const DirectPilot& pilot,
                                       const SplitPlans& plans, std::uint64_t most);

}  // namespace stilb::estimators
