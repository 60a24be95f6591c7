// Smooth interfaces between two transparent media, and glass, the solid bounded by them.
#pragma once

#include <algorithm>
#include <cmath>

#include "materials/model.h"

namespace stilb::materials {

/// Shares of the flux that are reflected, for light polarised across (s) and along (p) the plane of
/// incidence.
struct FresnelReflectance {
    double s = 0, p = 0;

    double unpolarised() const { return (s + p) / 2; }
};

/// Cosine of the refracted ray's angle to the normal, for light that arrives at an angle of `cosine` >= 0; 0
/// for total reflection. `ior` is that of the far side over that of the near one.
double refracted_cosine(double cosine, double ior);

/// Fresnel's equations [Born, Wolf 1999, Principles of optics, 1.5.2 (21)]. 1 beyond the angle of total
/// reflection.
FresnelReflectance fresnel_reflectance(double cosine, double ior);

/// The surface of a clear solid: light is divided by Fresnel's equations for unpolarised light and refracted
/// by Snell's law. Absorption inside of the solid is not handled.
struct Dielectric {
    double ior = 1.5;  ///< of the solid
    double outside_ior =
        1;  ///< of the medium around it: that of another solid that it lies in (scene/glass.h)

    static constexpr std::string_view kType = "glass";
    static constexpr auto fields() {
        return std::tuple{Field{"ior", &Dielectric::ior, kIor, "refractive index of the solid"}};
    }

    SpecularBranches branches(LightSide side, const Vec3& in) const;
    Rgb reflectance_bound() const { return Rgb::grey(1); }
};

inline double refracted_cosine(double cosine, double ior) {
    return std::sqrt(std::max(0.0, 1 - (1 - cosine) * (1 + cosine) / (ior * ior)));
}

inline FresnelReflectance fresnel_reflectance(double cosine, double ior) {
    if (ior == 1) return {};
    const double refracted = refracted_cosine(cosine, ior);
    const double across = (cosine - ior * refracted) / (cosine + ior * refracted);
    const double along = (ior * cosine - refracted) / (ior * cosine + refracted);
    return {across * across, along * along};
}

inline SpecularBranches Dielectric::branches(LightSide side, const Vec3& in) const {
    const double far_over_near = side == LightSide::outside ? ior / outside_ior : outside_ior / ior;
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

namespace stilb {
using materials::Dielectric;
}  // namespace stilb
