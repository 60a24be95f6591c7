#include "sensors/bodies.h"

#include <cmath>

#include "math/sampling.h"

namespace stilb::sensors {
namespace {

constexpr Vec3 kUp{0, 0, 1};

/// An angle from -pi/2 to pi/2 with density 2 cos^2 / pi: the solution of
/// angle + sin(angle) cos(angle) = pi (u - 1/2).
double sample_squared_cosine(double u) {
    // By the distance e from the nearer end, where e - sin(e) cos(e) = b. The left side is at most 2 e^3 / 3
    // and convex: Newton's method starts below the root, jumps above it once and falls from there on.
    const double b = kPi * (u < 0.5 ? u : 1 - u);
    double e = std::cbrt(1.5 * b);
    constexpr int most = 10;  // five suffice
    for (int i = 0; i < most && e > 0; ++i) {
        const double sine = std::sin(e);
        const double step = (e - sine * std::cos(e) - b) / (2 * sine * sine);
        e -= step;
        if (std::abs(step) <= 1e-15 * e) break;
    }
    return u < 0.5 ? e - kPi / 2 : kPi / 2 - e;
}

/// A direction by its azimuth and its elevation above the horizon.
struct Horizontal {
    double across, along, up;
};
Horizontal by_azimuth(double azimuth_rad, double height_rad) {
    const double level = std::cos(height_rad);
    return {level * std::sin(azimuth_rad), level * std::cos(azimuth_rad), std::sin(height_rad)};
}

double length_of(double x, double y) { return std::sqrt(x * x + y * y); }

/// Directions in a frame whose z axis is the cylinder's.
constexpr Sensitivity kCylinder{[](const Vec3& d) { return length_of(d.x, d.y) / kPi; },
                                [](double u1, double u2) {
                                    const auto [across, along, up] =
                                        by_azimuth(2 * kPi * u2, sample_squared_cosine(u1));
                                    return Vec3{along, across, up};
                                },
                                ""};

/// Directions in the frame of a wall that faces along the direction: y is upwards, z away from it.
constexpr Sensitivity kSemicylinder{[](const Vec3& d) { return (length_of(d.x, d.z) + d.z) / kPi; },
                                    [](double u1, double u2) {
                                        // The azimuth has density (1 + cos(alpha)) / (2 pi) = cos^2(alpha /
                                        // 2) / pi.
                                        const auto [across, along, up] = by_azimuth(
                                            2 * sample_squared_cosine(u2), sample_squared_cosine(u1));
                                        return Vec3{across, up, along};
                                    },
                                    "direction"};

constexpr Sensitivity kHemisphere{[](const Vec3& d) { return (1 + d.z) / 4; },
                                  [](double u1, double u2) {
                                      const double root = std::sqrt(u1), cosine = 2 * root - 1;
                                      const double sine = 2 * std::sqrt(root * (1 - root));
                                      const double phi = 2 * kPi * u2;
                                      return Vec3{sine * std::cos(phi), sine * std::sin(phi), cosine};
                                  },
                                  "normal"};

constexpr Sensitivity kSphere{[](const Vec3&) { return 0.25; },
                              [](double u1, double u2) { return math::sample_sphere(u1, u2).direction; }, ""};

}  // namespace

std::optional<Fault> Semicylindrical::settle(const GivenKeys&) {
    constexpr double steepest = 1e-6;
    if (std::abs(direction.z) > steepest) {
        return Fault{"direction",
                     "is not horizontal, but a semicylinder stands upright. Allowed: [x, y, 0]."};
    }
    direction = normalized({direction.x, direction.y, 0});
    return std::nullopt;
}

Measurand Cylindrical::measurand(std::size_t j) const { return BodyPoint{positions[j], kUp, &kCylinder}; }
Measurand Semicylindrical::measurand(std::size_t j) const {
    return BodyPoint{positions[j], direction, &kSemicylinder};
}
Measurand Hemispherical::measurand(std::size_t j) const {
    return BodyPoint{positions[j], normal, &kHemisphere};
}
Measurand Spherical::measurand(std::size_t j) const { return BodyPoint{positions[j], kUp, &kSphere}; }

}  // namespace stilb::sensors
