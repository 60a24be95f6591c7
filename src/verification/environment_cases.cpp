#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "exact/configuration_factors.h"
#include "materials/black.h"
#include "materials/dielectric.h"
#include "materials/mirror.h"
#include "materials/plastic.h"
#include "materials/rough_conductor.h"
#include "math/sampling.h"
#include "verification/verification.h"

namespace stilb::verification {
namespace {

constexpr double kSkyLuminance_cd_m2 = 1000;
constexpr const char* kNote =
    "Constant luminance from all directions, minus the part that black objects hide by their configuration "
    "factors; convex "
    "objects\n"
    "  alone in it, which reflect rho L; and a panorama of two half spaces, whose illuminance is linear in "
    "the cosine.";

/// Elements near the origin, where black objects stand, facing them and increasingly tilted.
std::vector<exact::Receiver> elements() {
    std::vector<exact::Receiver> all;
    int i = 0;
    for (const double tilt_deg : {0.0, 40.0, 70.0, 100.0, 180.0}) {
        const double azimuth = i * math::kGoldenAngle, tilt = tilt_deg * kPi / 180;
        const Vec3 away = normalized(Vec3{0.5 * std::cos(azimuth), 0.5 * std::sin(azimuth), 1});
        const Vec3 sideways = normalized(cross(away, {0.3, -0.5, 0.8}));
        all.push_back({(0.7 + 0.1 * i) * away, std::cos(tilt) * -away + std::sin(tilt) * sideways});
        ++i;
    }
    return all;
}

template <typename HiddenIlluminance>
VerificationCase hidden_case(const std::string& variant, const Shape& shape, HiddenIlluminance hidden_lx) {
    VerificationCase result{"environment", variant, {}, {}};
    result.note = kNote;
    add_object(result.scene, shape, Black{});
    add_environment(result.scene, kSkyLuminance_cd_m2);
    for (const exact::Receiver& element : elements()) {
        result.readings.push_back({MeasuringPoint{element.position, element.normal},
                                   kPi * kSkyLuminance_cd_m2 - hidden_lx(element)});
    }
    return result;
}

VerificationCase behind_sphere() {
    const Sphere s{{}, 0.3};
    return hidden_case("behind a sphere", s, [s](const exact::Receiver& element) {
        return exact::illuminance_by_sphere_lx(element, s.center, s.radius, kSkyLuminance_cd_m2);
    });
}

VerificationCase behind_rectangle() {
    const Rectangle r{{-0.5, -0.3, 0}, {1, 0, 0}, {0.2, 0.6, 0}};
    return hidden_case("behind a rectangle", r, [r](const exact::Receiver& element) {
        return exact::illuminance_by_rectangle_lx(element, r.corner, r.edge_u, r.edge_v, kSkyLuminance_cd_m2);
    });
}

/// A black room of 4 m x 3 m x 2.5 m whose ceiling has a hole of 1 m x 0.6 m.
VerificationCase under_a_hole() {
    VerificationCase result{"environment", "under a hole", {}, {}};
    result.note = kNote;
    const auto add_ceiling = [&](double x, double y, double width, double depth) {
        add_object(result.scene, Rectangle{{x, y, 2.5}, {0, depth, 0}, {width, 0, 0}}, Black{});
    };
    Mesh walls = triangulated(Box{{0, 0, 0}, {4, 3, 2.5}});
    std::erase_if(walls.triangles, [&](const Triangle& t) {
        return walls.vertices[t[0]].z > 0 && walls.vertices[t[1]].z > 0 && walls.vertices[t[2]].z > 0;
    });
    add_object(result.scene, walls, Black{});
    add_ceiling(0, 0, 1.2, 3), add_ceiling(2.2, 0, 1.8, 3), add_ceiling(1.2, 0, 1, 1.1);
    add_ceiling(1.2, 1.7, 1, 1.3);
    add_environment(result.scene, kSkyLuminance_cd_m2);
    const std::array<exact::Receiver, 5> points{{{{1.7, 1.4, 0}, {0, 0, 1}},
                                                 {{0.4, 2.6, 0.8}, {0, 0, 1}},
                                                 {{3, 1, 1.5}, normalized(Vec3{-1, 0.3, 0.2})},
                                                 {{1.5, 1.2, 2.3}, normalized(Vec3{1, 0, 0.3})},
                                                 {{2, 2, 1}, {0, 0, -1}}}};
    for (const exact::Receiver& point : points) {
        const double exact_lx = exact::illuminance_by_rectangle_lx(point, {1.2, 1.1, 2.5}, {0, 0.6, 0},
                                                                   {1, 0, 0}, kSkyLuminance_cd_m2);
        result.readings.push_back({MeasuringPoint{point.position, point.normal}, exact_lx});
    }
    return result;
}

/// Rays leaving a convex object of this material, and lines of sight past it.
VerificationCase seen_case(const std::string& variant, const Shape& shape, const Material& material,
                           double luminance_cd_m2, double tolerance) {
    VerificationCase result{"environment", variant + ", luminance", {}, {}};
    result.note = kNote;
    add_object(result.scene, shape, material);
    add_environment(result.scene, kSkyLuminance_cd_m2);
    for (const Vec3& direction : spread_directions(6)) {
        const Vec3 position = 2 * direction, target = 0.15 * Vec3{direction.y, direction.z, direction.x};
        result.readings.push_back(
            {LineOfSight{position, normalized(target - position)}, luminance_cd_m2, tolerance});
    }
    result.readings.push_back({LineOfSight{{2, 0, 0}, normalized(Vec3{0.4, 1, 0.2})}, kSkyLuminance_cd_m2});
    return result;
}

/// Camera paths in glass end with a probability of one in 200 per surface, while each
/// carries less than 0.005 of the luminance. A few hundred such paths may all survive or not, and then
/// there is no other noise.
constexpr double kRareEnds = 1e-4;

std::vector<VerificationCase> seen_cases() {
    const Sphere ball{{}, 0.5};
    const Rgb white = Rgb::grey(1);
    return {
        seen_case("diffuse ball", ball, diffuse(0.6), 0.6 * kSkyLuminance_cd_m2, 0),
        seen_case("mirror ball", ball, Mirror{Rgb::grey(0.85)}, 0.85 * kSkyLuminance_cd_m2, 0),
        seen_case("glass ball", ball, Dielectric{1.5}, kSkyLuminance_cd_m2, kRareEnds),
        seen_case("glass box", Box{{-0.4, -0.3, -0.5}, {0.4, 0.3, 0.5}}, Dielectric{1.5}, kSkyLuminance_cd_m2,
                  kRareEnds),
        seen_case("white rough ball", ball, RoughConductor({white, 0.3}), kSkyLuminance_cd_m2, 0.003),
        seen_case("white plastic ball", ball, Plastic({white, 1.5, 0.2}), kSkyLuminance_cd_m2, 0.001),
    };
}

constexpr double kAbove = 1500, kBelow = 200;

/// The illuminance of an unshaded plane by a panorama with `kAbove` around its top and `kBelow` around its
/// bottom.
double half_spaces_lx(const Vec3& normal, const Vec3& top) {
    return kPi / 2 * (kAbove + kBelow + (kAbove - kBelow) * dot(normal, top));
}

Scene half_spaces(const Vec3& top) {
    Panorama::Image image{16, 8, {}};
    image.rgb_cd_m2.assign(64, {float{kAbove}, float{kAbove}, float{kAbove}});
    image.rgb_cd_m2.insert(image.rgb_cd_m2.end(), 64, {float{kBelow}, float{kBelow}, float{kBelow}});
    Scene scene;
    EnvironmentLight light;
    light.panorama = std::make_shared<const Panorama>(std::move(image));
    light.axes = lights::panorama_axes(top, 30);
    scene.lights.push_back({"environment", light});
    return scene;
}

std::vector<VerificationCase> panorama_cases() {
    const Vec3 top = normalized(Vec3{0.3, -0.4, 0.6});
    const Sphere ball{{}, 0.5};
    constexpr double reflectance = 0.6;
    VerificationCase points{"environment", "half spaces", half_spaces(top), {}},
        seen{"environment", "half spaces, luminance", half_spaces(top), {}};
    points.note = seen.note = kNote;
    for (VerificationCase* result : {&points, &seen}) add_object(result->scene, ball, diffuse(reflectance));
    for (const Vec3& direction : spread_directions(6)) {
        points.readings.push_back(
            {MeasuringPoint{0.5 * direction, direction}, half_spaces_lx(direction, top)});
        seen.readings.push_back(
            {EmergentRay{0.5 * direction, direction, normalized(direction + Vec3{0.2, 0.1, -0.3})},
             reflectance / kPi * half_spaces_lx(direction, top)});
    }
    seen.readings.push_back({LineOfSight{{2, 0, 0}, normalized(Vec3{1, -0.4, 0.9})}, kAbove});
    seen.readings.push_back({LineOfSight{{2, 0, 0}, normalized(Vec3{1, 0.4, -0.5})}, kBelow});
    return {points, seen};
}

}  // namespace

std::vector<VerificationCase> environment_cases() {
    std::vector<VerificationCase> cases{behind_sphere(), behind_rectangle(), under_a_hole()};
    for (VerificationCase& c : seen_cases()) cases.push_back(std::move(c));
    for (VerificationCase& c : panorama_cases()) cases.push_back(std::move(c));
    return cases;
}

}  // namespace stilb::verification
