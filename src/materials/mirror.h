// The ideal mirror.
#pragma once

#include "materials/model.h"

namespace stilb::materials {

/// Reflects the same share of light at all angles.
struct Mirror {
    Rgb reflectance;

    static constexpr std::string_view kType = "mirror";
    static constexpr auto fields() {
        return std::tuple{
            Field{"reflectance", &Mirror::reflectance, kReflectance, "share of the light that is reflected"}};
    }

    SpecularBranches branches(LightSide, const Vec3& in) const {
        SpecularBranches branches;
        branches.add({mirrored(in), reflectance});
        return branches;
    }
    Rgb reflectance_bound() const { return reflectance; }
};

}  // namespace stilb::materials

namespace stilb {
using materials::Mirror;
}  // namespace stilb
