#include "verification/cie171.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "exact/closed_rooms.h"
#include "exact/configuration_factors.h"
#include "exact/diffuse_cube.h"
#include "lights/luminaire.h"
#include "materials/black.h"
#include "materials/thin_dielectric.h"
#include "math/gauss_legendre.h"
#include "statistics/combination.h"

namespace stilb::verification {
namespace {

constexpr double kPercent = 100;
constexpr Vec3 kUp{0, 0, 1}, kDown{0, 0, -1};
constexpr double kDegree = kPi / 180;

/// The measuring points of most cases: A, B, C ... in this order.
std::string letter(std::size_t i) { return std::string(1, static_cast<char>('A' + i)); }

Cie171Row single_row(std::string name, const MeasuringPoint& point, double exact, double weight = 1) {
    return {std::move(name), {{point, weight}}, exact};
}

void add_isotropic(Scene& scene, const Vec3& position, double flux_lm) {
    scene.lights.push_back({"source", PointLight{position, Rgb::grey(flux_lm / (4 * kPi))}});
}

/// The points of a wall at y = 0, 0.5 m apart from 2.75 m down, and of a horizontal surface along y, from
/// 0.25 m on; all in the middle of a room 4 m wide.
std::vector<MeasuringPoint> wall_points() {
    std::vector<MeasuringPoint> points;
    for (const double z : {2.75, 2.25, 1.75, 1.25, 0.75, 0.25}) points.push_back({{2, 0, z}, {0, 1, 0}});
    return points;
}

std::vector<MeasuringPoint> horizontal_points(double z, const Vec3& normal, int count) {
    std::vector<MeasuringPoint> points;
    for (int i = 0; i < count; ++i) points.push_back({{2, 0.25 + 0.5 * i, z}, normal});
    return points;
}

// 5.2 and 5.3: light straight from lamps

/// The intensity 1000 cd cos(gamma), in steps so small that linear interpolation is exact to 4e-7.
PhotometricSolid cosine_solid() {
    constexpr int steps = 900;
    PhotometricSolid::Grid grid{lights::PhotometryType::C, {0}, {}, {}};
    for (int i = 0; i <= steps; ++i) {
        const double gamma_deg = 90.0 * i / steps;
        grid.polar_deg.push_back(gamma_deg);
        grid.intensity_cd.push_back(i == steps ? 0 : 1000 * std::cos(gamma_deg * kDegree));
    }
    return PhotometricSolid(grid);
}

Cie171Case cosine_source_case() {
    constexpr double height_m = 3;
    Cie171Case result{"5.2", "cosine distribution", "lx", {}, {}};
    result.scene.solids.push_back({.file = "cosine", .luminaire = "", .solid = cosine_solid()});
    const lights::LuminaireFrame frame = lights::aim_luminaire(kDown, 0);
    result.scene.lights.push_back(
        {"source", Luminaire{{0, 0, height_m}, SolidId{0}, frame.c0, frame.c90, frame.nadir, Rgb::grey(1)}});
    constexpr std::array<std::array<double, 2>, 10> places{
        {{0, 0}, {0.5, 0}, {1, 0}, {1.5, 0}, {0.5, 0.5}, {1, 0.5}, {1.5, 0.5}, {1, 1}, {1.5, 1}, {1.5, 1.5}}};
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto [x, y] = places[i];
        const double squared = x * x + y * y + height_m * height_m;
        result.rows.push_back(
            single_row(letter(i), {{x, y, 0}, kUp}, 1000 * height_m * height_m / (squared * squared)));
        result.rows.back().tolerance = 1e-6;
    }
    return result;
}

Cie171Case square_source_case() {
    const Rectangle lamp{{1.5, 1.5, 3}, {0, 1, 0}, {1, 0, 0}};
    constexpr double luminance_cd_m2 = 1000;
    Cie171Case result{"5.3", "diffuse square", "lx", {}, {}};
    add_area_light(result.scene, add_object(result.scene, lamp, Black{}), luminance_cd_m2);
    std::vector<MeasuringPoint> points = wall_points();
    std::ranges::copy(horizontal_points(0, kUp, 8), std::back_inserter(points));
    for (std::size_t i = 0; i < points.size(); ++i) {
        result.rows.push_back(
            single_row(letter(i), points[i],
                       exact::illuminance_by_rectangle_lx({points[i].position, points[i].normal}, lamp.corner,
                                                          lamp.edge_u, lamp.edge_v, luminance_cd_m2)));
    }
    return result;
}

// 5.4: the flux that all surfaces of a black room receive

/// The walls of a room from the origin to `size`, as parallelograms with the front inwards.
std::array<Rectangle, 6> walls_of(const Vec3& size) {
    const Vec3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
    return {{{{}, x, y}, {z, y, x}, {{}, y, z}, {x, z, y}, {{}, z, x}, {y, x, z}}};
}

/// Adds the points of a quadrature of the illuminance over a parallelogram, times `factor`.
void add_flux(const Rectangle& surface, double factor, std::vector<Cie171Row::Share>& shares) {
    constexpr int along = 10;
    const math::GaussLegendre rule = math::gauss_legendre(along);
    const Vec3 area = cross(surface.edge_u, surface.edge_v);
    for (std::size_t i = 0; i < along; ++i) {
        for (std::size_t j = 0; j < along; ++j) {
            const double u = (1 + rule.nodes[i]) / 2, v = (1 + rule.nodes[j]) / 2;
            shares.push_back({{surface.corner + u * surface.edge_u + v * surface.edge_v, normalized(area)},
                              factor * length(area) * rule.weights[i] * rule.weights[j] / 4});
        }
    }
}

constexpr Vec3 kRoom{4, 4, 3};

Cie171Case flux_of_lamp_case() {
    constexpr double flux_lm = 10000;
    Cie171Case result{"5.4", "lamp in a closed room", "%", {}, {}};
    add_isotropic(result.scene, 0.5 * kRoom, flux_lm);
    Cie171Row row{"all surfaces", {}, kPercent};
    for (const Rectangle& wall : walls_of(kRoom)) {
        add_object(result.scene, wall, Black{});
        add_flux(wall, kPercent / flux_lm, row.shares);
    }
    row.tolerance = 1e-5;  // of the quadrature
    result.rows.push_back(std::move(row));
    return result;
}

/// A square opening in the middle of the ceiling, under a sky of constant luminance.
Cie171Case flux_of_opening_case() {
    constexpr double luminance_cd_m2 = 1000, opening_m2 = 1;
    Cie171Case result{"5.4", "roof opening of 1 m x 1 m", "%", {}, {}, 1 << 16};
    add_environment(result.scene, luminance_cd_m2);
    Cie171Row row{"floor and walls", {}, kPercent};
    const std::array<Rectangle, 6> walls = walls_of(kRoom);
    for (std::size_t i = 0; i < walls.size(); ++i) {
        if (i == 1) continue;  // the ceiling
        add_object(result.scene, walls[i], Black{});
        add_flux(walls[i], kPercent / (kPi * luminance_cd_m2 * opening_m2), row.shares);
    }
    const double z = kRoom.z;
    for (const Rectangle& strip :
         {Rectangle{{0, 0, z}, {0, 1.5, 0}, {4, 0, 0}}, Rectangle{{0, 2.5, z}, {0, 1.5, 0}, {4, 0, 0}},
          Rectangle{{0, 1.5, z}, {0, 1, 0}, {1.5, 0, 0}}, Rectangle{{2.5, 1.5, z}, {0, 1, 0}, {1.5, 0, 0}}}) {
        add_object(result.scene, strip, Black{});
    }
    row.tolerance = 1e-4;  // of the quadrature
    result.rows.push_back(std::move(row));
    return result;
}

// 5.5: clear glass

/// A point source above a large pane; the rows are its transmittance at the angle of the direct light.
Cie171Case glass_case() {
    constexpr double intensity_cd = 1000, height_m = 2;
    constexpr exact::PaneOptics glass{1.52, 0.97};
    Cie171Case result{"5.5", "clear glass, 0.97 inside", "%", {}, {}};
    result.scene.lights.push_back({"source", PointLight{{0, 0, height_m}, Rgb::grey(intensity_cd)}});
    add_object(result.scene, Rectangle{{-20, -20, 1}, {40, 0, 0}, {0, 40, 0}},
               ThinDielectric{glass.ior, Rgb::grey(glass.internal_transmittance)});
    for (int angle_deg = 0; angle_deg <= 80; angle_deg += 10) {
        const double angle_rad = angle_deg * kDegree, cosine = std::cos(angle_rad);
        const double without_lx = intensity_cd * cosine * cosine * cosine / (height_m * height_m);
        result.rows.push_back(
            single_row(fmt::format("{} degrees", angle_deg), {{height_m * std::tan(angle_rad), 0, 0}, kUp},
                       kPercent * exact::pane_transmittance(glass, angle_rad), kPercent / without_lx));
        result.rows.back().tolerance = 2e-5;  // of rays in single precision, at 80 degrees
    }
    return result;
}

// 5.6 and 5.7: a diffuse surface S2 lights a vertical and a horizontal surface

/// A bright part of the sky, all else dark: 10 degrees wide about -y, between two heights. Its panorama has
/// pixels of 5 degrees.
struct SkyPart {
    static constexpr double kLuminance_cd_m2 = 1e5, kLow = 60 * kDegree, kHigh = 65 * kDegree,
                            kHalfWidth = 5 * kDegree;

