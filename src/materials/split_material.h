// Materials as the sum of a part that reflects equally in all directions, whose light one number can hold,
// and the rest, the gloss. The diffuse reflection of RoughConductor and Plastic depends on both angles: with
// them all is gloss.
#pragma once

#include <optional>

#include "materials/material.h"

namespace stilb::materials {

struct SplitMaterial {
    /// Of a translucent sheet: diffuse reflectance and transmittance together.
    Rgb diffuse_reflectance;
    Material diffuse;               ///< a Diffuse of this reflectance
    std::optional<Material> gloss;  ///< nothing where all reflection is diffuse
    Rgb transmitted{};  ///< the part of the diffuse reflectance that belongs to light from the other side

    Rgb gloss_reflectance() const { return gloss ? reflectance_bound(*gloss) : Rgb{}; }
    /// The share of the light of a side that is of light which arrives on the same side.
    Rgb own_share() const { return Rgb::grey(1) + -1 * other_share(); }
    Rgb other_share() const;
    bool reflects() const { return diffuse_reflectance.max() > 0 || gloss; }
};

SplitMaterial split(const Material& material);

}  // namespace stilb::materials
