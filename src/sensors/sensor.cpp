#include "sensors/sensor.h"

#include <utility>

#include "rays/ray_caster.h"

namespace stilb::sensors {

MeasuringPoint place_of(const Measurand& measurand) {
    if (const auto* sight = std::get_if<LineOfSight>(&measurand)) return {sight->position, sight->direction};
    if (const auto* ray = std::get_if<EmergentRay>(&measurand)) return {ray->position, ray->normal};
    return std::get<MeasuringPoint>(measurand);
}

std::optional<rays::Hit> surface_at(const MeasuringPoint& point, const rays::RayCaster& caster) {
    const double most = caster.offset_m(point.position, caster.half_extent_m());
    const auto below = caster.closest(point.position + most * point.normal, -point.normal);
    return below && below->distance_m < 2 * most ? below : std::nullopt;
}

Vec3 lifted_position(const MeasuringPoint& point, const rays::RayCaster& caster) {
    if (const auto surface = surface_at(point, caster)) return surface->lifted;
    return point.position + caster.offset_m(point.position, 0) * point.normal;
}

Sensor make_grid_sensor(std::string name, const Grid& grid, const Vec3& normal) {
    Sensor sensor{std::move(name), SensorType::grid, {}, grid};
    const auto [nu, nv] = grid.count;
    for (int v = 0; v < nv; ++v) {
        for (int u = 0; u < nu; ++u) {
            const Vec3 position = grid.corner + (u + 0.5) / nu * grid.edge_u + (v + 0.5) / nv * grid.edge_v;
            sensor.measurands.push_back(MeasuringPoint{position, normal});
        }
    }
    return sensor;
}

}  // namespace stilb::sensors
