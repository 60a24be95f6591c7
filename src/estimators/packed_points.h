// The measuring points of a run in an order in which neighbours in space share packets of rays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/ray_caster.h"
#include "sensors/sensor.h"

namespace stilb {

/// A measuring point as rays need it.
struct PackedPoint {
    Vec3 position;
    Vec3 lifted;  ///< where rays start
    Vec3 normal;
    std::uint32_t reading = 0;  ///< its place among the run's readings
};

/// Sorted along a space-filling (Morton) curve. A packet is kPacketWidth points from a multiple of
/// kPacketWidth on.
using PackedPoints = std::vector<PackedPoint>;

PackedPoints packed(std::span<const Measurand> measurands, const RayCaster& caster);

}  // namespace stilb
