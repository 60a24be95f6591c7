// Frosted glass: clear, with rough faces.
#pragma once

#include <array>
#include <vector>

#include "materials/facets/rough_interface.h"
#include "materials/material.h"

namespace stilb::materials {

inline constexpr Range kFrostedIor{1.01, 4, "from 1.01 to 4 (1.5 is common)"};

/// The surface of a solid, or a thin sheet. Absorbs nothing.
class Frosted {
  public:
    struct Parameters {
        double ior = 1.5;
        double roughness = 0.3;
        bool thin = false;
        double outside_ior = 1;  ///< as Dielectric::outside_ior

        static constexpr auto fields() {
            return std::tuple{
                Field{"ior", &Parameters::ior, kFrostedIor, "refractive index of the glass"},
                Field{"roughness", &Parameters::roughness, kRoughness, "alpha of GGX, of its faces"},
                Field{"thin", &Parameters::thin, kTruth,
                      "whether the surface is a sheet, and not that of a solid", Presence::optional}};
        }
    };
    static constexpr std::string_view kType = "frosted";

    explicit Frosted(const Parameters& parameters);

    const Parameters& parameters() const { return parameters_; }
    std::span<const Lobe> lobes(LightSide side, Carried carried) const {
        return lobes_[side == LightSide::outside ? 0 : 1][carried == Carried::flux ? 0 : 1];
    }
    Rgb reflectance_bound() const { return Rgb::grey(1); }

  private:
    void add_sheet();
    void add_solid();

    Parameters parameters_;
    std::array<std::array<std::vector<Lobe>, 2>, 2> lobes_;
};

}  // namespace stilb::materials
