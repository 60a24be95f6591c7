// Mistakes in where sensors and lights stand: closed surfaces between them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "checks/enclosures.h"
#include "sensors/sensor.h"

namespace stilb::checks {

/// A sentence for every sensor with points that no light can reach, because a closed surface lies around the
/// point and no light in it (or around all lights and not the point), and for every light that likewise
/// reaches no point of any sensor. And for every sensor with bodies that lie on surfaces.
std::vector<std::string> placement_warnings(const Scene& scene, const rays::RayCaster& caster,
                                            std::span<const Sensor> sensors);

}  // namespace stilb::checks
