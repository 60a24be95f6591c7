// The installed power per square metre of the task areas, and per 100 lx of their mean.
#pragma once

#include <optional>
#include <span>

#include "run/result.h"
#include "run/sensor_estimates.h"

namespace stilb::run {

/// Over all horizontal sensors of type "area" that are no bands, together; nothing where there are none, or
/// no power is known. `estimates`: of the sensors.
std::optional<PowerDensity> power_density(const scene::InstalledPower& power, std::span<const Sensor> sensors,
                                          std::span<const SensorEstimates> estimates, double confidence);

}  // namespace stilb::run
