// Smooth surfaces: mirror, solid glass, thin pane. Their reflection is made of delta functions: there is no
// BRDF to evaluate and no connection to them; light goes on in one direction or two.
#pragma once

#include <array>
#include <span>

#include "base/rgb.h"
#include "base/vec.h"

namespace stilb::materials {

/// Ideal mirror.
struct Mirror {
    Rgb reflectance;
};

/// The surface of a clear solid that stands in air. What a solid absorbs on the way is not handled.
struct Dielectric {
    double ior = 1.5;  ///< of the solid
};

/// A thin plane sheet with parallel faces in air.
struct ThinDielectric {
    double ior = 1.52;
    /// Share of the light that is left after one passage through the sheet along its normal, without what the
    /// faces do; in (0, 1].
    Rgb internal_transmittance = Rgb::grey(1);
};

/// From which side light comes to the surface: a solid's outside is where its normals point.
enum class LightSide { outside, inside };

/// One of the ways that light goes on.
struct SpecularBranch {
    Vec3 direction;  ///< unit, in the frame of `in`; below the surface where light goes through
    Rgb share;       ///< of the flux
    /// Luminance L, the quantity that paths from a sensor carry, is `share` times this of what it is on the
    /// other side: L / n^2 is kept in refraction, flux is kept as it is. With `in` as the direction that the
    /// path came by: (n of the side of `in` / n of the side of `direction`)^2; 1 in reflection.
    double luminance_factor = 1;
};

/// At most two, none of them dark.
class SpecularBranches {
  public:
    void add(const SpecularBranch& branch) {
        if (branch.share.max() > 0) branches_[count_++] = branch;
    }
    std::span<const SpecularBranch> list() const { return {branches_.data(), count_}; }

  private:
    std::array<SpecularBranch, 2> branches_;
    std::size_t count_ = 0;
};

/// The ways of light that comes to the surface against `in` (unit, z > 0, away from the surface on the side
/// that light comes from). Glass divides it by Fresnel's equations for unpolarised light and refracts by
/// Snell's law; a pane lets it pass straight on (what the sheet shifts it sideways is left out).
SpecularBranches specular_branches(const Mirror& material, LightSide side, const Vec3& in);
SpecularBranches specular_branches(const Dielectric& material, LightSide side, const Vec3& in);
SpecularBranches specular_branches(const ThinDielectric& material, LightSide side, const Vec3& in);

/// Shares of the flux that a pane reflects and lets pass.
struct PaneShares {
    Rgb reflectance, transmittance;
};
/// Of unpolarised light at an angle of this cosine to the normal, with all inter-reflections: the mean of
/// both polarisations, each with r of a face and a = internal_transmittance^(1/cos inside) having T = (1-r)^2
/// a / (1 - r^2 a^2) and R = r + r a T.
PaneShares pane_shares(const ThinDielectric& material, double cosine);

}  // namespace stilb::materials

namespace stilb {
using materials::Dielectric;
using materials::Mirror;
using materials::ThinDielectric;
}  // namespace stilb
