#include "io/import/gltf/gltf_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "io/import/coated_surface.h"

namespace stilb::io::gltf {
namespace {

/// Extensions of materials that are read, wholly or with a warning of their own.
constexpr std::array<std::string_view, 7> kMaterialExtensions{"KHR_materials_transmission",
                                                              "KHR_materials_ior",
                                                              "KHR_materials_specular",
                                                              "KHR_materials_volume",
                                                              "KHR_materials_emissive_strength",
                                                              "KHR_materials_unlit",
                                                              "KHR_texture_transform"};

/// A material's quantities as means over its surface.
struct MeanSurface {
    Rgb base;
    double alpha = 1, metallic = 1, roughness = 1;
    double transmission = 0, ior = 1.5, specular = 1;
    bool is_solid = false;  ///< has a volume behind its surface
    bool is_unlit = false;
    Rgb emission_cd_m2;
};

class MaterialReader {
  public:
    MaterialReader(File& file, const std::vector<PlacedPrimitive>& primitives, ImportedScene& scene)
        : file_(file), primitives_(primitives), scene_(scene), textures_(file, scene.warnings) {}

    std::optional<MaterialId> add(int index) {
        if (index < 0) return add_default();
        const tinygltf::Material& material = file_.model.materials[static_cast<std::size_t>(index)];
        part_ = fmt::format("materials[{}]", index);
        name_ = material.name.empty() ? fmt::format("material_{}", index) : material.name;
        const MeanSurface surface = means(material, SurfacePoints(primitives_, index));
        warn_of_extensions(material);
        if (is_invisible(material, surface)) return std::nullopt;
        const MaterialId id = scene_.add_material(name_, convert(material, surface));
        if (surface.emission_cd_m2.luminance() > 0)
            scene_.set_emission(id, {surface.emission_cd_m2, material.doubleSided});
        return id;
    }

  private:
    MaterialId add_default() {
        scene_.warnings.add("material", "default",
                            "surfaces without a material would be a white metal that reflects all light; a "
                            "diffuse reflectance of 0.5 is used.");
        return scene_.add_material("default", Diffuse{Rgb::grey(0.5)});
    }

    void warn(std::string_view message) { scene_.warnings.add("material", name_, message); }

    double checked(double value, double least, double most, std::string_view key) const {
        if (!(value >= least && value <= most))
            file_.fail(part_, fmt::format("{} is {}. Allowed: from {} to {}.", key, value, least, most));
        return value;
    }

    Rgb checked(const Rgb& rgb, double most, std::string_view key) const {
        for (const double band : rgb.band) checked(band, 0, most, key);
        return rgb;
    }

    MeanSurface means(const tinygltf::Material& material, const SurfacePoints& points) {
        const tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
        MeanSurface surface;
        const auto colour = textures_.mean(pbr.baseColorTexture, true, points, part_);
        const auto rough = textures_.mean(pbr.metallicRoughnessTexture, false, points, part_);
        surface.base = checked(rgb_of(pbr.baseColorFactor, Rgb::grey(1)), 1, "baseColorFactor") *
                       Rgb{{colour[0], colour[1], colour[2]}};
        if (pbr.baseColorFactor.size() == 4)
            surface.alpha = checked(pbr.baseColorFactor[3], 0, 1, "baseColorFactor") * colour[3];
        surface.metallic = checked(pbr.metallicFactor, 0, 1, "metallicFactor") * rough[2];
        surface.roughness = checked(pbr.roughnessFactor, 0, 1, "roughnessFactor") * rough[1];
        read_extensions(material, points, surface);
        read_emission(material, points, surface);
        if (material.normalTexture.index >= 0)
            warn("its normalTexture is left out: the surface is as smooth as its mesh.");
        return surface;
    }

    void read_extensions(const tinygltf::Material& material, const SurfacePoints& points,
                         MeanSurface& surface) {
        if (const auto* table = find_extension(material.extensions, "KHR_materials_ior")) {
            const double ior = number_in(*table, "ior", 1.5);
            if (ior == 0)
                warn("an ior of 0 (a reflectance of 1 at all angles) has no equal; 1.5 is used.");
            else
                surface.ior = checked(ior, 1, 1e3, "ior");
        }
        if (const auto* table = find_extension(material.extensions, "KHR_materials_specular")) {
            const auto share = textures_.mean(texture_in(*table, "specularTexture"), false, points, part_);
            const auto tint = textures_.mean(texture_in(*table, "specularColorTexture"), true, points, part_);
            const Rgb colour =
                rgb_in(*table, "specularColorFactor", Rgb::grey(1)) * Rgb{{tint[0], tint[1], tint[2]}};
            surface.specular = checked(number_in(*table, "specularFactor", 1), 0, 1, "specularFactor") *
                               share[3] * checked(colour, 1e3, "specularColorFactor").luminance();
            if (colour.max() - colour.min() > 1e-3)
                warn("the colour of its highlights (specularColorFactor) is left out; their mean is kept.");
        }
        if (const auto* table = find_extension(material.extensions, "KHR_materials_transmission")) {
            const auto share =
                textures_.mean(texture_in(*table, "transmissionTexture"), false, points, part_);
            surface.transmission =
                checked(number_in(*table, "transmissionFactor", 0), 0, 1, "transmissionFactor") * share[0];
        }
        if (const auto* table = find_extension(material.extensions, "KHR_materials_volume")) {
            surface.is_solid = number_in(*table, "thicknessFactor", 0) > 0;
            if (surface.is_solid && table->Has("attenuationDistance"))
                warn("absorption inside of the solid (attenuationDistance) is left out.");
        }
        surface.is_unlit = material.extensions.contains("KHR_materials_unlit");
    }

