// The measurand of one reading: the illuminance of a surface element or a small body, or the luminance along
// a ray.
#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "base/vec.h"

namespace stilb::sensors {

/// The illuminance [lx] that arrives at `position` on the side that the unit `normal` points to.
struct MeasuringPoint {
    Vec3 position, normal;
};

/// The luminance [cd/m2] that arrives at `position` for the unit viewing direction `direction`.
struct LineOfSight {
    Vec3 position, direction;
};

/// The luminance [cd/m2] that leaves the surface at `position`, on the side that the unit `normal` points to,
/// along the unit `direction`, away from the surface.
struct EmergentRay {
    Vec3 position, normal, direction;
};

/// The directional sensitivity of a small body that stands free. Directions are unit vectors
/// towards the incident light, in Frame::of_surface(axis of the body).
///
/// The illuminance is the integral over the sphere of L(w) s(w) dw. It is the mean over the body's surface of
/// illuminances of surface elements, so that the integral of s is pi, as that of cos+ is.
struct Sensitivity {
    double (*of)(const Vec3& direction);   ///< s, at least 0
    Vec3 (*sample)(double u1, double u2);  ///< a direction with density s / pi
    std::string_view axis_name;            ///< of the axis in results; empty where it is the vertical
};

/// The illuminance [lx] on a small body, whose unit `axis` is its axis of symmetry or its facing direction.
struct BodyPoint {
    Vec3 position, axis;
    const Sensitivity* sensitivity;
};

using Measurand = std::variant<MeasuringPoint, BodyPoint, LineOfSight, EmergentRay>;

inline const Vec3& position_of(const Measurand& measurand) {
    return std::visit([](const auto& m) -> const Vec3& { return m.position; }, measurand);
}
bool is_luminance(const Measurand& measurand);
/// The position of a reading, and the side that receives light.
MeasuringPoint viewpoint_of(const Measurand& measurand);

/// The location of a reading in results: the common source of JSON, CSV and text.
struct Location {
    struct Direction {
        std::string_view name;         ///< as a key of JSON and in columns: "normal"
        std::string_view preposition;  ///< in texts: "facing"; empty where texts leave it out
        Vec3 value;
    };
    struct Angle {
        std::string_view name;
        double value_deg = 0;
    };

    std::string_view preposition;  ///< of the position in texts: "at"
    Vec3 position;
    std::vector<Direction> directions{};
    std::vector<Angle> angles{};
};
Location location_of(const Measurand& measurand);

/// The quantity of a number, as in "illuminance [lx]".
struct Quantity {
    std::string_view name, unit;
};
inline constexpr Quantity kIlluminance{"illuminance", "lx"}, kLuminance{"luminance", "cd/m2"};

}  // namespace stilb::sensors

namespace stilb {
using sensors::BodyPoint;
using sensors::EmergentRay;
using sensors::LineOfSight;
using sensors::Location;
using sensors::Measurand;
using sensors::MeasuringPoint;
using sensors::Quantity;
}  // namespace stilb
