// What is measured: illuminance at points, each with a normal.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/vec.h"

namespace stilb {

/// One reading: the illuminance [lx] that arrives at `position` on the side that the unit `normal` points to.
struct MeasuringPoint {
    Vec3 position, normal;
};

/// A rectangle of cells that are measured at their centres.
struct Grid {
    Vec3 corner, edge_u, edge_v;
    std::array<int, 2> count{1, 1};
};

class RayCaster;

/// Where rays from a measuring point start: lifted along its normal, off the surface that it lies on, if any.
Vec3 lifted_position(const MeasuringPoint& point, const RayCaster& caster);

enum class SensorType { illuminance, grid };

struct Sensor {
    std::string name;
    SensorType type = SensorType::illuminance;
    /// Grids: u fastest.
    std::vector<MeasuringPoint> points;
    /// Meaningful for SensorType::grid.
    Grid grid;
};

/// A grid sensor with a point at every cell's centre, all with the unit vector `normal`.
Sensor make_grid_sensor(std::string name, const Grid& grid, const Vec3& normal);

}  // namespace stilb
