#include "io/import/obj/mtl_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/import/coated_surface.h"
#include "materials/diffuse.h"
#include "materials/mirror.h"
#include "materials/phong.h"
#include "materials/rough_conductor.h"

namespace stilb::io {
namespace {

constexpr double kDark = 0.1;

Rgb at_most_one(const Rgb& rgb) {
    return {{std::min(rgb[0], 1.0), std::min(rgb[1], 1.0), std::min(rgb[2], 1.0)}};
}

class MtlConversion {
  public:
    MtlConversion(const std::string& name, GroupedWarnings& warnings) : name_(name), warnings_(warnings) {}

    Material convert(const MtlMaterial& material, const Rgb& reflectance) const {
        const double ior = std::clamp(material.ior.value_or(1.5), 1.0, 4.0);
        const Rgb diffuse = share(reflectance, "Kd");
        if (!shows_diffuse(material)) {
            if (material.illum && (*material.illum == 6 || *material.illum == 7)) {
                warn(
                    "illum with refraction becomes a thin pane, because an OBJ file does not say whether the "
                    "body is solid.");
            }
            warn(fmt::format(
                "its opacity of {:.2g} (d, Tr) makes it a clear pane; the light that it would reflect "
                "diffusely is absorbed.",
                material.opacity));
            return sheet(normal_reflectance(ior), (1 - material.opacity) * share(material.filter, "Tf"));
        }
        const Rgb specular = share(material.specular, "Ks");
        if (material.metallic && *material.metallic > 0.5) {
            const double alpha = std::pow(material.roughness.value_or(0.5), 2);
            return RoughConductor({diffuse, std::max(alpha, materials::kRoughness.min)});
        }
        if (!(specular.max() > 0) || (material.illum && *material.illum < 2)) return Diffuse{diffuse};
        return glossy(material, diffuse, specular, ior);
    }

  private:
    void warn(std::string_view message) const { warnings_.add("material", name_, message); }

    Rgb share(const Rgb& rgb, std::string_view key) const {
        if (rgb.max() > 1) warn(fmt::format("{} is above 1; 1 is used.", key));
        return at_most_one(rgb);
    }

    Material glossy(const MtlMaterial& material, const Rgb& diffuse, const Rgb& specular, double ior) const {
        const Rgb mean = at_most_one(material.diffuse);  // decides, so that all parts are of one type
        constexpr double kMirrorExponent = 1e5;
        // Many programs write 0.5 for every material: how bright its highlights look, not a share of light.
        constexpr double kLargestShare = 0.25;
        const double exponent = std::min(material.exponent, 1e6);
        if (mean.max() <= 0 && exponent >= kMirrorExponent) return Mirror{specular};
        const bool is_share =
            specular.max() <= kLargestShare || (mean.max() <= kDark && !material.has_usual_specular);
        if (is_share && (mean + specular).max() <= 1) {
            Rgb rest;
            for (std::size_t b = 0; b < kBands; ++b) rest[b] = std::min(diffuse[b], 1 - specular[b]);
            return Phong{rest, specular, exponent};
        }
        warn(fmt::format(
            "its Ks is too large for a share of light beside its Kd; a coat of ior {:.3g} over Kd is "
            "used (type plastic).",
            ior));
        return plastic_returning(diffuse, std::max(ior, 1.01), std::sqrt(2 / (exponent + 2)));
    }

    const std::string& name_;
    GroupedWarnings& warnings_;
};

}  // namespace

Material mtl_surface(const MtlMaterial& material, const Rgb& diffuse, GroupedWarnings& warnings) {
    return MtlConversion(material.name, warnings).convert(material, diffuse);
}

void find_usual_specular(std::map<std::string, MtlMaterial>& materials) {
    for (auto& entry : materials) {
        MtlMaterial& material = entry.second;
        material.has_usual_specular = std::ranges::any_of(materials, [&](const auto& one) {
            const MtlMaterial& other = one.second;
            return other.specular == material.specular && other.diffuse.max() > kDark && shows_diffuse(other);
        });
    }
}

bool shows_diffuse(const MtlMaterial& material) {
    constexpr double opaque = 0.98;
    return material.opacity >= opaque;
}

}  // namespace stilb::io
