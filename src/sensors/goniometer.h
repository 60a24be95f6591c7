// Goniometers: the luminance that leaves one point of a surface, over directions.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <tuple>

#include "sensors/fields.h"
#include "sensors/measurand.h"

namespace stilb::sensors {

/// A direction in the frame of a surface: `theta_deg` from its normal, `phi_deg` about it. In a polar plane
/// theta has a sign and phi is the plane's azimuth; otherwise theta is at least 0.
struct PolarAngles {
    double theta_deg = 0, phi_deg = 0;
};

/// Directions at equal steps that all leave the surface: theta = 0, step, 2 step ... below 90 degrees.
///
/// With a plane, they are those of the half planes at azimuth `plane_deg` (theta > 0) and opposite to it
/// (theta < 0), from -90 to 90 degrees; without, those of the hemisphere, phi = 0, step, 2 step ... below 360
/// degrees, with theta = 0 once. Azimuth 0 points to +x for a normal of +z, and azimuth 90 to +y; other
/// normals are reached by the shortest rotation from there, which for -z is a half turn about the x axis.
struct Goniometer {
    Vec3 point, normal{0, 0, 1};  ///< a unit vector
    std::optional<double> plane_deg;
    double step_deg = 5;  ///< above 0, at most 90

    static constexpr std::string_view kType = "goniometer";
    static constexpr Quantity kQuantity = kLuminance;
    static constexpr Noun kReadings{"direction", "directions"};
    static constexpr auto fields() {
        return std::tuple{
            PositionField{"point", &Goniometer::point, "of a surface"},
            DirectionField{"normal", &Goniometer::normal, "away from the surface"},
            Field{"plane", &Goniometer::plane_deg, kAngle,
                  "azimuth of one plane [degrees]; by default the whole hemisphere", Presence::optional},
            Field{"step", &Goniometer::step_deg,
                  Range{0.001, 90, "an angle above 0 (from 0.001 to 90 degrees)"},
                  "between directions [degrees]"}};
    }
    std::optional<Fault> settle(const GivenKeys& given) const;

    /// theta rises, and for each theta phi.
    PolarAngles angles(std::size_t j) const;
    std::size_t size() const { return static_cast<std::size_t>(direction_count()); }
    Measurand measurand(std::size_t j) const;
    /// The location of a reading with the angles of its direction.
    Location location(std::size_t j) const;
    /// The common part of the locations of all readings.
    Location common_location() const { return {"from", point, {{"normal", "facing", normal}}}; }

  private:
    /// The number of directions; more than memory holds where the step is small.
    std::int64_t direction_count() const;
};

}  // namespace stilb::sensors

namespace stilb {
using sensors::Goniometer;
using sensors::PolarAngles;
}  // namespace stilb
