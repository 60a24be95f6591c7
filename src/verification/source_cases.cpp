
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "exact/closed_rooms.h"
#include "exact/configuration_factors.h"
#include "io/mesh/mesh_file.h"
#include "materials/black.h"
#include "materials/mirror.h"
#include "materials/thin_dielectric.h"
#include "math/sampling.h"
#include "verification/verification.h"

namespace stilb::verification {

namespace {

constexpr double kSourceLuminance = 1000;

/// Elements around a source at the origin that emits upwards: nearer and farther, facing it and increasingly
/// tilted, until the source is below their horizon.
std::vector<MeasuringPoint> tilted_elements() {
    constexpr std::array<double, 8> tilts_deg{0, 25, 45, 60, 75, 85, 95, 180};
    std::vector<MeasuringPoint> points;
    for (std::size_t i = 0; i < tilts_deg.size(); ++i) {
        const double polar = 1.2 * std::fmod(0.618 * static_cast<double>(i), 1.0);
        const double azimuth = static_cast<double>(i) * math::kGoldenAngle;
        const Vec3 direction{std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                             std::cos(polar)};
        const double tilt = tilts_deg[i] * kPi / 180;
        const Vec3 sideways = normalized(cross(direction, {0.3, -0.5, 0.8}));
        points.push_back({(0.6 + 0.2 * static_cast<double>(i)) * direction,
                          std::cos(tilt) * -direction + std::sin(tilt) * sideways});
    }
    return points;
}

template <typename ExactIlluminance>
VerificationCase source_case(const std::string& name, Scene scene, ExactIlluminance illuminance_lx) {
    VerificationCase result{name, "tilted elements", std::move(scene), {}};
    for (const MeasuringPoint& point : tilted_elements()) {
        result.readings.push_back({point, illuminance_lx(exact::Receiver{point.position, point.normal})});
    }
    return result;
}

Scene scene_with_light(const Shape& shape) {
    Scene scene;
    add_area_light(scene, add_object(scene, shape, Black{}), kSourceLuminance);
    return scene;
}

VerificationCase point_source_case() {
    Scene scene;
    scene.lights.push_back({"source", PointLight{{}, Rgb::grey(100)}});
    return source_case("point source", std::move(scene), [](const exact::Receiver& receiver) {
        return exact::illuminance_by_point_lx(receiver, {}, 100);
    });
}

VerificationCase rectangle_source_case() {
    const Rectangle r{{-0.5, -0.3, 0}, {1, 0, 0}, {0.2, 0.6, 0}};
    return source_case("rectangle", scene_with_light(r), [r](const exact::Receiver& receiver) {
        return exact::illuminance_by_rectangle_lx(receiver, r.corner, r.edge_u, r.edge_v, kSourceLuminance);
    });
}

VerificationCase disk_source_case() {
    const Disk d{{}, {0, 0, 1}, 0.4};
    return source_case("disk", scene_with_light(d), [d](const exact::Receiver& receiver) {
        return exact::illuminance_by_disk_lx(receiver, {d.center, d.normal, d.radius}, kSourceLuminance);
    });
}

VerificationCase sphere_source_case() {
    const Sphere s{{}, 0.3};
    return source_case("luminous sphere", scene_with_light(s), [s](const exact::Receiver& receiver) {
        return exact::illuminance_by_sphere_lx(receiver, s.center, s.radius, kSourceLuminance);
    });
}

}  // namespace

std::vector<VerificationCase> source_cases() {
    return {point_source_case(), rectangle_source_case(), disk_source_case(), sphere_source_case()};
}

namespace {

constexpr double kSourceLuminance_cd_m2 = 1000;
constexpr double kReflectance = 0.85;
constexpr exact::PaneOptics kPane{1.52, 0.96};

/// The target of all luminance sensors: every source has its front there, facing upwards.
constexpr Vec3 kTarget{0.05, 0.03, 0};

enum class Back { dark, bright };

/// Unit, `polar_deg` from the vertical.
Vec3 direction_at(double polar_deg, double azimuth_deg) {
    constexpr double degree = std::numbers::pi / 180;
    const double sine = std::sin(polar_deg * degree);
    return {sine * std::cos(azimuth_deg * degree), sine * std::sin(azimuth_deg * degree),
            std::cos(polar_deg * degree)};
}

LineOfSight towards(const Vec3& target, const Vec3& from_there, double distance_m) {
    return {target + distance_m * from_there, -from_there};
}

void add_straight(VerificationCase& result, Back back) {
    for (const double azimuth_deg : {10.0, 130.0, 250.0}) {
        result.readings.push_back(
            {towards(kTarget, direction_at(50, azimuth_deg), 2), kSourceLuminance_cd_m2});
    }
    result.readings.push_back(
        {towards(kTarget, {0, 0, -1}, 2), back == Back::bright ? kSourceLuminance_cd_m2 : 0});
}

/// A small mirror between source and sensor, and a luminance sensor that sees it.
void add_in_mirror(VerificationCase& result) {
    const Vec3 to_mirror = direction_at(40, 0), to_meter = direction_at(80, 90);
    const Vec3 middle = kTarget + to_mirror;
    add_object(result.scene, Disk{middle, normalized(to_meter - to_mirror), 0.05},
               Mirror{Rgb::grey(kReflectance)});
    result.readings.push_back({towards(middle, to_meter, 0.7), kReflectance * kSourceLuminance_cd_m2});
}

void add_through_pane(VerificationCase& result, double azimuth_deg, double angle_deg) {
    const Vec3 to_meter = direction_at(35, azimuth_deg);
    const Vec3 across = normalized(cross(to_meter, {0, 0, 1}));
    const double angle_rad = angle_deg * std::numbers::pi / 180;
    const Vec3 normal = std::cos(angle_rad) * to_meter + std::sin(angle_rad) * across;
    add_object(result.scene, Disk{kTarget + 0.8 * to_meter, normal, 0.1},
               ThinDielectric{kPane.ior, Rgb::grey(kPane.internal_transmittance)});
    result.readings.push_back({towards(kTarget, to_meter, 1.5),
                               exact::pane_transmittance(kPane, angle_rad) * kSourceLuminance_cd_m2});
}

VerificationCase seen_source_case(const std::string& shape_name, const Shape& shape, Back back) {
    VerificationCase result{"seen source", shape_name, {}, {}};
    result.note = fmt::format(
        "Seen directly, from behind, in a mirror of {}, and through a pane (ior {}, internal\n"
        "  transmittance {}) at 0 and 60 degrees.",
        kReflectance, kPane.ior, kPane.internal_transmittance);
    add_area_light(result.scene, add_object(result.scene, shape, Black{}), kSourceLuminance_cd_m2);
    add_straight(result, back);
    add_in_mirror(result);
    add_through_pane(result, 180, 0);
    add_through_pane(result, 270, 60);
    return result;
}

/// A flat roof of four triangles.
Mesh roof() {
    return {{{-0.3, -0.3, -0.1}, {0.3, -0.3, -0.1}, {0.3, 0.3, -0.1}, {-0.3, 0.3, -0.1}, {0, 0, 0}},
            {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
}

Mesh l_shaped_polygon() {
    const std::vector<Vec3> corners{{-0.1, -0.1, 0}, {0.4, -0.1, 0}, {0.4, 0.1, 0},
                                    {0.1, 0.1, 0},   {0.1, 0.4, 0},  {-0.1, 0.4, 0}};
    return {corners, io::triangulate_polygon(corners)};
}

}  // namespace

std::vector<VerificationCase> seen_source_cases() {
    return {
        seen_source_case("rectangle", Rectangle{{-0.5, -0.3, 0}, {1, 0, 0}, {0.2, 0.6, 0}}, Back::dark),
        seen_source_case("disk", Disk{{}, {0, 0, 1}, 0.4}, Back::dark),
        seen_source_case("polygon", l_shaped_polygon(), Back::dark),
        seen_source_case("mesh", roof(), Back::dark),
        seen_source_case("box", Box{{-0.3, -0.2, -0.1}, {0.3, 0.2, 0}}, Back::bright),
        seen_source_case("sphere", Sphere{{0, 0, -0.3}, 0.3}, Back::bright),
    };
}

}  // namespace stilb::verification
