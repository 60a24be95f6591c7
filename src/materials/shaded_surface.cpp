#include "materials/shaded_surface.h"

#include <algorithm>

#include "math/sampling.h"

namespace stilb::materials {
namespace {

/// Attempts to scatter particles by the cosine to the geometric normal. Directions at grazing angles to the
/// shading surface, which materials hardly ever sample, may be far above the triangle.
constexpr double kCosineShare = 0.25;

Vec3 behind(const Vec3& v) { return {v.x, v.y, -v.z}; }

/// Share of the flux reflected at a specular surface, with `in` in front.
Rgb reflected_share(const Material& material, LightSide side, const Vec3& in) {
    const SpecularBranches branches = specular_branches(material, side, in);
    for (const SpecularBranch& branch : branches.list()) {
        if (branch.direction.z > 0) return branch.share;
    }
    return {};
}

}  // namespace

Rgb ShadedSurface::bent_brdf_per_sr(const Vec3& in, const Vec3& out) const {
    if (in.z <= 0 || out.z <= 0) return {};
    const Vec3 shaded_in = shading_.to_local(in);
    if (shaded_in.z <= 0) return {};
    return evaluate_brdf_per_sr(*material_, shaded_in, turned_to_front(shading_.to_local(out))) *
           std::min(shaded_in.z / in.z, kMostBrightening);
}

double ShadedSurface::pdf_of_incoming_per_sr(const Vec3& out, const Vec3& in) const {
    if (!is_bent_) return pdf_per_sr(*material_, out, in);
    if (in.z <= 0 || out.z <= 0) return 0;
    return pdf_per_sr(*material_, turned_to_front(shading_.to_local(out)), shading_.to_local(in));
}

ScatterValue ShadedSurface::evaluate(const Vec3& in, const Vec3& out) const {
    if (!is_bent_) return evaluate_and_pdf(*material_, in, out);
    return {bent_brdf_per_sr(in, out), pdf_of_incoming_per_sr(out, in)};
}

std::optional<ScatterSample> ShadedSurface::sample_incoming(const Vec3& out, double u1, double u2) const {
    if (!is_bent_) return sample_brdf(*material_, out, u1, u2);
    if (out.z <= 0) return std::nullopt;
    const auto drawn = sample_brdf(*material_, turned_to_front(shading_.to_local(out)), u1, u2);
    if (!drawn) return std::nullopt;
    const Vec3 in = shading_.to_world(drawn->direction);
    if (in.z <= 0) return std::nullopt;
    const double kept = std::min(1.0, kMostBrightening * in.z / drawn->direction.z);
    return ScatterSample{in, drawn->weight * kept, drawn->pdf_per_sr};
}

std::optional<Vec3> ShadedSurface::bent_outgoing(const Vec3& shaded_in, double u1, double u2) const {
    if (u1 < kCosineShare) return math::sample_cosine_hemisphere(u1 / kCosineShare, u2).direction;
    // The viewing direction may be on either side of the shading surface, or on both if both are above the
    // triangle.
    const double u = 2 * (u1 - kCosineShare) / (1 - kCosineShare);
    const bool prefers_front = u < 1;
    const auto drawn =
        sample_brdf(*material_, shaded_in, std::min(prefers_front ? u : u - 1, math::kBelowOne), u2);
    if (!drawn) return std::nullopt;
    const Vec3 front = shading_.to_world(drawn->direction);
    const Vec3 back = shading_.to_world(behind(drawn->direction));
    // The one in front is above the triangle wherever the other is.
    return prefers_front || back.z <= 0 ? front : back;
}

double ShadedSurface::pdf_of_outgoing_per_sr(const Vec3& shaded_in, const Vec3& out) const {
    const Vec3 shaded_out = shading_.to_local(out);
    const bool both_above = shading_.to_world(turned_to_front(shaded_out)).z > 0 &&
                            shading_.to_world(behind(turned_to_front(shaded_out))).z > 0;
    const double of_material = pdf_per_sr(*material_, shaded_in, turned_to_front(shaded_out));
    return kCosineShare * math::cosine_hemisphere_pdf_per_sr(out.z) +
           (1 - kCosineShare) * of_material * (both_above ? 0.5 : 1);
}

std::optional<ScatterSample> ShadedSurface::sample_outgoing(const Vec3& in, double u1, double u2) const {
    if (!is_bent_) return sample_brdf(*material_, in, u1, u2);
    const Vec3 shaded_in = shading_.to_local(in);
    if (in.z <= 0 || shaded_in.z <= 0) return std::nullopt;
    const auto out = bent_outgoing(shaded_in, u1, u2);
    if (!out || out->z <= 0) return std::nullopt;
    const double density = pdf_of_outgoing_per_sr(shaded_in, *out);
    if (!(density > 0)) return std::nullopt;
    return ScatterSample{*out, bent_brdf_per_sr(in, *out) * (out->z / density), density};
}

SpecularBranches ShadedSurface::branches(LightSide side, const Vec3& from, Carried carried) const {
    if (!is_bent_ || passes_straight(*material_)) return specular_branches(*material_, side, from);
    if (from.z <= 0) return {};
    return carried == Carried::luminance ? bent_branches_to_light(side, from)
                                         : bent_branches_to_camera(side, from);
}

// Particles whose flux is multiplied by J = cos_s(in) cos_g(out) / (cos_g(in) cos_s(out)) [Veach 1997, 5.3.2]
// carry the same light as camera paths that keep all luminance. Both are cut where J is above
// kMostBrightening.

SpecularBranches ShadedSurface::bent_branches_to_light(LightSide side, const Vec3& from) const {
    const Vec3 shaded = shading_.to_local(from);
    const SpecularBranches flat = specular_branches(*material_, side, turned_to_front(shaded));
    SpecularBranches result;
    for (SpecularBranch branch : flat.list()) {
        if (branch.direction.z > 0) {
            branch.direction = turned_to_front(reflected(from, shading_.w));
            branch.share *= std::min(1.0, kMostBrightening * branch.direction.z / from.z);
        } else {
            const double cosine = -branch.direction.z;
            branch.direction = shading_.to_world(branch.direction);
            if (shaded.z <= 0 || branch.direction.z >= 0) continue;
            branch.share *=
                std::min(1.0, kMostBrightening * -branch.direction.z * shaded.z / (cosine * from.z));
        }
        if (branch.direction.z != 0) result.add(branch);
    }
    return result;
}

SpecularBranches ShadedSurface::bent_branches_to_camera(LightSide side, const Vec3& from) const {
    SpecularBranches result;
    // Reflected light may come from a mirrored direction that was turned upwards, or from one that was not.
    for (const Vec3& mirrored_out : {from, behind(from)}) {
        const Vec3 out = reflected(mirrored_out, shading_.w);
        if (out.z <= 0) continue;
        const Rgb share = reflected_share(*material_, side, turned_to_front(shading_.to_local(out)));
        result.add({out, share * std::min(out.z / from.z, kMostBrightening)});
    }
    const Vec3 shaded = shading_.to_local(from);
    const SpecularBranches flat = specular_branches(*material_, side, shaded);
    for (SpecularBranch branch : flat.list()) {
        if (branch.direction.z > 0) continue;
        const double cosine = -branch.direction.z;
        branch.direction = shading_.to_world(branch.direction);
        if (branch.direction.z >= 0) continue;
        branch.share *= std::min(shaded.z * -branch.direction.z / (from.z * cosine), kMostBrightening);
        result.add(branch);
    }
    return result;
}

}  // namespace stilb::materials
