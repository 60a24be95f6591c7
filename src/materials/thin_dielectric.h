// Panes: thin plane sheets of glass.
#pragma once

#include <cmath>

#include "materials/dielectric.h"
#include "materials/model.h"

namespace stilb::materials {

/// A thin plane sheet with parallel faces in air. Transmitted light continues straight; its lateral shift
/// is ignored.
struct ThinDielectric {
    double ior = 1.52;
    /// Share of the light that remains after one passage through the sheet along its normal, without the
    /// effect of the faces.
    Rgb internal_transmittance = Rgb::grey(1);

    static constexpr std::string_view kType = "pane";
    static constexpr auto fields() {
        return std::tuple{
            Field{"ior", &ThinDielectric::ior, kIor, "refractive index of the sheet"},
            Field{"internal_transmittance", &ThinDielectric::internal_transmittance, kReflectance,
                  "share of the light that one passage along the normal leaves, without the faces"}};
    }

    /// Shares of the flux that the sheet reflects and transmits.
    struct Shares {
        Rgb reflectance, transmittance;
    };
    /// Shares of unpolarised light at an angle of this cosine to the normal, with all inter-reflections: the
    /// mean of both polarisations, each with r of a face and a = internal_transmittance^(1/cos inside) having
    /// T = (1-r)^2 a / (1 - r^2 a^2) and R = r + r a T.
    Shares shares(double cosine) const {
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

    SpecularBranches branches(LightSide, const Vec3& in) const {
        const Shares divided = shares(in.z);
        SpecularBranches branches;
        branches.add({mirrored(in), divided.reflectance});
        branches.add({-in, divided.transmittance});
        return branches;
    }
    Rgb straight_transmittance(double cosine) const { return shares(cosine).transmittance; }
    Rgb reflectance_bound() const { return Rgb::grey(1); }

  private:
    struct OfOnePolarisation {
        double reflectance = 0, transmittance = 0;
    };
    /// `face`: reflectance of a face, `inside`: transmittance of a passage. If a face reflects everything, so
    /// does the sheet.
    static OfOnePolarisation with_inter_reflections(double face, double inside) {
        if (face >= 1) return {1, 0};
        const double transmittance = (1 - face) * (1 - face) * inside / (1 - face * face * inside * inside);
        return {face + face * inside * transmittance, transmittance};
    }
};

}  // namespace stilb::materials

namespace stilb {
using materials::ThinDielectric;
}  // namespace stilb
