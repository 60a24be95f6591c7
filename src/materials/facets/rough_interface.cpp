#include "materials/facets/rough_interface.h"

#include <algorithm>
#include <array>

#include "materials/dielectric.h"
#include "materials/thin_dielectric.h"
#include "math/sampling.h"

namespace stilb::materials {
namespace {

/// Losses of smoother facets are those of rounding.
constexpr double kLeastLoss = 1e-9;

/// The direction on the far side, mirrored to the near one; nothing in total reflection, and where it would
/// not leave the facets.
std::optional<Vec3> refracted(const Vec3& in, const Vec3& normal, double ior) {
    const double cosine = dot(in, normal);
    if (cosine <= 0 || (1 - cosine) * (1 + cosine) >= ior * ior) return std::nullopt;
    const Vec3 out = (cosine / ior - refracted_cosine(cosine, ior)) * normal - in / ior;
    if (out.z >= 0) return std::nullopt;
    return normalized(Vec3{out.x, out.y, -out.z});
}

AlbedoTable reflected_table(const FacetSide& side, bool passing) {
    const Ggx facets(side.roughness);
    return AlbedoTable(side.roughness, [&](double cosine) {
        return mean_over_visible_normals(facets, cosine, [&](const Vec3& in, const Vec3& normal) {
            const Vec3 out = reflected(in, normal);
            const double share = side.reflected(dot(in, normal));
            return out.z > 0 ? (passing ? 1 - share : share) * facets.passing(in, out) : 0;
        });
    });
}

template <int kRings>
AlbedoTable refracted_table(const FacetSide& side) {
    const Ggx facets(side.roughness);
    return AlbedoTable(side.roughness, [&](double cosine) {
        return mean_over_visible_normals<kRings>(facets, cosine, [&](const Vec3& in, const Vec3& normal) {
            const auto out = refracted(in, normal, side.ior);
            return out ? (1 - side.reflected(dot(in, normal))) * facets.shown(*out) : 0;
        });
    });
}

AlbedoTable transmitted_table(const FacetSide& side) {
    if (side.is_sheet) return reflected_table(side, true);
    constexpr int usual = 64, for_edges = 256;
    return side.ior < 1 ? refracted_table<for_edges>(side) : refracted_table<usual>(side);
}

/// The mean over the directions of diffuse light.
double mean_reflected(const FacetSide& side) {
    constexpr int kSteps = 256;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) sum += side.reflected(std::sqrt((i + 0.5) / kSteps));
    return sum / kSteps;
}

}  // namespace

double FacetSide::reflected(double cosine) const {
    cosine = std::clamp(cosine, 0.0, 1.0);
    if (is_sheet) return ThinDielectric{ior}.shares(cosine).reflectance[0];
    return fresnel_reflectance(cosine, ior).unpolarised();
}

FacetAlbedos::FacetAlbedos(const FacetSide& of)
    : side(of),
      reflected(reflected_table(side, false)),
      transmitted(transmitted_table(side)),
      lost(side.roughness, [this](double cosine) {
          return std::max(0.0, 1 - reflected.at(cosine) - transmitted.at(cosine));
      }) {}

FacetLosses::FacetLosses(const FacetAlbedos& near_side, const FacetAlbedos& far_side)
    : near(near_side), far(far_side) {
    // (1 - near) A n^2 with n = 1 on the near side. As much crosses as facets transmit on the side that loses
    // less.
    const double ior = near.side.ior;
    const double of_near = near.lost.average(), of_far = far.lost.average() * ior * ior;
    if (std::min(of_near, of_far) <= kLeastLoss) return;
    const double crossing = of_near < of_far ? of_near * (1 - mean_reflected(near.side))
                                             : of_far * (1 - mean_reflected(far.side));
    reflected = 1 - crossing / of_near;
}

MirroringFacets::MirroringFacets(const FacetAlbedos& albedos, bool passing, double lost_share)
    : side_(albedos.side),
      passing_(passing),
      facets_(side_.roughness),
      once_(passing ? albedos.transmitted : albedos.reflected),
      lost_(albedos.lost),
      lost_share_(albedos.lost.average() > kLeastLoss ? lost_share : 0) {
    concentration_ = concentration_at_normal_incidence(*this);
}

