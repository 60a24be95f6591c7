// Panes by what data sheets say of them.
#pragma once

#include <optional>
#include <string>

#include "materials/model.h"
#include "materials/shares_by_angle.h"
#include "materials/thin_dielectric.h"

namespace stilb::materials {

/// What an uncoated pane of glass (kClearIor) transmits at most.
inline constexpr Range kVisibleTransmittance{
    0, 0.918,
    "from 0 to 0.918, which an uncoated pane transmits at most (other glazing has \"transmittance\")"};

/// A flat sheet, or a unit of several panes, that scatters nothing; light passes straight.
///
/// Shares are by angle, or along the normal alone: then their shape is that of the regressions of Roos and of
/// LBNL for coated glass, normalised at the normal, clear, or, up to a transmittance of 0.645, bronze
/// [EnergyPlus Engineering Reference, Window Calculation Module]. visible_transmittance is that of one
/// uncoated pane, which absorbs as much as this asks for.
class Glazing {
  public:
    struct Parameters {
        SharesByAngle visible_transmittance, transmittance, reflectance, back_reflectance;

        static constexpr auto fields() {
            return std::tuple{
                Field{"visible_transmittance", &Parameters::visible_transmittance, kVisibleTransmittance,
                      "share of the light along the normal that one uncoated pane transmits, in place of the "
                      "others",
                      Presence::optional},
                Field{"transmittance", &Parameters::transmittance, kReflectance,
                      "share that is transmitted, along the normal or by angle", Presence::optional},
                Field{"reflectance", &Parameters::reflectance, kReflectance,
                      "share that is reflected on the front, likewise", Presence::optional},
                Field{"back_reflectance", &Parameters::back_reflectance, kReflectance,
                      "the same on the back, if it differs", Presence::optional}};
        }
        std::optional<std::string> contradiction() const;
    };
    static constexpr std::string_view kType = "glazing";

    explicit Glazing(const Parameters& parameters);

    const Parameters& parameters() const { return parameters_; }
    SpecularBranches branches(LightSide side, const Vec3& in) const {
        SpecularBranches branches;
        branches.add({mirrored(in), reflectance(side, in.z)});
        branches.add({-in, straight_transmittance(in.z)});
        return branches;
    }
    /// An uncoated pane that transmits as much along the normal, or as much as such a pane can: what
    /// visible_transmittance stands for.
    ThinDielectric uncoated() const;
    Rgb straight_transmittance(double cosine) const;
    Rgb reflectance(LightSide side, double cosine) const;
    Rgb reflectance_bound() const { return Rgb::grey(1); }

  private:
    Parameters parameters_;
    std::optional<ThinDielectric> pane_;  ///< that visible_transmittance stands for
};

}  // namespace stilb::materials
