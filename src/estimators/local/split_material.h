// Materials as the sum of a diffuse part, whose reflected light a guess holds for all directions together,
// and the rest, the gloss.
#pragma once

#include <optional>

#include "materials/material.h"

namespace stilb::estimators {

struct SplitMaterial {
    Material diffuse;               ///< a Diffuse
    std::optional<Material> gloss;  ///< nothing where all reflection is diffuse

    const Rgb& diffuse_reflectance() const { return std::get<materials::Diffuse>(diffuse).reflectance; }
    Rgb gloss_reflectance() const { return gloss ? reflectance_bound(*gloss) : Rgb{}; }
    bool reflects() const { return diffuse_reflectance().max() > 0 || gloss; }
};

/// Models without a part that is equal in all directions are gloss as a whole.
SplitMaterial split(const Material& material);

}  // namespace stilb::estimators
