#include "io/results/locations.h"

namespace stilb::io {

using Json = nlohmann::ordered_json;

Json vector_json(const Vec3& v) { return {v.x, v.y, v.z}; }

Json location_json(const Location& location) {
    Json json{{"position", vector_json(location.position)}};
    for (const Location::Direction& direction : location.directions)
        json[std::string(direction.name)] = vector_json(direction.value);
    return json;
}

std::optional<Vec3> sub_point(const SensorResult& result, const Sensor& sensor, std::size_t j) {
    const Measurand measurand = sensor.measurand(j);
    if (const auto* ray = std::get_if<EmergentRay>(&measurand)) return ray->position;
    return result.sub_points.empty() ? std::nullopt : result.sub_points[j];
}

}  // namespace stilb::io
