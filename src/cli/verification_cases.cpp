#include "cli/verification_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "cli/sobolev_scene.h"
#include "exact/configuration_factors.h"
#include "exact/furnace.h"
#include "exact/photometric_sphere.h"
#include "exact/two_surfaces.h"

namespace stilb {
namespace {

constexpr double kPi = std::numbers::pi;
const double kGoldenAngle = kPi * (3 - std::sqrt(5.0));

MaterialId add_material(Scene& scene, const Material& material) {
    const auto number = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back({fmt::format("material {}", number + 1), material});
    return MaterialId{number};
}

ObjectId add_object(Scene& scene, const Shape& shape, const Material& material) {
    const auto number = static_cast<std::uint32_t>(scene.objects.size());
    scene.objects.push_back({fmt::format("object {}", number + 1), shape, {add_material(scene, material)}});
    return ObjectId{number};
}

void add_area_light(Scene& scene, ObjectId object, double luminance_cd_m2) {
    scene.lights.push_back({"light", AreaLight{object, Spectrum::grey(luminance_cd_m2)}});
}

Diffuse diffuse(double reflectance) { return {Spectrum::grey(reflectance)}; }

/// `count` unit vectors spread evenly over the sphere: a Fibonacci spiral.
std::vector<Vec3> spread_directions(int count) {
    std::vector<Vec3> directions;
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2 * i + 1.0) / count;
        const double radius = std::sqrt(1 - z * z);
        directions.push_back({radius * std::cos(i * kGoldenAngle), radius * std::sin(i * kGoldenAngle), z});
    }
    return directions;
}

// Sobolev's problem

constexpr double kLargestRadius = 5;
/// Beyond it light is so rare that methods which trace paths from every point take many times as long.
constexpr double kFarRadius = 2.5;

/// Two cases: near the axis for all methods, and far from it.
std::array<VerificationCase, 2> sobolev_cases(double reflectance_1, double reflectance_2,
                                              double distance_1_m) {
    constexpr int radii = 20;
    const exact::ParallelPlanes planes{reflectance_1, reflectance_2, distance_1_m, 1 - distance_1_m, 1};
    const exact::SobolevProblem problem(planes);
    const std::string variant =
        fmt::format("p1 {}, p2 {}, h1 {}", reflectance_1, reflectance_2, distance_1_m);
    const Scene scene = make_sobolev_scene(planes, kLargestRadius);
    const std::string note = fmt::format(
        "squares stand in for the infinite planes, so large that the exact values change by less than {} %.\n"
        "  Of the {} radii from 0 to {}, those beyond {} (\"far\") are for method local alone: so little "
        "light\n"
        "  comes there that the others take 10 to 100 times as long.",
        100 * kLargestTruncation, radii, kLargestRadius, kFarRadius);
    VerificationCase near{"sobolev", variant + ", near", scene, {}, "", note};
    VerificationCase far{"sobolev", variant + ", far", scene, {}, "local", note};
    for (int i = 0; i < radii; ++i) {
        const double radius_m = kLargestRadius * i / (radii - 1);
        for (const exact::Plane plane : {exact::Plane::first, exact::Plane::second}) {
            (radius_m < kFarRadius ? near : far)
                .readings.push_back({sobolev_point(planes, plane, radius_m, i * kGoldenAngle),
                                     problem.illuminance_lx(plane, radius_m)});
        }
    }
    return {near, far};
}

// Spheres

VerificationCase photometric_sphere_case(double reflectance) {
    constexpr double flux_lm = 1000;
    const exact::PhotometricSphere sphere{2, reflectance};
    const Vec3 center{1, -2, 3};
    const Vec3 source{0.8, -0.5, 0.7};  // from the centre
    VerificationCase result{"photometric sphere", fmt::format("rho {}", reflectance), {}, {}};
    add_object(result.scene, Sphere{center, sphere.radius_m}, diffuse(reflectance));
    result.scene.lights.push_back(
        {"source", PointLight{center + source, Spectrum::grey(flux_lm / (4 * kPi))}});
    for (const Vec3& to_wall : spread_directions(12)) {
        result.readings.push_back({{center + sphere.radius_m * to_wall, -to_wall},
                                   exact::illuminance_lx(sphere, flux_lm, source, to_wall)});
    }
    return result;
}

VerificationCase concentric_spheres_case(double inner_reflectance, double outer_reflectance) {
    constexpr double inner_m = 0.4, outer_m = 1, luminance_cd_m2 = 100;
    const auto [inner_lx, outer_lx] = exact::two_surface_illuminance_lx(
        {{{kPi * luminance_cd_m2, inner_reflectance}, {0, outer_reflectance}}},
        exact::concentric_sphere_form_factors(inner_m, outer_m));
    VerificationCase result{"concentric spheres",
                            fmt::format("rho {} inside, {} outside", inner_reflectance, outer_reflectance),
                            {},
                            {}};
    add_area_light(result.scene, add_object(result.scene, Sphere{{}, inner_m}, diffuse(inner_reflectance)),
                   luminance_cd_m2);
    add_object(result.scene, Sphere{{}, outer_m}, diffuse(outer_reflectance));
    for (const Vec3& direction : spread_directions(6)) {
        result.readings.push_back({{inner_m * direction, direction}, inner_lx});
        result.readings.push_back({{outer_m * direction, -direction}, outer_lx});
    }
    return result;
}

