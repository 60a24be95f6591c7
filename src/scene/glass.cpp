#include "scene/glass.h"

#include <cmath>

#include "scene/dielectric.h"

namespace stilb {
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

std::optional<GlassSample> sample_glass(const Glass& material, GlassSide side, const Vec3& in, double u) {
    if (in.z <= 0) return std::nullopt;
    const double ior = side == GlassSide::outside ? material.ior : 1 / material.ior;
    GlassSample sample{{{-in.x, -in.y, in.z}, Spectrum::grey(1), 0, true}};
    if (u < fresnel_reflectance(in.z, ior).unpolarised()) return sample;
    sample.scattered.direction = normalized(Vec3{-in.x / ior, -in.y / ior, -refracted_cosine(in.z, ior)});
    sample.luminance_factor = 1 / (ior * ior);
    return sample;
}

PaneShares pane_shares(const Pane& material, double cosine) {
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

std::optional<ScatterSample> sample_pane(const Pane& material, const Vec3& in, double u) {
    if (in.z <= 0) return std::nullopt;
    const PaneShares shares = pane_shares(material, in.z);
    const double mirrored = shares.reflectance.luminance();
    const double total = mirrored + shares.transmittance.luminance();
    if (u * total < mirrored) {
        return ScatterSample{{-in.x, -in.y, in.z}, shares.reflectance * (total / mirrored), 0, true};
    }
    return ScatterSample{-in, shares.transmittance * (total / (total - mirrored)), 0, true};
}

}  // namespace stilb
