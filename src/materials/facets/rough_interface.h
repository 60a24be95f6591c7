// GGX facets of clear media, which reflect light and let it through: the lobes of frosted glass.
//
// What the facets send on at once is [Walter et al. 2007, Microfacet models for refraction through rough
// surfaces], with heights that are correlated in reflection and not in transmission. The loss of that, 1 - R
// - T, leaves the facets after several of them, in proportion to the losses under both directions [Kulla,
// Conty 2017, Revisiting physically based shading at Imageworks], so that no light is lost:
// docs/materials.md.
#pragma once

#include "materials/facets/albedo_table.h"
#include "materials/facets/ggx.h"
#include "materials/model.h"

namespace stilb::materials {

/// Facets that light meets from one side.
struct FacetSide {
    double ior = 1.5;  ///< of the far medium over that of the near one
    double roughness = 0.1;
    /// Facets on both sides of a thin sheet, in one medium. It spreads what it transmits as what it reflects,
    /// mirrored.
    bool is_sheet = false;

    /// Share of the light that a facet reflects. `cosine`: to the facet's normal.
    double reflected(double cosine) const;
};

/// The light that facets send on, by the cosine of its direction.
struct FacetAlbedos {
    explicit FacetAlbedos(const FacetSide& side);

    FacetSide side;
    AlbedoTable reflected, transmitted, lost;
};

/// Both sides of an interface, and where the light goes that the near one loses.
struct FacetLosses {
    FacetAlbedos near, far;
    /// Its share that leaves on the near side. The light that crosses is as much in both directions: (1 -
    /// this) A n^2 is the same from the far side, with A the average of a side's loss.
    double reflected = 1;

    FacetLosses(const FacetAlbedos& near_side, const FacetAlbedos& far_side);
};

/// Lobes of facets that mirror light: to the side that it came from, or, of a sheet, to the other one.
class MirroringFacets {
  public:
    struct Parameters {
        static constexpr auto fields() { return std::tuple{}; }
    };
    static constexpr std::string_view kType = "mirroring facets";

    /// `passing`: what is transmitted. `lost_share`: of what is lost, what this lobe sends on.
    MirroringFacets(const FacetAlbedos& albedos, bool passing, double lost_share);
    explicit MirroringFacets(const Parameters&) : MirroringFacets(FacetAlbedos(FacetSide{}), false, 0) {}

    const Parameters& parameters() const { return parameters_; }
    double concentration() const { return concentration_; }
    Rgb reflectance_bound() const { return Rgb::grey(once_.average() + lost_share_ * lost_.average()); }
    double sent_on(double cosine) const { return once_.at(cosine) + lost_share_ * lost_.at(cosine); }

    Rgb brdf_per_sr(const Vec3& in, const Vec3& out) const;
    double pdf_per_sr(const Vec3& in, const Vec3& out) const;
    ScatterValue evaluate(const Vec3& in, const Vec3& out) const {
        return {brdf_per_sr(in, out), pdf_per_sr(out, in)};
    }
    std::optional<ScatterSample> sample(const Vec3& in, double u1, double u2) const;

  private:
    double share(double cosine) const {
        return passing_ ? 1 - side_.reflected(cosine) : side_.reflected(cosine);
    }
    /// The probability of sampling light that has met several facets.
    double lost_probability(double cosine) const {
        const double all = sent_on(cosine);
        return all > 0 ? lost_share_ * lost_.at(cosine) / all : 0;
    }

    Parameters parameters_;
    FacetSide side_;
    bool passing_;
    Ggx facets_;
    AlbedoTable once_, lost_;
    double lost_share_;
    double concentration_ = 0;
};

/// The lobe of facets that refract light from the near side to the far one. For walks that come from the near
/// side: with the light, or against it. The BRDF is that of radiance over the refractive index of the side
/// that light leaves to, times that of the side it comes from, which is the same in both directions; the
/// factor is Lobe::far_over_near.
class RefractingFacets {
  public:
    struct Parameters {
        static constexpr auto fields() { return std::tuple{}; }
    };
    static constexpr std::string_view kType = "refracting facets";

    /// `losses`: with `near` as the near side.
    RefractingFacets(const FacetLosses& losses, Carried carried);
    explicit RefractingFacets(const Parameters&)
        : RefractingFacets(FacetLosses(FacetAlbedos(FacetSide{}), FacetAlbedos(FacetSide{})), Carried::flux) {
    }

    const Parameters& parameters() const { return parameters_; }
    double concentration() const { return concentration_; }
    Rgb reflectance_bound() const {
        return Rgb::grey((once_.average() + lost_share_ * lost_near_.average()) / ior_);
    }
    double sent_on(double cosine) const { return once_.at(cosine) + lost_share_ * lost_near_.at(cosine); }

    Rgb brdf_per_sr(const Vec3& in, const Vec3& out) const {
        return Rgb::grey(carried_ == Carried::flux ? value_per_sr(in, out) : value_per_sr(out, in));
    }
    /// `in`: on the near side.
    double pdf_per_sr(const Vec3& in, const Vec3& out) const;
    ScatterValue evaluate(const Vec3& in, const Vec3& out) const {
        return {brdf_per_sr(in, out), pdf_per_sr(out, in)};
    }
    std::optional<ScatterSample> sample(const Vec3& in, double u1, double u2) const;

  private:
    double lost_probability(double cosine) const {
        const double all = sent_on(cosine);
        return all > 0 ? lost_share_ * lost_near_.at(cosine) / all : 0;
    }
    /// A facet that refracts one direction to the other.
    struct Facet {
        Vec3 normal;
        double near_cosine = 0, far_cosine = 0;
        /// Solid angle of the facet's normal over that of the far direction.
        double jacobian = 0;
    };
    std::optional<Facet> facet(const Vec3& near, const Vec3& far) const;
    double value_per_sr(const Vec3& near, const Vec3& far) const;

    Parameters parameters_;
    FacetSide side_;
    double ior_;  ///< far over near
    Ggx facets_;
    AlbedoTable once_, lost_near_, lost_far_;
    double lost_share_;
    Carried carried_;
    double concentration_ = 0;
};

}  // namespace stilb::materials
