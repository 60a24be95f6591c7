#include "transport/direct/open_lamps.h"

#include "math/sampling.h"

namespace stilb::transport {

void OpenLamps::finish() {
    constexpr double kEqualShare = 0.1;
    double all_lx = 0;
    for (const double lx : sums_) all_lx += lx;
    const double equally = kEqualShare * all_lx / static_cast<double>(sums_.size());
    double sum = 0;
    for (double& weight : sums_) weight = sum += (1 - kEqualShare) * weight + equally;
}

auto OpenLamps::choose(std::size_t i, double first) const -> Choice {
    if (lamps_.size() <= kChosen) return {lamps_[i]};
    const double u = (static_cast<double>(i) + first) / kChosen;
    const math::DiscreteChoice choice = math::choose_by_sums(sums_, u);
    return {lamps_[choice.index], 1 / (kChosen * choice.probability)};
}

}  // namespace stilb::transport
