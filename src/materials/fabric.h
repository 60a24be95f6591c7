// Woven shades, by what product sheets say of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "materials/diffuse.h"
#include "materials/material.h"
#include "materials/straight.h"

namespace stilb::materials {

/// Light passes straight through the holes, which narrow towards grazing angles (Straight), and the threads
/// scatter the rest of what is transmitted: diffusely, and the same share from all directions, as a
/// reciprocal surface must that scatters evenly.
class Fabric {
  public:
    struct Parameters {
        double openness = 0;
        Rgb transmittance;
        Rgb reflectance;

        static constexpr auto fields() {
            return std::tuple{
                Field{"openness", &Parameters::openness, kReflectance,
                      "share of the area that is holes: of the light along the normal that passes straight"},
                Field{"transmittance", &Parameters::transmittance, kReflectance,
                      "share of the light along the normal that is transmitted, straight or scattered"},
                Field{"reflectance", &Parameters::reflectance, kReflectance,
                      "share of the light that is reflected, diffusely"}};
        }
        std::optional<std::string> contradiction() const;
        bool transmits_as(const Parameters& other) const {
            return openness == other.openness && transmittance == other.transmittance;
        }
    };
    static constexpr std::string_view kType = "fabric";

    explicit Fabric(const Parameters& parameters);

    const Parameters& parameters() const { return parameters_; }
    std::span<const Lobe> lobes(LightSide, Carried) const { return lobes_; }
    Rgb reflectance_bound() const { return parameters_.reflectance + parameters_.transmittance; }

  private:
    Parameters parameters_;
    std::vector<Lobe> lobes_;
};

}  // namespace stilb::materials
