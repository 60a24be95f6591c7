// Materials of MTL files as materials of Stilb.
#pragma once

#include <map>
#include <string>

#include "io/import/obj/mtl_file.h"
#include "io/text/grouped_warnings.h"
#include "materials/material.h"

namespace stilb::io {

/// The material of a part of a surface where its diffuse reflectance is `diffuse`: of the type that fits the
/// values of `material`, which are means over the surface. Warns of values that have no equal.
Material mtl_surface(const MtlMaterial& material, const Rgb& diffuse, GroupedWarnings& warnings);

/// Sets `has_usual_specular` of all materials of a scene.
void find_usual_specular(std::map<std::string, MtlMaterial>& materials);

/// Whether it depends on the diffuse reflectance.
bool shows_diffuse(const MtlMaterial& material);

}  // namespace stilb::io
