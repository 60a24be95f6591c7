#include "papers/head_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace stilb::papers {
namespace {

constexpr int kMeridians = 154, kSteps = 107;  // steps from pole to pole
constexpr double kNeck_m = 0.165;              // the cut, below the origin

/// Seen from the origin, which is inside.
struct Ellipsoid {
    Vec3 center, semi_axes;

    double radius(const Vec3& direction) const {
        const Vec3 d = scaled(direction), c = scaled(center);
        const double a = dot(d, d), b = dot(d, c);
        return (b + std::sqrt(b * b + a * (1 - dot(c, c)))) / a;
    }

  private:
    Vec3 scaled(const Vec3& v) const { return {v.x / semi_axes.x, v.y / semi_axes.y, v.z / semi_axes.z}; }
};

// [m]
constexpr std::array kBulks{Ellipsoid{{0, 0.020, -0.014}, {0.075, 0.088, 0.098}},    // skull
                            Ellipsoid{{0, -0.042, 0.030}, {0.058, 0.078, 0.060}},    // face and jaw
                            Ellipsoid{{0, -0.120, -0.028}, {0.047, 0.170, 0.050}}};  // neck

/// Multiplies the radius by exp(height exp(-q^sharpness)), q = (a / width_a)^2 + (b / width_b)^2: a and b
/// are degrees from its middle, to the side and upwards, turned by `tilt_deg` from there. Above sharpness 1
/// its top is flat and its sides are steep.
struct Bump {
    double azimuth_deg, elevation_deg;  ///< of its middle; azimuth 0 is the face, elevation 0 the eyes
    double height;                      ///< below 0 for a hollow
    double width_a_deg, width_b_deg;
    double tilt_deg = 0;
    double sharpness = 1;
};

constexpr std::array kMiddle{Bump{0, 9, 0.015, 16, 6},               // between the brows
                             Bump{0, 1, -0.030, 6, 5},               // root of the nose
                             Bump{0, -8, 0.085, 4.0, 8},             // its bridge
                             Bump{0, -17.5, 0.150, 5.5, 6, 0, 1.5},  // its tip
                             Bump{0, -36, 0.040, 13, 9},             // mouth
                             Bump{0, -29.5, -0.020, 2.2, 4},         // groove above the lips
                             Bump{0, -33.6, 0.030, 8, 2.2},          // upper lip
                             Bump{0, -36, -0.050, 9, 1.2},           // between the lips
                             Bump{0, -38.6, 0.030, 7, 2.4},          // lower lip
                             Bump{0, -43.5, -0.035, 11, 3},          // above the chin
                             Bump{0, -50, 0.100, 12, 6}};            // chin

// Of the left side; the right side has them too.
constexpr std::array kSides{Bump{21, 9.5, 0.040, 13, 4.0, -6},          // brow
                            Bump{19, 0, -0.115, 11, 6.5, -4},           // eye socket
                            Bump{19.5, -0.5, 0.085, 6.5, 4.6, 0, 1.3},  // eyeball
                            Bump{19.5, 3.2, 0.022, 8, 1.3, -4},         // upper eyelid
                            Bump{19.5, -4.4, 0.018, 8, 1.2, 6},         // lower eyelid
                            Bump{7.2, -20.0, 0.070, 3.4, 3.4},          // wing of the nose
                            Bump{38, -15, 0.040, 13, 8, 15},            // cheekbone
                            Bump{33, -34, -0.030, 11, 10},              // cheek
                            Bump{14, -36, -0.020, 3, 3},                // corner of the mouth
                            Bump{60, -41, 0.035, 14, 9},                // angle of the jaw
                            Bump{52, 12, -0.025, 12, 12},               // temple
                            Bump{98, -12, 0.180, 6.5, 16, 12, 2},       // ear
                            Bump{94, -11, -0.120, 4, 9, 12}};           // its hollow

double degrees(double radians) { return radians * 180 / std::numbers::pi; }
double radians(double degrees) { return degrees * std::numbers::pi / 180; }

Vec3 direction_of(double azimuth_rad, double elevation_rad) {
    return {std::sin(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad),
            std::cos(azimuth_rad) * std::cos(elevation_rad)};
}

/// What a bump adds to the radius's logarithm.
double height_at(const Bump& bump, const Vec3& direction) {
    const double azimuth = radians(bump.azimuth_deg), elevation = radians(bump.elevation_deg);
    const Vec3 middle = direction_of(azimuth, elevation);
    if (dot(middle, direction) <= 0) return 0;
    const Vec3 aside{std::cos(azimuth), 0, -std::sin(azimuth)}, up = cross(middle, aside);
    const double tilt = radians(bump.tilt_deg);
    const double x = degrees(dot(direction, aside)), y = degrees(dot(direction, up));
    const double a = (std::cos(tilt) * x + std::sin(tilt) * y) / bump.width_a_deg;
    const double b = (std::cos(tilt) * y - std::sin(tilt) * x) / bump.width_b_deg;
    return bump.height * std::exp(-std::pow(a * a + b * b, bump.sharpness));
}

/// The largest of the bulks, with smooth seams; cut below, likewise.
double bulk_radius(const Vec3& direction) {
    constexpr double seam = 14, edge = 12;
    double sum = 0;
    for (const Ellipsoid& bulk : kBulks) sum += std::pow(bulk.radius(direction), seam);
    const double radius = std::pow(sum, 1 / seam);
    const double below = std::max(0.0, -direction.y) * radius / kNeck_m;
    return radius * std::pow(1 + std::pow(below, edge), -1 / edge);
}

}  // namespace

double head_radius(const Vec3& direction) {
    const Vec3 mirrored{-direction.x, direction.y, direction.z};
    double height = 0;
    for (const Bump& bump : kMiddle) height += height_at(bump, direction);
    for (const Bump& bump : kSides) height += height_at(bump, direction) + height_at(bump, mirrored);
    return bulk_radius(direction) * std::exp(height);
}

Mesh head_mesh() {
    Mesh mesh;
    const auto add_vertex = [&](int step, int meridian) {
        const Vec3 direction = direction_of(2 * std::numbers::pi * meridian / kMeridians,
                                            std::numbers::pi * (0.5 - static_cast<double>(step) / kSteps));
        mesh.vertices.push_back(head_radius(direction) * direction);
    };
    add_vertex(0, 0);
    for (int step = 1; step < kSteps; ++step) {
        for (int meridian = 0; meridian < kMeridians; ++meridian) add_vertex(step, meridian);
    }
    add_vertex(kSteps, 0);

    const auto number = [](int step, int meridian) {
        if (step == 0) return std::uint32_t{0};
        if (step == kSteps) return static_cast<std::uint32_t>(1 + (kSteps - 1) * kMeridians);
        return static_cast<std::uint32_t>(1 + (step - 1) * kMeridians + meridian % kMeridians);
    };
    for (int step = 0; step < kSteps; ++step) {
        for (int meridian = 0; meridian < kMeridians; ++meridian) {
            const std::uint32_t above = number(step, meridian), next_above = number(step, meridian + 1);
            const std::uint32_t below = number(step + 1, meridian),
                                next_below = number(step + 1, meridian + 1);
            if (step + 1 < kSteps) mesh.triangles.push_back({above, below, next_below});
            if (step > 0) mesh.triangles.push_back({above, next_below, next_above});
        }
    }
    return mesh;
}

}  // namespace stilb::papers
