#include "io/import/gltf/gltf_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/import/coated_surface.h"
#include "materials/dielectric.h"
#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/rough_conductor.h"
#include "materials/ward.h"

namespace stilb::io::gltf {
namespace {

constexpr double kOpaque = 0.98, kTransparent = 0.5;

bool is_clear_sheet(const MeanSurface& surface) {
    return surface.is_blended && surface.alpha < kOpaque && surface.transmission <= 0;
}

class SurfaceConversion {
  public:
    SurfaceConversion(const std::string& name, GroupedWarnings& warnings)
        : name_(name), warnings_(warnings) {}

    Material convert(const MeanSurface& surface) const {
        if (surface.is_unlit) {
            warn(
                "KHR_materials_unlit is for drawings without light; a diffuse surface of its colour is "
                "used.");
            return Diffuse{surface.base};
        }
        if (surface.transmission > 0) {
            if (surface.transmission >= kTransparent) return transparent(surface);
            warn(fmt::format("its transmission of {:.2g} is left out: the surface is opaque.",
                             surface.transmission));
        } else if (is_clear_sheet(surface)) {
            warn(
                fmt::format("alphaMode BLEND becomes a clear pane that transmits {:.2g}; the light that it "
                            "would reflect diffusely is absorbed.",
                            1 - surface.alpha));
            return sheet(reflectance_of_coat(surface), Rgb::grey(1 - surface.alpha));
        }
        return opaque(surface);
    }

  private:
    static double reflectance_of_coat(const MeanSurface& surface) {
        return std::min(surface.specular * normal_reflectance(surface.ior), 1.0);
    }

    Material transparent(const MeanSurface& surface) const {
        if (surface.transmission < 1) {
            warn(
                fmt::format("its transmission of {:.2g} becomes a clear pane of this transmittance; the "
                            "light that it would scatter is absorbed.",
                            surface.transmission));
        }
        constexpr double kClear = 0.05;
        if (surface.roughness * surface.roughness > kClear)
            warn("light passes it without being scattered: its roughness is left out.");
        if (surface.is_solid) {
            const Rgb& base = surface.base;
            if (base.min() < 0.99)
                warn("the base colour of the solid glass is left out; its attenuationColor is not.");
            return Dielectric{std::clamp(surface.ior, 1.0, 4.0), surface.color_of_solid,
                              surface.distance_of_color_m};
        }
        return sheet(reflectance_of_coat(surface), surface.transmission * surface.base);
    }

    Material opaque(const MeanSurface& surface) const {
        constexpr double kPure = 0.02;
        const double alpha = surface.roughness * surface.roughness;
        if (surface.metallic >= 1 - kPure) return metal(surface.base, alpha);
        const double coat = reflectance_of_coat(surface);
        if (surface.metallic > kPure) return blend(surface, coat, alpha);
        if (coat <= 0) return Diffuse{surface.base};
        if (coat > normal_reflectance(materials::kIor.max))
            warn("its highlights are stronger than those of ior 4, which is used.");
        const double ior = surface.specular == 1 ? surface.ior : ior_of_normal_reflectance(coat);
        return plastic_returning(surface.base, ior, alpha);
    }

    static Material metal(const Rgb& reflectance, double alpha) {
        if (alpha < materials::kRoughness.min) return Mirror{reflectance};
        return RoughConductor({reflectance, alpha});
    }

    /// Neither metal nor not: two shares of light, because no material of Stilb mixes its models.
    Material blend(const MeanSurface& surface, double coat, double alpha) const {
        constexpr double kWidestLobe = 0.3;  // wider lobes of this model lose light
        warn(
            fmt::format("it is a mixture of metal and no metal (metallic {:.2g}); a lobe over a diffuse base "
                        "(type ward) is used.",
                        surface.metallic));
        const double rest = 1 - surface.metallic;
        const Rgb specular = surface.metallic * surface.base + Rgb::grey(rest * coat);
        const double width = std::clamp(alpha, materials::kRoughness.min, kWidestLobe);
        return Ward({rest * (1 - coat) * surface.base, specular, {width, width}});
    }

    void warn(std::string_view message) const { warnings_.add("material", name_, message); }

    const std::string& name_;
    GroupedWarnings& warnings_;
};

}  // namespace

void set_specular(const Rgb& specular, MeanSurface& surface) {
    // Plastic reflects F + (1 - F) times its base, as the extension has it, for all F of its range of ior.
    // Metals reflect more at normal incidence, and have next to no diffuse colour.
    const double of_glass = normal_reflectance(surface.ior);
    if (specular.luminance() <= normal_reflectance(materials::kIor.max)) {
        surface.metallic = 0;
        surface.specular = specular.luminance() / of_glass;
        return;
    }
    surface.metallic = 1;
    surface.base = specular + (1 - specular.max()) * surface.base;
}

Material material_of(const MeanSurface& surface, const std::string& name, GroupedWarnings& warnings) {
    return SurfaceConversion(name, warnings).convert(surface);
}

bool shows_base(const MeanSurface& surface) {
    if (surface.is_unlit) return true;
    const bool is_solid_glass = surface.is_solid && surface.transmission >= kTransparent;
    return !is_solid_glass && !is_clear_sheet(surface);
}

}  // namespace stilb::io::gltf
