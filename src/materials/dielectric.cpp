#include "materials/dielectric.h"

#include <algorithm>
#include <cmath>

namespace stilb::materials {

double refracted_cosine(double cosine, double ior) {
    return std::sqrt(std::max(0.0, 1 - (1 - cosine) * (1 + cosine) / (ior * ior)));
}

FresnelReflectance fresnel_reflectance(double cosine, double ior) {
    if (ior == 1) return {};
    const double refracted = refracted_cosine(cosine, ior);
    const double across = (cosine - ior * refracted) / (cosine + ior * refracted);
    const double along = (ior * cosine - refracted) / (ior * cosine + refracted);
    return {across * across, along * along};
}

}  // namespace stilb::materials
