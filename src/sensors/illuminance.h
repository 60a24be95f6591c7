// Illuminance on surface elements: at points, and at the centres of the cells of a grid.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "sensors/fields.h"
#include "sensors/measurand.h"

namespace stilb::sensors {

struct IlluminancePoints {
    std::vector<MeasuringPoint> points;

    static constexpr std::string_view kType = "illuminance";
    static constexpr Quantity kQuantity = kIlluminance;
    static constexpr Noun kReadings = kPoints;
    static constexpr auto fields() {
        return std::tuple{
            MeasuringPointsField{&IlluminancePoints::points, "positions, and the side that receives light"}};
    }

    std::size_t size() const { return points.size(); }
    Measurand measurand(std::size_t j) const { return points[j]; }
};

/// A parallelogram of cells that are measured at their centres, u fastest.
struct Grid {
    Vec3 corner, edge_u, edge_v;
    std::array<int, 2> count{1, 1};
    /// A unit vector for all points; by default that of edge_u x edge_v.
    std::optional<Vec3> normal{};

    static constexpr std::string_view kType = "grid";
    static constexpr Quantity kQuantity = kIlluminance;
    static constexpr Noun kReadings = kPoints;
    static constexpr CountLimit kLimit{"[nu, nv]", kMostReadings, kMostReadings, "points",
                                       "in all sensors together"};
    static constexpr auto fields() {
        return std::tuple{
            ParallelogramField{&Grid::corner, &Grid::edge_u, &Grid::edge_v, "the measured area"},
            CountsField{"count", &Grid::count, kLimit, "cells along edge_u and edge_v"},
            DirectionField{"normal", &Grid::normal,
                           "the side that receives light; by default edge_u x edge_v", Presence::optional}};
    }

    std::size_t size() const {
        return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]);
    }
    Measurand measurand(std::size_t j) const;
};

inline Measurand Grid::measurand(std::size_t j) const {
    const auto [nu, nv] = count;
    const int u = static_cast<int>(j % static_cast<std::size_t>(nu));
    const int v = static_cast<int>(j / static_cast<std::size_t>(nu));
    const Vec3 position = corner + (u + 0.5) / nu * edge_u + (v + 0.5) / nv * edge_v;
    return MeasuringPoint{position, normal ? *normal : normalized(cross(edge_u, edge_v))};
}

}  // namespace stilb::sensors

namespace stilb {
using sensors::Grid;
using sensors::IlluminancePoints;
}  // namespace stilb
