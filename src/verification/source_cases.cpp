#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "exact/configuration_factors.h"
#include "verification/case_families.h"
#include "verification/case_scenes.h"

namespace stilb::verification {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSourceLuminance = 1000;

/// Elements around a source at the origin that shines upwards: nearer and farther, facing it and more and
/// more turned away, until all of it is below their horizon.
std::vector<MeasuringPoint> tilted_elements() {
    constexpr std::array<double, 8> tilts_deg{0, 25, 45, 60, 75, 85, 95, 180};
    std::vector<MeasuringPoint> points;
    for (std::size_t i = 0; i < tilts_deg.size(); ++i) {
        const double polar = 1.2 * std::fmod(0.618 * static_cast<double>(i), 1.0);
        const double azimuth = static_cast<double>(i) * kGoldenAngle;
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

}  // namespace stilb::verification
