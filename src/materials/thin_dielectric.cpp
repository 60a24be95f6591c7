#include "materials/thin_dielectric.h"

#include <cmath>

#include "materials/dielectric.h"

namespace stilb::materials {
namespace {

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

ThinDielectric::Shares ThinDielectric::shares(double cosine) const {
    const FresnelReflectance face = fresnel_reflectance(cosine, ior);
    const double length = 1 / refracted_cosine(cosine, ior);
    Shares shares;
    for (std::size_t b = 0; b < kBands; ++b) {
        const double inside = std::pow(internal_transmittance[b], length);
        const OfOnePolarisation s = with_inter_reflections(face.s, inside);
        const OfOnePolarisation p = with_inter_reflections(face.p, inside);
        shares.reflectance[b] = (s.reflectance + p.reflectance) / 2;
        shares.transmittance[b] = (s.transmittance + p.transmittance) / 2;
    }
    return shares;
}

SpecularBranches ThinDielectric::branches(LightSide, const Vec3& in) const {
    const Shares divided = shares(in.z);
    SpecularBranches branches;
    branches.add({mirrored(in), divided.reflectance});
    branches.add({-in, divided.transmittance});
    return branches;
}

}  // namespace stilb::materials