// The furnace

/// Front: where the vertices run counterclockwise.
void add_quad(Mesh& mesh, const std::array<Vec3, 4>& vertices) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), vertices.begin(), vertices.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
}

/// A room of 2 m squares on an L, 2.5 m high, with the front inside. The first four quads are walls.
Mesh l_shaped_room() {
    constexpr double height_m = 2.5;
    constexpr std::array<std::array<double, 2>, 8> outline{
        {{0, 0}, {2, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}, {0, 2}}};
    constexpr std::array<std::array<double, 2>, 3> squares{{{0, 0}, {2, 0}, {0, 2}}};
    Mesh mesh;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const auto [x1, y1] = outline[i];
        const auto [x2, y2] = outline[(i + 1) % outline.size()];
        add_quad(mesh, {{{x1, y1, 0}, {x1, y1, height_m}, {x2, y2, height_m}, {x2, y2, 0}}});
    }
    for (const auto& [x, y] : squares) {
        add_quad(mesh, {{{x, y, 0}, {x + 2, y, 0}, {x + 2, y + 2, 0}, {x, y + 2, 0}}});
        add_quad(mesh,
                 {{{x, y, height_m}, {x, y + 2, height_m}, {x + 2, y + 2, height_m}, {x + 2, y, height_m}}});
    }
    return mesh;
}

/// On walls, floor and ceiling, and in the air with tilted normals.
std::vector<MeasuringPoint> furnace_points() {
    return {{{1, 1, 0}, {0, 0, 1}},
            {{3, 0.7, 2.5}, {0, 0, -1}},
            {{2, 3.1, 1.2}, {-1, 0, 0}},
            {{1.2, 1.1, 1.0}, normalized({1, 2, -2})},
            {{3.2, 1.3, 0.6}, normalized({-2, 0.3, 1})},
            {{0.8, 3.3, 1.7}, normalized({0.2, -1, 0.4})}};
}

VerificationCase furnace_case(const std::string& variant, double reflectance,
                              const std::vector<Material>& wall_materials) {
    constexpr double luminance_cd_m2 = 10;
    VerificationCase result{"furnace", fmt::format("rho {}, {}", reflectance, variant), {}, {}};
    result.note =
        "an L-shaped room whose walls all shine and reflect. Not with Phong surfaces, whose albedo depends\n"
        "  on the direction.";
    const Mesh room = l_shaped_room();
    const ObjectId walls = add_object(result.scene, room, wall_materials.front());
    std::vector<MaterialId> ids{MaterialId{0}};
    for (std::size_t m = 1; m < wall_materials.size(); ++m) {
        ids.push_back(add_material(result.scene, wall_materials[m]));
    }
    auto& of_triangles = result.scene.objects.front().materials;
    of_triangles.clear();
    for (std::size_t t = 0; t < room.triangles.size(); ++t) of_triangles.push_back(ids[t / 2 % ids.size()]);
    add_area_light(result.scene, walls, luminance_cd_m2);
    for (const MeasuringPoint& point : furnace_points()) {
        result.readings.push_back({point, exact::furnace_illuminance_lx(luminance_cd_m2, reflectance)});
    }
    return result;
}

// Single sources

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
    scene.lights.push_back({"source", PointLight{{}, Spectrum::grey(100)}});
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

std::vector<VerificationCase> verification_cases() {
    std::vector<VerificationCase> cases;
    const std::array<std::array<double, 3>, 4> planes{
        {{0.5, 0.5, 0.5}, {0.8, 0.3, 0.25}, {0.7, 0.9, 0.5}, {0.2, 0.7, 0.8}}};
    for (const auto& [reflectance_1, reflectance_2, distance_1_m] : planes) {
        for (VerificationCase& c : sobolev_cases(reflectance_1, reflectance_2, distance_1_m)) {
            cases.push_back(std::move(c));
        }
    }
    for (const double reflectance : {0.3, 0.8, 0.95}) cases.push_back(photometric_sphere_case(reflectance));
    cases.push_back(concentric_spheres_case(0.5, 0.8));
    const Diffuse half = diffuse(0.5), bright = diffuse(0.8);
    cases.push_back(furnace_case("diffuse", 0.5, {half}));
    cases.push_back(furnace_case("diffuse", 0.8, {bright}));
    cases.push_back(furnace_case("some mirrors", 0.8, {bright, Mirror{Spectrum::grey(0.8)}, bright}));
    cases.push_back(point_source_case());
    cases.push_back(rectangle_source_case());
    cases.push_back(disk_source_case());
    cases.push_back(sphere_source_case());
    return cases;
}

}  // namespace stilb
