// What a material of glTF says about the light at its surface, and the material of Stilb that does the same.
#pragma once

#include <string>

#include "base/rgb.h"
#include "io/text/grouped_warnings.h"
#include "materials/material.h"

namespace stilb::io::gltf {

/// A material's quantities as means over its surface.
struct MeanSurface {
    Rgb base;
    double alpha = 1, metallic = 1, roughness = 1;
    double transmission = 0, ior = 1.5, specular = 1;
    bool is_solid = false;              ///< has a volume behind its surface
    Rgb color_of_solid = Rgb::grey(1);  ///< as Dielectric::color
    double distance_of_color_m = 1;
    bool is_unlit = false;
    bool is_blended = false;  ///< alphaMode BLEND
    Rgb emission_cd_m2;
};

/// Sets what the specular colour of a surface at normal incidence says beside its diffuse colour, `base`
/// (KHR_materials_pbrSpecularGlossiness): how much of it is metal, its base colour and its highlights.
void set_specular(const Rgb& specular, MeanSurface& surface);

/// Warns of what is left out; `name`: the material's.
Material material_of(const MeanSurface& surface, const std::string& name, GroupedWarnings& warnings);

/// Whether its material depends on the base colour.
bool shows_base(const MeanSurface& surface);

}  // namespace stilb::io::gltf
