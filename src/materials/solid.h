// Surfaces that bound a solid: glass, smooth or frosted.
#pragma once

#include <optional>

#include "materials/dielectric.h"
#include "materials/material.h"

namespace stilb::materials {

/// The medium inside of the solid; nothing for surfaces that bound none.
std::optional<Medium> medium_inside(const Material& material);
/// That around it; only for surfaces that bound a solid, as the functions below.
Medium medium_outside(const Material& material);
/// The same surface between other media.
Material between_media(const Material& material, const Medium& inside, const Medium& outside);
/// A thin sheet with two such faces.
Material sheet_of(const Material& material);
/// The share of the light that is not absorbed on a path of this length, which ends at the surface on this
/// side: 1, unless the surface is smooth and the medium there absorbs.
Rgb left_on_the_way(const Material& material, LightSide side, double way_m);

}  // namespace stilb::materials
