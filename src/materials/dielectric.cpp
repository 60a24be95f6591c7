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

SpecularBranches Dielectric::branches(LightSide side, const Vec3& in) const {
    const double far_over_near = side == LightSide::outside ? ior : 1 / ior;
    const double reflectance = fresnel_reflectance(in.z, far_over_near).unpolarised();
    SpecularBranches branches;
    branches.add({mirrored(in), Rgb::grey(reflectance)});
    if (reflectance < 1) {
        const Vec3 refracted = normalized(
            Vec3{-in.x / far_over_near, -in.y / far_over_near, -refracted_cosine(in.z, far_over_near)});
        branches.add({refracted, Rgb::grey(1 - reflectance), 1 / (far_over_near * far_over_near)});
    }
    return branches;
}

}  // namespace stilb::materials
