// The photometric (integrating) sphere: the inside of a diffuse sphere, lit from within.
#pragma once

#include "base/vec.h"

namespace stilb::exact {

/// A diffuse wall seen from inside, with the centre at the origin.
struct PhotometricSphere {
    double radius_m = 1;     ///< positive
    double reflectance = 0;  ///< 0 to less than 1
};

/// The illuminance after one or more reflections: the same at every wall point, wherever the light is and
/// however it is distributed. Throws std::domain_error on arguments out of range.
double indirect_illuminance_lx(const PhotometricSphere& sphere, double flux_lm);

/// Direct and indirect illuminance of the wall in direction `to_wall` from the centre, by an isotropic point
/// source of flux `flux_lm` at `source`. Throws std::domain_error where the source is not inside the sphere.
double illuminance_lx(const PhotometricSphere& sphere, double flux_lm, const Vec3& source,
                      const Vec3& to_wall);

}  // namespace stilb::exact
