#include "exact/two_surfaces.h"

#include <cmath>

#include "exact/domain.h"

namespace stilb::exact {

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

}  // namespace stilb::exact
