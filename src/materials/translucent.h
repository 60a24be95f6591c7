// Paper, opal covers, lamp shades: thin sheets that scatter the light that they let through.
#pragma once

#include <vector>

#include "materials/diffuse.h"
#include "materials/material.h"
#include "materials/straight.h"

namespace stilb::materials {

/// Reflects and transmits diffusely, f = reflectance / pi and transmittance / pi, and lets a share of the
/// light pass straight. Radiance's trans without its gloss.
class Translucent {
  public:
    struct Parameters {
        Rgb reflectance;
        Rgb transmittance;
        Rgb specular_transmittance;

        static constexpr auto fields() {
            return std::tuple{
                Field{"reflectance", &Parameters::reflectance, kReflectance,
                      "share of the light that is reflected, diffusely"},
                Field{"transmittance", &Parameters::transmittance, kReflectance,
                      "share of the light that is transmitted, diffusely"},
                Field{"specular_transmittance", &Parameters::specular_transmittance, kReflectance,
                      "share of the light that passes straight", Presence::optional}};
        }
        std::optional<std::string> contradiction() const {
            return contradiction_of_shares(reflectance + transmittance, specular_transmittance,
                                           "reflectance + transmittance + specular_transmittance");
        }
        bool transmits_as(const Parameters& other) const {
            return transmittance == other.transmittance &&
                   specular_transmittance == other.specular_transmittance;
        }
    };
    static constexpr std::string_view kType = "translucent";

    explicit Translucent(const Parameters& parameters) : parameters_(parameters) {
        add({Diffuse{parameters.reflectance}, false});
        add({Diffuse{parameters.transmittance}, true});
        add({Straight{parameters.specular_transmittance}, false});
    }

    const Parameters& parameters() const { return parameters_; }
    std::span<const Lobe> lobes(LightSide, Carried) const { return lobes_; }
    Rgb reflectance_bound() const {
        return parameters_.reflectance + parameters_.transmittance + parameters_.specular_transmittance;
    }

  private:
    void add(const Lobe& lobe) {
        if (materials::reflectance_bound(lobe.scattering).max() > 0) lobes_.push_back(lobe);
    }

    Parameters parameters_;
    std::vector<Lobe> lobes_;
};

}  // namespace stilb::materials
