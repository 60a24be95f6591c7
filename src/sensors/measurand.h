// What one reading is of: the illuminance of a surface element, or the luminance along a ray.
#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "base/vec.h"

namespace stilb::rays {
class RayCaster;
struct Hit;
}  // namespace stilb::rays

namespace stilb::sensors {

/// The illuminance [lx] that arrives at `position` on the side that the unit `normal` points to.
struct MeasuringPoint {
    Vec3 position, normal;
};

/// The luminance [cd/m2] that arrives at `position` when one looks along the unit `direction`.
struct LineOfSight {
    Vec3 position, direction;
};

/// The luminance [cd/m2] that leaves the surface at `position`, on the side that the unit `normal` points to,
/// along the unit `direction`, away from the surface.
struct EmergentRay {
    Vec3 position, normal, direction;
};

using Measurand = std::variant<MeasuringPoint, LineOfSight, EmergentRay>;

inline const Vec3& position_of(const Measurand& measurand) {
    return std::visit([](const auto& m) -> const Vec3& { return m.position; }, measurand);
}
bool is_luminance(const Measurand& measurand);
/// Where a reading is made, and the side that light comes from.
MeasuringPoint viewpoint_of(const Measurand& measurand);

/// A reading's place as results show it: JSON, CSV and text are all made of this.
struct Place {
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
Place place_of(const Measurand& measurand);

/// What a number says, as in "illuminance [lx]".
struct Quantity {
    std::string_view name, unit;
};
inline constexpr Quantity kIlluminance{"illuminance", "lx"}, kLuminance{"luminance", "cd/m2"};

/// The surface that a point lies on, on the side of its normal.
std::optional<rays::Hit> surface_at(const MeasuringPoint& point, const rays::RayCaster& caster);

/// Where rays from a measuring point start: lifted along its normal, off the surface that it lies on, if any.
Vec3 lifted_position(const MeasuringPoint& point, const rays::RayCaster& caster);

}  // namespace stilb::sensors

namespace stilb {
using sensors::EmergentRay;
using sensors::LineOfSight;
using sensors::Measurand;
using sensors::MeasuringPoint;
using sensors::Place;
using sensors::Quantity;
}  // namespace stilb
