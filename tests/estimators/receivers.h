// Receivers of illuminance for tests.
#pragma once

#include <vector>

#include "transport/receiver.h"

namespace stilb {

/// One for each point, sorted; readings in the order of the points.
inline std::vector<Receiver> receivers_of(const std::vector<MeasuringPoint>& points,
                                          const RayCaster& caster) {
    std::vector<Receiver> receivers;
    for (std::uint32_t j = 0; j < points.size(); ++j) receivers.emplace_back(j, points[j], caster);
    return sorted_receivers(std::move(receivers));
}

}  // namespace stilb
