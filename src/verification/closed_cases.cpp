
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "exact/closed_rooms.h"
#include "materials/black.h"
#include "materials/dielectric.h"
#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/plastic.h"
#include "materials/rough_conductor.h"
#include "materials/thin_dielectric.h"
#include "verification/verification.h"

namespace stilb::verification {

namespace {

VerificationCase photometric_sphere_case(double reflectance) {
    constexpr double flux_lm = 1000;
    const exact::PhotometricSphere sphere{2, reflectance};
    const Vec3 center{1, -2, 3};
    const Vec3 source{0.8, -0.5, 0.7};  // from the centre
    VerificationCase result{"photometric sphere", fmt::format("rho {}", reflectance), {}, {}};
    add_object(result.scene, Sphere{center, sphere.radius_m}, diffuse(reflectance));
    result.scene.lights.push_back({"source", PointLight{center + source, Rgb::grey(flux_lm / (4 * kPi))}});
    for (const Vec3& to_wall : spread_directions(12)) {
        result.readings.push_back({MeasuringPoint{center + sphere.radius_m * to_wall, -to_wall},
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
        result.readings.push_back({MeasuringPoint{inner_m * direction, direction}, inner_lx});
        result.readings.push_back({MeasuringPoint{outer_m * direction, -direction}, outer_lx});
    }
    return result;
}

}  // namespace

std::vector<VerificationCase> sphere_cases() {
    std::vector<VerificationCase> cases;
    for (const double reflectance : {0.3, 0.8, 0.95}) cases.push_back(photometric_sphere_case(reflectance));
    cases.push_back(concentric_spheres_case(0.5, 0.8));
    return cases;
}

namespace {

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

constexpr double kEmitted = 10;
constexpr const char* kFurnaceNote =
    "an L-shaped room whose walls all emit and reflect. Not with Phong and Ward surfaces, whose albedo\n"
    "  depends on the direction. Objects in it that absorb no light are invisible; white rough and plastic\n"
    "  balls are invisible within the errors of their tables (docs/materials.md).";

/// A furnace without readings.
VerificationCase furnace(const std::string& variant, double reflectance,
                         const std::vector<Material>& wall_materials) {
    VerificationCase result{"furnace", fmt::format("rho {}, {}", reflectance, variant), {}, {}};
    result.note = kFurnaceNote;
    const Mesh room = l_shaped_room();
    const ObjectId walls = add_object(result.scene, room, wall_materials.front());
    std::vector<MaterialId> ids{MaterialId{0}};
    for (std::size_t m = 1; m < wall_materials.size(); ++m) {
        ids.push_back(add_material(result.scene, wall_materials[m]));
    }
    std::vector<MaterialId> of_triangles;
    for (std::size_t t = 0; t < room.triangles.size(); ++t) of_triangles.push_back(ids[t / 2 % ids.size()]);
    result.scene.objects.front().materials = std::move(of_triangles);
    add_area_light(result.scene, walls, kEmitted);
    return result;
}

void add_illuminances(VerificationCase& furnace, double reflectance) {
    for (const MeasuringPoint& point : furnace_points()) {
        furnace.readings.push_back({point, exact::furnace_illuminance_lx(kEmitted, reflectance)});
    }
}

/// Lines of sight in the air, and rays leaving floor, ceiling and wall.
void add_luminances(VerificationCase& furnace, double reflectance) {
    const double luminance_cd_m2 = exact::furnace_luminance_cd_m2(kEmitted, reflectance);
    for (const auto& [position, normal] : furnace_points()) {
        for (const Vec3& direction : spread_directions(5)) {
            if (dot(direction, normal) < 0.05) continue;
            const bool in_the_air = std::abs(normal.x * normal.y) > 0;
            furnace.readings.push_back({in_the_air ? Measurand{LineOfSight{position, direction}}
                                                   : Measurand{EmergentRay{position, normal, direction}},
                                        luminance_cd_m2});
        }
    }
}

std::vector<VerificationCase> furnaces_of_walls() {
    const auto grey = [](double reflectance) { return Rgb::grey(reflectance); };
    struct Walls {
        std::string variant;
        double reflectance;
        std::vector<Material> materials;
    };
    const std::vector<Walls> all{
        {"diffuse", 0.5, {diffuse(0.5)}},
        {"diffuse", 0.8, {diffuse(0.8)}},
        {"some mirrors", 0.8, {diffuse(0.8), Mirror{grey(0.8)}, diffuse(0.8)}},
        {"black", 0, {Black{}}},
    };
    std::vector<VerificationCase> cases;
    for (const auto& [variant, reflectance, materials] : all) {
        cases.push_back(furnace(variant, reflectance, materials));
        cases.push_back(furnace(variant + ", luminance", reflectance, materials));
        add_illuminances(cases.end()[-2], reflectance);
        add_luminances(cases.back(), reflectance);
    }
    return cases;
}

/// Two walls, outside of which nothing of the room is visible, are open to an environment with the
/// luminance of the furnace: nothing changes inside.
std::vector<VerificationCase> open_furnaces() {
    constexpr double reflectance = 0.6;
    std::vector<VerificationCase> cases{
        furnace("open to an environment", reflectance, {diffuse(reflectance)}),
        furnace("open to an environment, luminance", reflectance, {diffuse(reflectance)})};
    for (VerificationCase& c : cases) {
        auto& mesh = std::get<Mesh>(c.scene.objects.front().shape);
        SharedList<MaterialId>& materials = c.scene.objects.front().materials;
        mesh.triangles.erase(mesh.triangles.begin() + 2, mesh.triangles.begin() + 6);
        std::vector<MaterialId> left(materials.begin(), materials.end());
        left.erase(left.begin() + 2, left.begin() + 6);
        materials = std::move(left);
        add_environment(c.scene, exact::furnace_luminance_cd_m2(kEmitted, reflectance));
    }
    add_illuminances(cases[0], reflectance);
    add_luminances(cases[1], reflectance);
    return cases;
}

// Invisible objects in a furnace

constexpr Vec3 kMiddle{1, 1, 1.2};  ///< of the object
constexpr double kHalfSize = 0.45;

/// Around a convex object whose albedo is wrong by at most `albedo_error`, the object's
/// luminance is wrong by (albedo_error + the error of the incident light), and that error is `reflectance`
/// times the object's error.
double largest_error(double albedo_error, double reflectance) { return albedo_error / (1 - reflectance); }

/// Lines of sight to positions all over the object, which is no larger than a ball of kHalfSize, and past it;
/// and to the floor beside it.
VerificationCase invisible_case(const std::string& variant, const Shape& thing, const Material& material,
                                double albedo_error) {
    constexpr double reflectance = 0.2;
    VerificationCase result = furnace(variant + " inside", reflectance, {diffuse(reflectance)});
    add_object(result.scene, thing, material);
    const double tolerance = largest_error(albedo_error, reflectance);
    const double luminance_cd_m2 = exact::furnace_luminance_cd_m2(kEmitted, reflectance);
    for (const Vec3& position : {Vec3{3, 0.8, 1.5}, Vec3{0.4, 3.2, 0.9}}) {
        for (const Vec3& offset : spread_directions(6)) {
            const Vec3 target = kMiddle + 0.9 * kHalfSize * offset;
            result.readings.push_back(
                {LineOfSight{position, normalized(target - position)}, luminance_cd_m2, tolerance});
        }
    }
    result.readings.push_back(
        {EmergentRay{{1.2, 1.1, 0}, {0, 0, 1}, normalized(Vec3{1, -1, 1})}, luminance_cd_m2, tolerance});
    return result;
}

std::vector<VerificationCase> furnaces_with_things() {
    const Rgb white = Rgb::grey(1);
    const Sphere ball{kMiddle, kHalfSize};
    const Vec3 corner{0.2, 0.25, 0.3};
    const Box box{kMiddle - corner, kMiddle + corner};
    const Rectangle sheet{kMiddle - Vec3{0.1, 0.4, 0.4}, {0.2, 0.8, 0}, {0, 0, 0.8}};
    return {
        invisible_case("glass ball", ball, Dielectric{1.5}, 0),
        invisible_case("glass box", box, Dielectric{1.5}, 0),
        invisible_case("pane", sheet, ThinDielectric{1.52, white}, 0),
        invisible_case("mirror", sheet, Mirror{white}, 0),
        invisible_case("white diffuse ball", ball, Diffuse{white}, 0),
        invisible_case("white rough ball", ball, RoughConductor({white, 0.3}), 0.003),
        invisible_case("white plastic ball", ball, Plastic({white, 1.5, 0.2}), 0.001),
    };
}

}  // namespace

std::vector<VerificationCase> furnace_cases() {
    std::vector<VerificationCase> cases = furnaces_of_walls();
    for (VerificationCase& c : open_furnaces()) cases.push_back(std::move(c));
    for (VerificationCase& c : furnaces_with_things()) cases.push_back(std::move(c));
    return cases;
}

}  // namespace stilb::verification
