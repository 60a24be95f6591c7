// Illuminance on small bodies that stand free: the mean over the surface of an upright cylinder, an upright
// semicylinder, a hemisphere and a sphere (docs/sensors.md has the derivations).
#pragma once

#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "sensors/fields.h"
#include "sensors/measurand.h"

namespace stilb::sensors {

/// Vertical: the mean of the vertical illuminances over all azimuths, s = sin(theta) / pi with theta from the
/// vertical.
struct Cylindrical {
    std::vector<Vec3> positions;

    static constexpr std::string_view kType = "cylindrical";
    static constexpr Quantity kQuantity{"cylindrical illuminance", "lx"};
    static constexpr Noun kReadings = kPoints;
    static constexpr auto fields() {
        return std::tuple{PositionsField{&Cylindrical::positions, "middle of the cylinder"}};
    }

    std::size_t size() const { return positions.size(); }
    Measurand measurand(std::size_t j) const;
};

/// Vertical: the mean of the vertical illuminances within 90 degrees of a horizontal direction,
/// s = (1 + cos(alpha)) sin(theta) / pi with alpha the azimuth from there.
struct Semicylindrical {
    std::vector<Vec3> positions;
    Vec3 direction{1, 0, 0};  ///< unit, horizontal

    static constexpr std::string_view kType = "semicylindrical";
    static constexpr Quantity kQuantity{"semicylindrical illuminance", "lx"};
    static constexpr Noun kReadings = kPoints;
    static constexpr auto fields() {
        return std::tuple{
            PositionsField{&Semicylindrical::positions, "middle of the semicylinder's flat side"},
            DirectionField{"direction", &Semicylindrical::direction,
                           "horizontal: direction of the curved side"}};
    }
    std::optional<Fault> settle(const GivenKeys& given);

    std::size_t size() const { return positions.size(); }
    Measurand measurand(std::size_t j) const;
};

/// On the curved side, about a normal: s = (1 + cos(theta)) / 4 with theta from the normal.
struct Hemispherical {
    std::vector<Vec3> positions;
    Vec3 normal{0, 0, 1};  ///< unit

    static constexpr std::string_view kType = "hemispherical";
    static constexpr Quantity kQuantity{"hemispherical illuminance", "lx"};
    static constexpr Noun kReadings = kPoints;
    static constexpr auto fields() {
        return std::tuple{PositionsField{&Hemispherical::positions, "middle of the hemisphere's flat side"},
                          DirectionField{"normal", &Hemispherical::normal, "direction of the curved side"}};
    }

    std::size_t size() const { return positions.size(); }
    Measurand measurand(std::size_t j) const;
};

/// Scalar illuminance: s = 1 / 4.
struct Spherical {
    std::vector<Vec3> positions;

    static constexpr std::string_view kType = "spherical";
    static constexpr Quantity kQuantity{"spherical illuminance", "lx"};
    static constexpr Noun kReadings = kPoints;
    static constexpr auto fields() {
        return std::tuple{PositionsField{&Spherical::positions, "middle of the sphere"}};
    }

    std::size_t size() const { return positions.size(); }
    Measurand measurand(std::size_t j) const;
};

}  // namespace stilb::sensors

namespace stilb {
using sensors::Cylindrical;
using sensors::Hemispherical;
using sensors::Semicylindrical;
using sensors::Spherical;
}  // namespace stilb
