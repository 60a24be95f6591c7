// Goniometers: the luminance that leaves one point of a surface, over directions.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/vec.h"
#include "sensors/sensor.h"

namespace stilb::sensors {

/// Directions at equal steps that all leave the surface: theta = 0, step, 2 step ... below 90 degrees.
///
/// With a plane, they are those of the half planes at azimuth `plane_deg` (theta > 0) and opposite to it
/// (theta < 0), from -90 to 90 degrees; without, those of the hemisphere, phi = 0, step, 2 step ... below 360
/// degrees, with theta = 0 once. Azimuth 0 points to +x for a normal of +z, and azimuth 90 to +y; other
/// normals are reached by the shortest turn from there, which for -z is a half turn about the x axis.
struct Goniometer {
    Vec3 point, normal{0, 0, 1};  ///< a unit vector
    std::optional<double> plane_deg;
    double step_deg = 5;  ///< above 0, at most 90
};

/// How many directions it has.
std::int64_t direction_count(const Goniometer& goniometer);

/// A sensor with an EmergentRay and its angles for each direction; theta rises, and for each theta phi.
Sensor make_goniometer_sensor(std::string name, const Goniometer& goniometer);

}  // namespace stilb::sensors

namespace stilb {
using sensors::Goniometer;
}  // namespace stilb