    static void add_to(Scene& scene) {
        constexpr int width = 72, height = 36, row = 5, column = 54;
        Panorama::Image image{width, height, {}};
        image.rgb_cd_m2.resize(std::size_t{width} * height);
        for (const int c : {column - 1, column}) image.rgb_cd_m2[row * width + c].fill(kLuminance_cd_m2);
        EnvironmentLight light;
        light.panorama = std::make_shared<const Panorama>(std::move(image));
        scene.lights.push_back({"sky", light});
    }
    static double on_horizontal_lx() {
        return kLuminance_cd_m2 * kHalfWidth * (std::pow(std::sin(kHigh), 2) - std::pow(std::sin(kLow), 2));
    }
    /// On a vertical surface that faces -y.
    static double on_vertical_lx() {
        const auto primitive = [](double height) { return height / 2 + std::sin(2 * height) / 4; };
        return kLuminance_cd_m2 * 2 * std::sin(kHalfWidth) * (primitive(kHigh) - primitive(kLow));
    }
};

/// E / (E_S2 rho): the configuration factor of the visible part of S2.
Cie171Row factor_row(std::string name, const MeasuringPoint& point, const Rectangle& visible,
                     double exitance_lm_m2) {
    return single_row(std::move(name), point,
                      exact::illuminance_by_rectangle_lx({point.position, point.normal}, visible.corner,
                                                         visible.edge_u, visible.edge_v, kPercent / kPi),
                      kPercent / exitance_lm_m2);
}

/// S2 lies on the ground; the light comes from behind the points of the wall. The lowest point of the wall is
/// none of the case.
Cie171Case diffuse_ground_case() {
    constexpr double reflectance = 0.3;
    const Rectangle ground{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    Cie171Case result{"5.6", "ground of 4 m x 4 m", "%", {}, {}};
    SkyPart::add_to(result.scene);
    add_object(result.scene, ground, diffuse(reflectance));
    std::vector<MeasuringPoint> points = wall_points();
    std::ranges::reverse(points);
    std::ranges::copy(horizontal_points(3, kDown, 8), std::back_inserter(points));
    for (std::size_t i = 1; i < points.size(); ++i)
        result.rows.push_back(
            factor_row(letter(i), points[i], ground, reflectance * SkyPart::on_horizontal_lx()));
    return result;
}

/// S2 is a wall behind a box as wide as both; a roof keeps the direct light from the points.
constexpr double kS2_m = 4, kS2Height_m = 3, kNear_m = 2.5, kFar_m = 2.7, kTop_m = 1;

/// The part of S2 that a point in the middle of the room sees over the box: as that is as wide as S2, all
/// above some height; nothing where that is the top.
std::optional<Rectangle> seen_above_box(const Vec3& from) {
    double height_m = 0;
    for (const double edge_m : {kNear_m, kFar_m})
        height_m = std::max(height_m, from.z + (kTop_m - from.z) * (kS2_m - from.y) / (edge_m - from.y));
    constexpr double rounding_m = 1e-9;
    if (height_m >= kS2Height_m - rounding_m) return std::nullopt;
    return Rectangle{{0, kS2_m, height_m}, {4, 0, 0}, {0, 0, kS2Height_m - height_m}};
}

Cie171Case obstruction_case() {
    constexpr double reflectance = 0.6;
    Cie171Case result{"5.7", "box in front of a wall", "%", {}, {}};
    SkyPart::add_to(result.scene);
    add_object(result.scene, Rectangle{{0, kS2_m, 0}, {4, 0, 0}, {0, 0, kS2Height_m}}, diffuse(reflectance));
    add_object(result.scene, Box{{0, kNear_m, 0}, {4, kFar_m, kTop_m}}, Black{});
    add_object(result.scene, Rectangle{{-10, -10, 3.01}, {24, 0, 0}, {0, 11.4, 0}}, Black{});
    std::vector<MeasuringPoint> points = wall_points();
    std::ranges::copy(horizontal_points(0, kUp, 5), std::back_inserter(points));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto visible = seen_above_box(points[i].position);
        const double exitance_lm_m2 = reflectance * SkyPart::on_vertical_lx();
        result.rows.push_back(visible ? factor_row(letter(i), points[i], *visible, exitance_lm_m2)
                                      : single_row(letter(i), points[i], 0, kPercent / exitance_lm_m2));
    }
    return result;
}

// 5.8: a diffuse cube

Cie171Case cube_case(const exact::DiffuseCube& cube, double side_m, double flux_lm, double reflectance) {
    Cie171Case result{"5.8", fmt::format("cube, reflectance {}", reflectance), "lx", {}, {}};
    const std::array<Rectangle, 6> walls = walls_of({side_m, side_m, side_m});
    for (const Rectangle& wall : walls) add_object(result.scene, wall, diffuse(reflectance));
    add_isotropic(result.scene, Vec3{side_m, side_m, side_m} / 2, flux_lm);
    // By symmetry the mean over the floor is that over all faces.
    Cie171Row mean{"mean", {}, cube.mean_illuminance_lx(reflectance), 2e-4};
    add_flux(walls[0], 1 / (side_m * side_m), mean.shares);
    result.rows.push_back(std::move(mean));
    for (const auto& [x, y] : {std::array{2.0, 2.0}, {1.0, 1.0}, {0.5, 0.5}, {0.1, 2.0}}) {
        const double x_m = x - side_m / 2, y_m = y - side_m / 2;
        result.rows.push_back(single_row(
            fmt::format("floor ({}, {})", x, y), {{x, y, 0}, kUp},
            cube.direct_illuminance_lx(x_m, y_m) + cube.indirect_illuminance_lx(reflectance, x_m, y_m)));
        result.rows.back().tolerance = 2e-4;
    }
    return result;
}

}  // namespace

