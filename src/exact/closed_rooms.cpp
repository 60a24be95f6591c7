
#include "exact/closed_rooms.h"

#include <cmath>
#include <numbers>

#include "exact/configuration_factors.h"
#include "exact/domain.h"

namespace stilb::exact {

double furnace_luminance_cd_m2(double emitted_cd_m2, double reflectance) {
    require_not_negative(emitted_cd_m2, "furnace: the emitted luminance is negative or not finite");
    require(reflectance >= 0 && reflectance < 1, "furnace: the reflectance is not from 0 to less than 1");
    return emitted_cd_m2 / (1 - reflectance);
}

double furnace_illuminance_lx(double emitted_cd_m2, double reflectance) {
    return std::numbers::pi * furnace_luminance_cd_m2(emitted_cd_m2, reflectance);
}

double indirect_illuminance_lx(const PhotometricSphere& sphere, double flux_lm) {
    require_positive(sphere.radius_m, "photometric sphere: the radius is not positive and finite");
    require(sphere.reflectance >= 0 && sphere.reflectance < 1,
            "photometric sphere: the reflectance is not from 0 to less than 1");
    require_not_negative(flux_lm, "photometric sphere: the flux is negative or not finite");
    const double area_m2 = 4 * std::numbers::pi * sphere.radius_m * sphere.radius_m;
    return flux_lm / area_m2 * sphere.reflectance / (1 - sphere.reflectance);
}

double illuminance_lx(const PhotometricSphere& sphere, double flux_lm, const Vec3& source,
                      const Vec3& to_wall) {
    const double indirect_lx = indirect_illuminance_lx(sphere, flux_lm);
    require(length(source) < sphere.radius_m, "photometric sphere: the source is not inside the sphere");
    const Vec3 outward = require_direction(to_wall, "photometric sphere: to_wall is zero or not finite");
    const Receiver wall{sphere.radius_m * outward, -outward};
    return indirect_lx + illuminance_by_point_lx(wall, source, flux_lm / (4 * std::numbers::pi));
}

FormFactors coaxial_disk_form_factors(double radius_1_m, double radius_2_m, double distance_m) {
    require_positive(radius_1_m, "coaxial disks: radius_1_m is not positive and finite");
    require_positive(radius_2_m, "coaxial disks: radius_2_m is not positive and finite");
    require_positive(distance_m, "coaxial disks: the distance is not positive and finite");
    // The lengths of the uncrossed and the crossed strings between the rims; their difference squared is
    // 4 r1 r2 times a factor, written as a quotient because the difference cancels at large distances.
    const double uncrossed_m = std::hypot(distance_m, radius_1_m - radius_2_m);
    const double crossed_m = std::hypot(distance_m, radius_1_m + radius_2_m);
    const double half_sum_m = (crossed_m + uncrossed_m) / 2;
    const double factor_12 = std::pow(radius_2_m / half_sum_m, 2);
    const double factor_21 = std::pow(radius_1_m / half_sum_m, 2);
    return {{{{0, factor_12}, {factor_21, 0}}}};
}

FormFactors concentric_sphere_form_factors(double inner_radius_m, double outer_radius_m) {
    require_positive(inner_radius_m, "concentric spheres: the inner radius is not positive and finite");
    require(outer_radius_m > inner_radius_m && std::isfinite(outer_radius_m),
            "concentric spheres: the outer radius is not larger than the inner one");
    const double factor_21 = std::pow(inner_radius_m / outer_radius_m, 2);
    return {{{{0, 1}, {factor_21, 1 - factor_21}}}};
}

std::array<double, 2> two_surface_illuminance_lx(const std::array<DiffuseSurface, 2>& surfaces,
                                                 const FormFactors& factors) {
    for (const DiffuseSurface& surface : surfaces) {
        require_not_negative(surface.emitted_lm_m2, "two surfaces: an exitance is negative or not finite");
        require(surface.reflectance >= 0 && surface.reflectance <= 1,
                "two surfaces: a reflectance is not between 0 and 1");
    }
    // By reciprocity A1 F12 = A2 F21, so that E_i = sum over j of F_ij M_j with M_j = emitted_j +
    // reflectance_j E_j.
    const auto& [from_1, from_2] = factors.from_to;
    for (const auto& row : factors.from_to)
        require(row[0] >= 0 && row[1] >= 0 && row[0] + row[1] <= 1 + 1e-12,
                "two surfaces: the form factors of a surface are negative or sum to more than 1");
    const double direct_1 = from_1[0] * surfaces[0].emitted_lm_m2 + from_1[1] * surfaces[1].emitted_lm_m2;
    const double direct_2 = from_2[0] * surfaces[0].emitted_lm_m2 + from_2[1] * surfaces[1].emitted_lm_m2;
    const double a = 1 - from_1[0] * surfaces[0].reflectance, b = from_1[1] * surfaces[1].reflectance;
    const double c = from_2[0] * surfaces[0].reflectance, d = 1 - from_2[1] * surfaces[1].reflectance;
    const double determinant = a * d - b * c;
    require(determinant > 0, "two surfaces: no light is ever absorbed");
    return {(d * direct_1 + b * direct_2) / determinant, (c * direct_1 + a * direct_2) / determinant};
}

namespace {

double square(double x) { return x * x; }

/// The transmitted share, summed over internal reflections: `face` is the reflectance of a face, `passage`
/// the transmittance of the inside.
double sum_of_passages(double face, double passage) {
    double term = square(1 - face) * passage, sum = 0;
    while (term > 1e-17 * sum) {
        sum += term;
        term *= square(face * passage);
    }
    return sum;
}

}  // namespace

double pane_transmittance(const PaneOptics& pane, double angle_rad) {
    require(pane.ior > 1 && std::isfinite(pane.ior), "pane: the index of refraction is not above 1");
    require(pane.internal_transmittance >= 0 && pane.internal_transmittance <= 1,
            "pane: the internal transmittance is not from 0 to 1");
    require(angle_rad >= 0 && angle_rad < std::numbers::pi / 2,
            "pane: the angle is not from 0 to less than 90 degrees");
    const double inside_rad = std::asin(std::sin(angle_rad) / pane.ior);
    const double passage = std::pow(pane.internal_transmittance, 1 / std::cos(inside_rad));
    const double less = angle_rad - inside_rad, more = angle_rad + inside_rad;
    // Where sines and tangents vanish, both polarisations are as at the normal.
    if (angle_rad < 1e-8) return sum_of_passages(square((pane.ior - 1) / (pane.ior + 1)), passage);
    const double across = square(std::sin(less) / std::sin(more));
    const double along = square(std::tan(less) / std::tan(more));
    return (sum_of_passages(across, passage) + sum_of_passages(along, passage)) / 2;
}

}  // namespace stilb::exact
