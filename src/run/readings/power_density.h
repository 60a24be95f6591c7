// The installed power per square metre of the task areas, and per 100 lx of their mean; and per square metre
// of the floors of rooms.
#pragma once

#include <optional>
#include <span>

#include "rays/ray_caster.h"
#include "run/readings/sensor_estimates.h"
#include "run/result.h"

namespace stilb::run {

/// Over all horizontal sensors of type "area" that are no bands, together; nothing where there are none, or
/// no power is known. `estimates`: of the sensors.
std::optional<PowerDensity> power_density(const scene::InstalledPower& power, std::span<const Sensor> sensors,
                                          std::span<const SensorEstimates> estimates, double confidence);

/// Of the rooms (sensors/areas/rooms.h) in which there are lamps, from the lowest floor up; none where no
/// power is known.
std::vector<RoomPower> power_of_rooms(const Scene& scene, const rays::RayCaster& caster);

}  // namespace stilb::run
