#include "sensors/illuminance.h"

namespace stilb::sensors {

Measurand Grid::measurand(std::size_t j) const {
    const auto [nu, nv] = count;
    const int u = static_cast<int>(j % static_cast<std::size_t>(nu));
    const int v = static_cast<int>(j / static_cast<std::size_t>(nu));
    const Vec3 position = corner + (u + 0.5) / nu * edge_u + (v + 0.5) / nv * edge_v;
    return MeasuringPoint{position, normal ? *normal : normalized(cross(edge_u, edge_v))};
}

}  // namespace stilb::sensors
