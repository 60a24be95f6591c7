#include "materials/specular.h"

#include <cmath>

#include "materials/dielectric.h"

namespace stilb::materials {
namespace {

Vec3 mirrored(const Vec3& in) { return {-in.x, -in.y, in.z}; }

struct OfOnePolarisation {
    double reflectance = 0, transmittance = 0;
};

/// `face` reflects this share, a passage leaves `inside`. Where a face reflects everything, so does the
/// sheet.
OfOnePolarisation with_inter_reflections(double face, double inside) {
    if (face >= 1) return {1, 0};
    const double transmittance = (1 - face) * (1 - face) * inside / (1 - face * face * inside * inside);
    return {face + face * inside * transmittance, transmittance};
}

}  // namespace

SpecularBranches specular_branches(const Mirror& material, LightSide, const Vec3& in) {
    SpecularBranches branches;
    branches.add({mirrored(in), material.reflectance});
    return branches;
}

SpecularBranches specular_branches(const Dielectric& material, LightSide side, const Vec3& in) {
    const double ior = side == LightSide::outside ? material.ior : 1 / material.ior;
    const double reflectance = fresnel_reflectance(in.z, ior).unpolarised();
    SpecularBranches branches;
    branches.add({mirrored(in), Rgb::grey(reflectance)});
    if (reflectance < 1) {
        const Vec3 refracted = normalized(Vec3{-in.x / ior, -in.y / ior, -refracted_cosine(in.z, ior)});
        branches.add({refracted, Rgb::grey(1 - reflectance), 1 / (ior * ior)});
    }
    return branches;
}

SpecularBranches specular_branches(const ThinDielectric& material, LightSide, const Vec3& in) {
    const PaneShares shares = pane_shares(material, in.z);
    SpecularBranches branches;
    branches.add({mirrored(in), shares.reflectance});
    branches.add({-in, shares.transmittance});
    return branches;
}

PaneShares pane_shares(const ThinDielectric& material, double cosine) {
    const FresnelReflectance face = fresnel_reflectance(cosine, material.ior);
    const double length = 1 / refracted_cosine(cosine, material.ior);
    PaneShares shares;
    for (std::size_t b = 0; b < kBands; ++b) {
        const double inside = std::pow(material.internal_transmittance[b], length);
        const OfOnePolarisation s = with_inter_reflections(face.s, inside);
        const OfOnePolarisation p = with_inter_reflections(face.p, inside);
        shares.reflectance[b] = (s.reflectance + p.reflectance) / 2;
        shares.transmittance[b] = (s.transmittance + p.transmittance) / 2;
    }
    return shares;
}

}  // namespace stilb::materials
