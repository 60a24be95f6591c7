#include "io/results/sub_point.h"

namespace stilb::io {

std::optional<Vec3> sub_point(const SensorResult& result, const Sensor& sensor, std::size_t j) {
    if (const auto* ray = std::get_if<EmergentRay>(&sensor.measurands[j])) return ray->position;
    return result.sub_points.empty() ? std::nullopt : result.sub_points[j];
}

}  // namespace stilb::io
