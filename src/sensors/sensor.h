// What is measured: illuminance at points, luminance along lines of sight, pictures.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/vec.h"
#include "sensors/camera.h"

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

/// What one reading is of.
using Measurand = std::variant<MeasuringPoint, LineOfSight, EmergentRay>;

inline const Vec3& position_of(const Measurand& measurand) {
    return std::visit([](const auto& m) -> const Vec3& { return m.position; }, measurand);
}
/// Where a reading is made, and the side that light comes from.
MeasuringPoint place_of(const Measurand& measurand);
inline bool is_luminance(const Measurand& measurand) {
    return !std::holds_alternative<MeasuringPoint>(measurand);
}

/// What a number says, as in "illuminance [lx]".
struct Quantity {
    std::string_view name, unit;
};
inline constexpr Quantity kIlluminance{"illuminance", "lx"}, kLuminance{"luminance", "cd/m2"};

/// A rectangle of cells that are measured at their centres.
struct Grid {
    Vec3 corner, edge_u, edge_v;
    std::array<int, 2> count{1, 1};
};

/// The surface that a point lies on, on the side of its normal.
std::optional<rays::Hit> surface_at(const MeasuringPoint& point, const rays::RayCaster& caster);

/// Where rays from a measuring point start: lifted along its normal, off the surface that it lies on, if any.
Vec3 lifted_position(const MeasuringPoint& point, const rays::RayCaster& caster);

enum class SensorType { illuminance, grid, luminance, goniometer, camera };
inline constexpr std::array<std::string_view, 5> kSensorTypeNames{"illuminance", "grid", "luminance",
                                                                  "goniometer", "camera"};
constexpr std::string_view name_of(SensorType type) {
    return kSensorTypeNames[static_cast<std::size_t>(type)];
}

/// A direction in the frame of a surface: `theta_deg` from its normal, `phi_deg` about it. In a polar plane
/// theta has a sign and phi is the plane's azimuth; otherwise theta is at least 0.
struct PolarAngles {
    double theta_deg = 0, phi_deg = 0;
};

struct Sensor {
    std::string name;
    SensorType type = SensorType::illuminance;
    /// One for each reading, all of one quantity; grids: u fastest. Cameras have none.
    std::vector<Measurand> measurands;
    /// Meaningful for SensorType::grid.
    Grid grid{};
    /// Meaningful for SensorType::camera.
    Camera camera{};
    /// SensorType::goniometer: the direction of each measurand.
    std::vector<PolarAngles> angles{};

    bool measures_luminance() const { return type >= SensorType::luminance; }
    Quantity quantity() const { return measures_luminance() ? kLuminance : kIlluminance; }
};

/// A grid sensor with a point at every cell's centre, all with the unit vector `normal`.
Sensor make_grid_sensor(std::string name, const Grid& grid, const Vec3& normal);

}  // namespace stilb::sensors

namespace stilb {
using sensors::EmergentRay;
using sensors::Grid;
using sensors::LineOfSight;
using sensors::Measurand;
using sensors::MeasuringPoint;
using sensors::PolarAngles;
using sensors::Quantity;
using sensors::Sensor;
using sensors::SensorType;
}  // namespace stilb
