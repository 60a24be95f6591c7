// Panes: thin plane sheets of glass.
#pragma once

#include "materials/model.h"

namespace stilb::materials {

/// A thin plane sheet with parallel faces in air. What passes goes straight on; what the sheet shifts it
/// sideways is left out.
struct ThinDielectric {
    double ior = 1.52;
    /// Share of the light that is left after one passage through the sheet along its normal, without what the
    /// faces do.
    Rgb internal_transmittance = Rgb::grey(1);

    static constexpr std::string_view kType = "pane";
    static constexpr auto fields() {
        return std::tuple{
            Field{"ior", &ThinDielectric::ior, kIor, "refractive index of the sheet"},
            Field{"internal_transmittance", &ThinDielectric::internal_transmittance, kReflectance,
                  "share of the light that one passage along the normal leaves, without the faces"}};
    }

    /// Shares of the flux that the sheet reflects and lets pass.
    struct Shares {
        Rgb reflectance, transmittance;
    };
    /// Of unpolarised light at an angle of this cosine to the normal, with all inter-reflections: the mean of
    /// both polarisations, each with r of a face and a = internal_transmittance^(1/cos inside) having T =
    /// (1-r)^2 a / (1 - r^2 a^2) and R = r + r a T.
    Shares shares(double cosine) const;

    SpecularBranches branches(LightSide, const Vec3& in) const;
    Rgb straight_transmittance(double cosine) const { return shares(cosine).transmittance; }
    Rgb reflectance_bound() const { return Rgb::grey(1); }
};

}  // namespace stilb::materials

namespace stilb {
using materials::ThinDielectric;
}  // namespace stilb
