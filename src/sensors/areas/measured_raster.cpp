#include "sensors/areas/measured_raster.h"

#include <algorithm>

namespace stilb::sensors {

const Grid* raster_of(const Sensor& sensor) {
    if (const auto* grid = std::get_if<Grid>(&sensor.kind)) return grid;
    const auto* area = std::get_if<Area>(&sensor.kind);
    return area && !area->surfaces.are_given() ? &area->raster : nullptr;
}

std::vector<std::size_t> cells_of_readings(const Sensor& sensor) {
    const Grid& raster = *raster_of(sensor);
    const auto cell_along = [&](const Vec3& position, const Vec3& edge, int count) {
        const double share = dot(position - raster.corner, edge) / squared_length(edge);
        return static_cast<std::size_t>(std::clamp(static_cast<int>(share * count), 0, count - 1));
    };
    const bool is_grid = std::holds_alternative<Grid>(sensor.kind);
    std::vector<std::size_t> cells;
    for (std::size_t j = 0; j < sensor.size(); ++j) {
        if (is_grid) {
            cells.push_back(j);
            continue;
        }
        const Vec3 position = position_of(sensor.measurand(j));
        cells.push_back(cell_along(position, raster.edge_v, raster.count[1]) *
                            static_cast<std::size_t>(raster.count[0]) +
                        cell_along(position, raster.edge_u, raster.count[0]));
    }
    return cells;
}

}  // namespace stilb::sensors
