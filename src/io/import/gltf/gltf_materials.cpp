#include "io/import/gltf/gltf_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "io/import/gltf/gltf_surface.h"

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

class MaterialReader {
  public:
    MaterialReader(File& file, const std::vector<PlacedPrimitive>& primitives, bool shows_textures,
                   ImportedScene& scene)
        : file_(file),
          primitives_(primitives),
          shows_textures_(shows_textures),
          scene_(scene),
          textures_(file, scene.warnings) {}

    std::optional<SurfaceMaterial> add(int index) {
        if (index < 0) return SurfaceMaterial{add_default(), {}};
        const tinygltf::Material& material = file_.model.materials[static_cast<std::size_t>(index)];
        part_ = fmt::format("materials[{}]", index);
        name_ = material.name.empty() ? fmt::format("material_{}", index) : material.name;
        const MeanSurface surface = means(material, SurfacePoints(primitives_, index));
        warn_of_extensions(material);
        std::optional<FaceTexture> texture = face_texture(material, surface);
        if (!texture && is_invisible(material, surface)) return std::nullopt;
        SurfaceMaterial added{scene_.add_material(name_, material_of(surface, name_, scene_.warnings)), {}};
        if (surface.emission_cd_m2.luminance() > 0)
            scene_.set_emission(added.id, {surface.emission_cd_m2, material.doubleSided});
        if (texture) {
            scene_.set_texture(added.id, std::move(*texture));
            added.texture = uv_transform(material.pbrMetallicRoughness.baseColorTexture);
        }
        return added;
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

    Rgb base_factor(const tinygltf::Material& material) const {
        const Rgb factor = rgb_of(material.pbrMetallicRoughness.baseColorFactor, Rgb::grey(1));
        return checked(factor, 1, "baseColorFactor");
    }

    MeanSurface means(const tinygltf::Material& material, const SurfacePoints& points) {
        const tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
        MeanSurface surface;
        const auto colour = textures_.mean(pbr.baseColorTexture, true, points, part_);
        const auto rough = textures_.mean(pbr.metallicRoughnessTexture, false, points, part_);
        surface.base = base_factor(material) * Rgb{{colour[0], colour[1], colour[2]}};
        surface.is_blended = material.alphaMode == "BLEND";
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

    /// The texture of the base colour; nothing where its mean counts.
    std::optional<FaceTexture> face_texture(const tinygltf::Material& material, const MeanSurface& surface) {
        const std::optional<TextureMap> map =
            textures_.map_of(material.pbrMetallicRoughness.baseColorTexture, part_);
        if (!map) return std::nullopt;
        if (!shows_textures_) {
            scene_.remark_mean_texture(name_);
            return std::nullopt;
        }
        if (surface.emission_cd_m2.luminance() > 0 || !shows_base(surface)) {
            warn("it shines or is transparent: its texture counts by its mean.");
            return std::nullopt;
        }
        const std::vector<double>& factors = material.pbrMetallicRoughness.baseColorFactor;
        const double alpha = factors.size() == 4 ? factors[3] : 1;
        const double least_alpha = material.alphaMode == "MASK" ? material.alphaCutoff / alpha : 0;
        return FaceTexture{{*map, least_alpha},
                           [surface, factor = base_factor(material), name = name_](const Rgb& colour) {
                               MeanSurface face = surface;
                               face.base = factor * colour;
                               GroupedWarnings as_of_the_mean;  // which the scene has already
                               return material_of(face, name, as_of_the_mean);
                           }};
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

    File& file_;
    const std::vector<PlacedPrimitive>& primitives_;
    bool shows_textures_;
    ImportedScene& scene_;
    Textures textures_;
    std::string part_, name_;
};

}  // namespace

std::map<int, SurfaceMaterial> add_materials(File& file, const std::vector<PlacedPrimitive>& primitives,
                                             bool shows_textures, ImportedScene& scene) {
    std::set<int> used;
    for (const PlacedPrimitive& primitive : primitives) {
        if (primitive.material >= 0)
            element(file, file.model.materials, primitive.material, "materials", "a primitive of a mesh");
        used.insert(primitive.material);
    }
    MaterialReader reader(file, primitives, shows_textures, scene);
    std::map<int, SurfaceMaterial> materials;
    for (const int index : used) {
        if (const auto material = reader.add(index)) materials[index] = *material;
    }
    return materials;
}

}  // namespace stilb::io::gltf
