// Surfaces that bound a clear solid: glass, smooth or frosted.
#pragma once

#include <optional>

#include "materials/material.h"

namespace stilb::materials {

/// The refractive index of the solid; nothing for surfaces that bound none.
std::optional<double> solid_ior(const Material& material);
/// That of the medium outside; only for surfaces that bound a solid, as all functions below.
double outside_ior(const Material& material);
/// The same surface between other media.
Material between_media(const Material& material, double inside_ior, double outside_ior);
/// A thin sheet with two such faces.
Material sheet_of(const Material& material);

}  // namespace stilb::materials
