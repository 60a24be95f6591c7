// Sections of Radiance's scene.rad. Radiance is radiometric: luminances and intensities are divided by
// 179 lm/W.
#pragma once

#include <string>

#include "io/export/parts.h"
#include "io/text/radiance_units.h"

namespace stilb::io::exporting {

/// One primitive: "modifier type name", the texts and the numbers.
std::string radiance_primitive(std::string_view modifier, std::string_view type, std::string_view name,
                               const std::vector<std::string>& texts, const std::vector<double>& numbers);

/// A material of this name. Warns where the model is not equal.
std::string radiance_material(const NamedMaterial& material, const std::string& id, Output& output);

/// A light that is not on a surface, with the files that it needs.
std::string radiance_light(const Scene& scene, const Light& light, const std::string& id, Output& output);
/// The surface of a luminaire's opening, with whole faces: rtrace samples triangles badly.
std::string radiance_opening(const Shape& shape, const std::string& modifier, const std::string& name);

/// The content of luminaire.cal: angles for tables over C and gamma. A1 to A9 are the axes of a luminaire
/// towards C0, C90 and the nadir.
extern const std::string_view kLuminaireFunctions;

}  // namespace stilb::io::exporting