Rgb MirroringFacets::brdf_per_sr(const Vec3& in, const Vec3& out) const {
    const Vec3 half = half_vector(in, out);
    double value = share(dot(in, half)) * facets_.brdf_per_sr(in, out, half);
    if (lost_share_ > 0) value += lost_share_ * lost_.at(in.z) * lost_.at(out.z) / (kPi * lost_.average());
    return Rgb::grey(value);
}

double MirroringFacets::pdf_per_sr(const Vec3& in, const Vec3& out) const {
    const double lost = lost_probability(in.z);
    return (1 - lost) * facets_.pdf_per_sr(in, half_vector(in, out)) + lost * lost_.pdf_per_sr(out.z);
}

std::optional<ScatterSample> MirroringFacets::sample(const Vec3& in, double u1, double u2) const {
    const double lost = lost_probability(in.z);
    Vec3 out;
    if (u1 < lost) {
        out = lost_.sample(u1 / lost, u2);
    } else {
        const double u = std::min((u1 - lost) / (1 - lost), math::kBelowOne);
        out = normalized(reflected(in, facets_.visible_normal(in, math::sample_unit_disk(u, u2))));
    }
    if (out.z <= 0) return std::nullopt;
    const double density = pdf_per_sr(in, out);
    if (!(density > 0)) return std::nullopt;
    return ScatterSample{out, brdf_per_sr(in, out) * (out.z / density), density};
}

RefractingFacets::RefractingFacets(const FacetLosses& losses, Carried carried)
    : side_(losses.near.side),
      ior_(side_.ior),
      facets_(side_.roughness),
      once_(losses.near.transmitted),
      lost_near_(losses.near.lost),
      lost_far_(losses.far.lost),
      lost_share_(1 - losses.reflected),
      carried_(Carried::flux) {
    concentration_ = concentration_at_normal_incidence(*this);
    carried_ = carried;
}

auto RefractingFacets::facet(const Vec3& near, const Vec3& far) const -> std::optional<Facet> {
    const Vec3 beyond{far.x, far.y, -far.z};
    const Vec3 sum = near + ior_ * beyond;
    const double size = length(sum);
    if (!(size > 0)) return std::nullopt;
    Facet facet;
    facet.normal = sum / (sum.z < 0 ? -size : size);
    facet.near_cosine = dot(near, facet.normal);
    facet.far_cosine = -dot(beyond, facet.normal);
    if (!(facet.near_cosine > 0 && facet.far_cosine > 0 && facet.normal.z > 0)) return std::nullopt;
    facet.jacobian = ior_ * ior_ * facet.far_cosine / (size * size);
    return facet;
}

double RefractingFacets::value_per_sr(const Vec3& near, const Vec3& far) const {
    double value = 0;
    if (const auto met = facet(near, far)) {
        // f over the far index; the sum's length is that of both cosines, each times its index.
        value = (1 - side_.reflected(met->near_cosine)) * facets_.distribution_per_sr(met->normal) *
                facets_.shown(near) * facets_.shown(far) * met->near_cosine * met->jacobian /
                (near.z * far.z * ior_);
    }
    if (lost_share_ > 0)
        value +=
            lost_share_ * lost_near_.at(near.z) * lost_far_.at(far.z) / (kPi * lost_far_.average() * ior_);
    return value;
}

double RefractingFacets::pdf_per_sr(const Vec3& in, const Vec3& out) const {
    const double lost = lost_probability(in.z);
    double density = lost > 0 ? lost * lost_far_.pdf_per_sr(out.z) : 0;
    if (const auto met = facet(in, out)) {
        density += (1 - lost) * facets_.distribution_per_sr(met->normal) * facets_.shown(in) *
                   met->near_cosine * met->jacobian / in.z;
    }
    return density;
}

std::optional<ScatterSample> RefractingFacets::sample(const Vec3& in, double u1, double u2) const {
    const double lost = lost_probability(in.z);
    std::optional<Vec3> out;
    if (u1 < lost) {
        out = lost_far_.sample(u1 / lost, u2);
    } else {
        const double u = std::min((u1 - lost) / (1 - lost), math::kBelowOne);
        out = refracted(in, facets_.visible_normal(in, math::sample_unit_disk(u, u2)), ior_);
    }
    if (!out || out->z <= 0) return std::nullopt;
    const double density = pdf_per_sr(in, *out);
    if (!(density > 0)) return std::nullopt;
    return ScatterSample{*out, Rgb::grey(value_per_sr(in, *out) * out->z / density), density};
}

}  // namespace stilb::materials
