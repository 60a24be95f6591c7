#include "exact/photometric_sphere.h"

#include <numbers>

#include "exact/configuration_factors.h"
#include "exact/domain.h"

namespace stilb::exact {

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

}  // namespace stilb::exact