std::vector<Cie171Case> cie171_cases() {
    std::vector<Cie171Case> cases{cosine_source_case(),   square_source_case(), flux_of_lamp_case(),
                                  flux_of_opening_case(), glass_case(),         diffuse_ground_case(),
                                  obstruction_case()};
    constexpr double side_m = 4, flux_lm = 10000;
    const exact::DiffuseCube cube(side_m, flux_lm);
    for (const double reflectance : {0.2, 0.5, 0.7, 0.8})
        cases.push_back(cube_case(cube, side_m, flux_lm, reflectance));
    return cases;
}

std::vector<CheckedReading> verify(const Cie171Case& verification_case, const RunOptions& asked,
                                   ProgressSink* progress, const std::atomic<bool>* interrupt) {
    RunOptions options = asked;
    if (verification_case.paths) {
        options.error.reset();
        options.paths = verification_case.paths;
    }
    const double confidence = options.error ? statistics::kStoppedConfidence : 0.95;
    IlluminancePoints points;
    for (const Cie171Row& row : verification_case.rows) {
        for (const Cie171Row::Share& share : row.shares) points.points.push_back(share.point);
    }
    const Sensor sensor{"points", points};
    const RunResult run = run::measure(verification_case.scene, {&sensor, 1}, options, progress, interrupt);
    const SensorResult& measured = run.sensors[0];
    const statistics::ReplicateTable table{measured.replicate_means, measured.readings.size()};
    std::vector<CheckedReading> rows;
    std::size_t next = 0;
    for (const Cie171Row& row : verification_case.rows) {
        std::vector<double> weights;
        std::vector<statistics::Quantity> readings;
        double sum = 0;
        for (const Cie171Row::Share& share : row.shares) {
            weights.push_back(share.weight);
            readings.push_back({measured.readings[next].estimate, residuals_of_reading(table, next)});
            sum += share.weight * readings.back().estimate.value;
            ++next;
        }
        const statistics::Estimate estimate = combine(sum, weights, readings, confidence).estimate;
        rows.push_back(check({{}, row.exact, row.tolerance}, estimate, run.replicates));
    }
    return rows;
}

}  // namespace stilb::verification
