// Illuminances that are measured on the raster of a plane: grids and areas.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "plot/axis.h"
#include "plot/false_colour.h"
#include "run/result.h"

namespace stilb::report {

/// A raster as one looks at it: horizontal planes as on a plan, x to the right and y upwards, other planes
/// from the side that they measure. Of the raster's axes, the one nearest to that runs to the right.
struct MeasuredPlane {
    const SensorResult* result = nullptr;
    Vec3 corner, right, up;          ///< of the whole raster: its lower left corner and its edges [m]
    plot::FalseColourPanel panel{};  ///< NaN where there is no reading

    /// The point at so many columns from the left and rows from the bottom.
    Vec3 at(double column, double row) const;
    bool is_horizontal() const;
    /// Not a band around an area.
    bool is_whole() const;
    /// The coordinates along `right` and `up` from the corner [m].
    std::array<double, 2> to_plane(const Vec3& position) const;
};

/// The sensors with a raster, in order. Keeps references to the results.
std::vector<MeasuredPlane> measured_planes(std::span<const SensorResult> results);

/// The common scale of illuminance: round numbers about all values.
plot::Scale common_scale(std::span<const MeasuredPlane> planes);
/// Its labelled values, on which isolux lines lie.
std::vector<plot::Tick> scale_ticks(const plot::Scale& scale);

/// The outline and the holes of what is measured; those of the inner area for a band.
std::vector<std::vector<Vec3>> outlines_of(const Sensor& sensor);

}  // namespace stilb::report
