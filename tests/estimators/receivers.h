// Receivers of illuminance for tests.
#pragma once

#include <vector>

#include "transport/receiver.h"

namespace stilb::estimators {

/// One for each point, sorted; readings in the order of the points.
inline std::vector<transport::Receiver> receivers_of(const std::vector<MeasuringPoint>& points,
                                                     const rays::RayCaster& caster) {
    std::vector<transport::Receiver> receivers;
    for (std::uint32_t j = 0; j < points.size(); ++j) receivers.emplace_back(j, points[j], caster);
    return sorted_receivers(std::move(receivers));
}

}  // namespace stilb::estimators
