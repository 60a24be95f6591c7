#include "io/import/coated_surface.h"

#include <algorithm>
#include <cmath>

#include "materials/plastic.h"
#include "materials/thin_dielectric.h"

namespace stilb::io {

Plastic plastic_returning(const Rgb& returned, double ior, double roughness) {
    ior = std::clamp(ior, materials::kIor.min, materials::kIor.max);
    roughness = std::clamp(roughness, materials::kRoughness.min, materials::kRoughness.max);
    const double passing = 1 - Plastic({Rgb{}, ior, roughness}).mean_reflectance().luminance();
    const double from_within = 1 - passing / (ior * ior);  // materials/plastic.h
    Rgb diffuse;
    for (std::size_t b = 0; b < kBands; ++b) {
        const double share = std::clamp(returned[b], 0.0, 1.0);
        diffuse[b] = std::min(share / (1 - from_within + share * from_within), 1.0);
    }
    return Plastic({diffuse, ior, roughness});
}

double normal_reflectance(double ior) {
    const double amplitude = (ior - 1) / (ior + 1);
    return amplitude * amplitude;
}

double ior_of_normal_reflectance(double reflectance) {
    const double most = normal_reflectance(materials::kIor.max);
    const double amplitude = std::sqrt(std::clamp(reflectance, 0.0, most));
    return std::min((1 + amplitude) / (1 - amplitude), materials::kIor.max);
}

ThinDielectric sheet(double reflectance, const Rgb& transmittance) {
    // Two faces of the reflectance r reflect 2 r / (1 + r) together.
    const double face = reflectance / (2 - reflectance);
    ThinDielectric pane;
    pane.ior = ior_of_normal_reflectance(face);
    for (std::size_t b = 0; b < kBands; ++b)
        pane.internal_transmittance[b] = std::clamp(transmittance[b], 0.0, 1.0);
    return pane;
}

}  // namespace stilb::io
