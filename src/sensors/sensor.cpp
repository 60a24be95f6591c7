#include "sensors/sensor.h"

#include <utility>

namespace stilb {

Sensor make_grid_sensor(std::string name, const Grid& grid, const Vec3& normal) {
    Sensor sensor{std::move(name), SensorType::grid, {}, grid};
    const auto [nu, nv] = grid.count;
    for (int v = 0; v < nv; ++v) {
        for (int u = 0; u < nu; ++u) {
            const Vec3 position = grid.corner + (u + 0.5) / nu * grid.edge_u + (v + 0.5) / nv * grid.edge_v;
            sensor.points.push_back({position, normal});
        }
    }
    return sensor;
}

}  // namespace stilb
