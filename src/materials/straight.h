// Light that goes on as if there were nothing: through the holes of a fabric, or a thin sheet.
#pragma once

#include "materials/model.h"

namespace stilb::materials {

/// A lobe of composed materials: the same share at all angles. The rest of the light is that of other lobes.
struct Straight {
    Rgb transmittance;

    static constexpr std::string_view kType = "straight";
    static constexpr auto fields() {
        return std::tuple{Field{"transmittance", &Straight::transmittance, kReflectance,
                                "share of the light that goes on"}};
    }

    SpecularBranches branches(LightSide, const Vec3& in) const {
        SpecularBranches branches;
        branches.add({-in, transmittance});
        return branches;
    }
    Rgb straight_transmittance(double) const { return transmittance; }
    Rgb reflectance_bound() const { return transmittance; }
};

}  // namespace stilb::materials