    void read_emission(const tinygltf::Material& material, const SurfacePoints& points,
                       MeanSurface& surface) {
        const Rgb factor = checked(rgb_of(material.emissiveFactor, Rgb{}), 1e15, "emissiveFactor");
        if (!(factor.max() > 0)) return;
        const auto colour = textures_.mean(material.emissiveTexture, true, points, part_);
        double strength_cd_m2 = 1;
        const auto* table = find_extension(material.extensions, "KHR_materials_emissive_strength");
        if (table != nullptr)
            strength_cd_m2 = checked(number_in(*table, "emissiveStrength", 1), 0, 1e15, "emissiveStrength");
        surface.emission_cd_m2 = strength_cd_m2 * (factor * Rgb{{colour[0], colour[1], colour[2]}});
        if (table == nullptr && surface.emission_cd_m2.luminance() > 0) {
            warn(fmt::format(
                "it emits {:.3g} cd/m2, because it has no KHR_materials_emissive_strength; such a "
                "surface is hardly a lamp.",
                surface.emission_cd_m2.luminance()));
        }
    }

    void warn_of_extensions(const tinygltf::Material& material) {
        for (const auto& [name, value] : material.extensions) {
            if (std::ranges::find(kMaterialExtensions, name) == kMaterialExtensions.end())
                warn(fmt::format("its extension {} is left out.", name));
        }
    }

    bool is_invisible(const tinygltf::Material& material, const MeanSurface& surface) {
        constexpr double kFaintest = 0.02;
        if (material.alphaMode == "MASK" && surface.alpha < material.alphaCutoff) {
            warn("its mean alpha is below alphaCutoff; its surfaces are left out.");
            return true;
        }
        if (material.alphaMode != "BLEND" || surface.alpha >= kFaintest) return false;
        warn("its alpha is nearly 0; its surfaces are left out.");
        return true;
    }

    Material convert(const tinygltf::Material& material, const MeanSurface& surface) {
        constexpr double kOpaque = 0.98;
        if (surface.is_unlit) {
            warn(
                "KHR_materials_unlit is for drawings without light; a diffuse surface of its colour is "
                "used.");
            return Diffuse{surface.base};
        }
        if (surface.transmission > 0) {
            if (surface.transmission >= 0.5) return transparent(surface);
            warn(fmt::format("its transmission of {:.2g} is left out: the surface is opaque.",
                             surface.transmission));
        } else if (material.alphaMode == "BLEND" && surface.alpha < kOpaque) {
            warn(
                fmt::format("alphaMode BLEND becomes a clear pane that transmits {:.2g}; the light that it "
                            "would reflect diffusely is absorbed.",
                            1 - surface.alpha));
            return sheet(reflectance_of_coat(surface), Rgb::grey(1 - surface.alpha));
        }
        return opaque(surface);
    }

    static double reflectance_of_coat(const MeanSurface& surface) {
        return std::min(surface.specular * normal_reflectance(surface.ior), 1.0);
    }

    Material transparent(const MeanSurface& surface) {
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
            if (base.min() < 0.99) warn("the colour of the solid glass is left out.");
            return Dielectric{std::clamp(surface.ior, 1.0, 4.0)};
        }
        return sheet(reflectance_of_coat(surface), surface.transmission * surface.base);
    }

    Material opaque(const MeanSurface& surface) {
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
    Material blend(const MeanSurface& surface, double coat, double alpha) {
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

    File& file_;
    const std::vector<PlacedPrimitive>& primitives_;
    ImportedScene& scene_;
    Textures textures_;
    std::string part_, name_;
};

}  // namespace

std::map<int, MaterialId> add_materials(File& file, const std::vector<PlacedPrimitive>& primitives,
                                        ImportedScene& scene) {
    std::set<int> used;
    for (const PlacedPrimitive& primitive : primitives) {
        if (primitive.material >= 0)
            element(file, file.model.materials, primitive.material, "materials", "a primitive of a mesh");
        used.insert(primitive.material);
    }
    MaterialReader reader(file, primitives, scene);
    std::map<int, MaterialId> materials;
    for (const int index : used) {
        if (const auto id = reader.add(index)) materials[index] = *id;
    }
    return materials;
}

}  // namespace stilb::io::gltf
