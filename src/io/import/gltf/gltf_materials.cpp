#include "io/import/gltf/gltf_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "io/import/gltf/gltf_surface.h"
#include "materials/dielectric.h"
#include "materials/diffuse.h"

namespace stilb::io::gltf {
namespace {

constexpr const char* kSpecularGlossiness = "KHR_materials_pbrSpecularGlossiness";

/// What a texture counts as that cannot be read: a surface of medium reflectance, no metal.
constexpr std::array<double, 4> kUnreadColour{0.5, 0.5, 0.5, 1}, kUnreadRoughness{1, 1, 0, 1};

/// The colour of a surface, and its alpha.
struct BaseColour {
    tinygltf::TextureInfo texture;
    Rgb factor;
    double alpha = 1;
};

/// Extensions of materials that are read, wholly or with a warning of their own.
constexpr std::array<std::string_view, 8> kMaterialExtensions{
    "KHR_materials_transmission", kSpecularGlossiness,    "KHR_materials_ior",
    "KHR_materials_specular",     "KHR_materials_volume", "KHR_materials_emissive_strength",
    "KHR_materials_unlit",        "KHR_texture_transform"};

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
        const BaseColour base = base_of(material);
        SurfacePoints points(primitives_, index);
        std::optional<MaskedTexture> map = base_map(material, base);
        const double covered = map ? points.leave_holes_out(*map, uv_transform(base.texture)) : 1;
        MeanSurface surface = means(material, base, points);
        if (map && map->least_alpha > 0) surface.is_blended = false;
        warn_of_extensions(material);
        if (!(covered > 0) || is_invisible(material, surface)) {
            warn("its alpha is nearly 0 or below alphaCutoff; its surfaces are left out.");
            return std::nullopt;
        }
        std::optional<FaceTexture> texture;
        if (map) texture = face_texture(std::move(*map), base, surface, covered);
        SurfaceMaterial added{scene_.add_material(name_, material_of(surface, name_, scene_.warnings)), {}};
        if (surface.emission_cd_m2.luminance() > 0)
            scene_.set_emission(added.id, {surface.emission_cd_m2, material.doubleSided});
        if (texture) {
            scene_.set_texture(added.id, std::move(*texture));
            added.texture = uv_transform(base.texture);
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

    BaseColour base_of(const tinygltf::Material& material) const {
        if (const auto* table = find_extension(material.extensions, kSpecularGlossiness)) {
            const std::vector<double> factors = numbers_in(*table, "diffuseFactor");
            return {texture_in(*table, "diffuseTexture"), factor_of(factors, "diffuseFactor"),
                    alpha_of(factors, "diffuseFactor")};
        }
        const tinygltf::PbrMetallicRoughness& pbr = material.pbrMetallicRoughness;
        return {pbr.baseColorTexture, factor_of(pbr.baseColorFactor, "baseColorFactor"),
                alpha_of(pbr.baseColorFactor, "baseColorFactor")};
    }

    Rgb factor_of(const std::vector<double>& factors, std::string_view key) const {
        return checked(rgb_of(factors, Rgb::grey(1)), 1, key);
    }
    double alpha_of(const std::vector<double>& factors, std::string_view key) const {
        return factors.size() == 4 ? checked(factors[3], 0, 1, key) : 1;
    }

    MeanSurface means(const tinygltf::Material& material, const BaseColour& base,
                      const SurfacePoints& points) {
        MeanSurface surface;
        const auto colour = textures_.mean(base.texture, Texels::colours, points, part_, kUnreadColour);
        surface.base = base.factor * Rgb{{colour[0], colour[1], colour[2]}};
        surface.is_blended = material.alphaMode == "BLEND";
        surface.alpha = base.alpha * colour[3];
        if (const auto* table = find_extension(material.extensions, kSpecularGlossiness))
            read_specular_glossiness(*table, points, surface);
        else
            read_metal(material.pbrMetallicRoughness, points, surface);
        read_extensions(material, points, surface);
        read_emission(material, points, surface);
        if (material.normalTexture.index >= 0)
            warn("its normalTexture is left out: the surface is as smooth as its mesh.");
        return surface;
    }

    void read_metal(const tinygltf::PbrMetallicRoughness& pbr, const SurfacePoints& points,
                    MeanSurface& surface) {
        const auto rough =
            textures_.mean(pbr.metallicRoughnessTexture, Texels::numbers, points, part_, kUnreadRoughness);
        surface.metallic = checked(pbr.metallicFactor, 0, 1, "metallicFactor") * rough[2];
        surface.roughness = checked(pbr.roughnessFactor, 0, 1, "roughnessFactor") * rough[1];
    }

    void read_specular_glossiness(const tinygltf::Value& table, const SurfacePoints& points,
                                  MeanSurface& surface) {
        constexpr std::array<double, 4> unread{0.04, 0.04, 0.04, 0.5};  // like plastic, half glossy
        const auto map = textures_.mean(texture_in(table, "specularGlossinessTexture"), Texels::colours,
                                        points, part_, unread);
        const Rgb specular = checked(rgb_in(table, "specularFactor", Rgb::grey(1)), 1, "specularFactor") *
                             Rgb{{map[0], map[1], map[2]}};
        const double glossiness =
            checked(number_in(table, "glossinessFactor", 1), 0, 1, "glossinessFactor") * map[3];
        surface.roughness = 1 - glossiness;
        set_specular(specular, surface);
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
            const auto share =
                textures_.mean(texture_in(*table, "specularTexture"), Texels::numbers, points, part_);
            const auto tint =
                textures_.mean(texture_in(*table, "specularColorTexture"), Texels::colours, points, part_);
            const Rgb colour =
                rgb_in(*table, "specularColorFactor", Rgb::grey(1)) * Rgb{{tint[0], tint[1], tint[2]}};
            surface.specular = checked(number_in(*table, "specularFactor", 1), 0, 1, "specularFactor") *
                               share[3] * checked(colour, 1e3, "specularColorFactor").luminance();
            if (colour.max() - colour.min() > 1e-3)
                warn("the colour of its highlights (specularColorFactor) is left out; their mean is kept.");
        }
        if (const auto* table = find_extension(material.extensions, "KHR_materials_transmission")) {
            const auto share =
                textures_.mean(texture_in(*table, "transmissionTexture"), Texels::numbers, points, part_);
            const double factor =
                checked(number_in(*table, "transmissionFactor", 0), 0, 1, "transmissionFactor") * share[0];
            surface.transmission = (1 - surface.metallic) * factor;
            if (surface.transmission < factor)
                warn(
                    "its transmission is that of its share without metal, because metals transmit no light.");
        }
        if (const auto* table = find_extension(material.extensions, "KHR_materials_volume")) {
            surface.is_solid = number_in(*table, "thicknessFactor", 0) > 0;
            if (table->Has("attenuationDistance")) {
                const Range &share = materials::kColorOfSolid, &distance_m = materials::kDistanceOfColor;
                surface.color_of_solid =
                    checked(rgb_in(*table, "attenuationColor", Rgb::grey(1)), 1, "attenuationColor");
                for (double& band : surface.color_of_solid.band) band = std::max(band, share.min);
                surface.distance_of_color_m = checked(number_in(*table, "attenuationDistance", 1),
                                                      distance_m.min, distance_m.max, "attenuationDistance");
            }
        }
        surface.is_unlit = material.extensions.contains("KHR_materials_unlit");
    }

    void read_emission(const tinygltf::Material& material, const SurfacePoints& points,
                       MeanSurface& surface) {
        const Rgb factor = checked(rgb_of(material.emissiveFactor, Rgb{}), 1e15, "emissiveFactor");
        if (!(factor.max() > 0)) return;
        const auto colour = textures_.mean(material.emissiveTexture, Texels::colours, points, part_);
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

    /// The texture of the base colour, in which alpha may cut holes; nothing where there is none.
    std::optional<MaskedTexture> base_map(const tinygltf::Material& material, const BaseColour& base) {
        std::optional<TextureMap> map = textures_.map_of(base.texture, part_);
        if (!map) return std::nullopt;
        MaskedTexture masked{std::move(*map)};
        constexpr double half = 0.5;
        if (material.alphaMode == "MASK")
            masked.least_alpha = material.alphaCutoff / base.alpha;
        else if (material.alphaMode == "BLEND" && base.alpha >= 1 && has_holes(*masked.map.picture))
            masked.least_alpha = half;
        return masked;
    }

    /// What the texture of the base colour changes on the faces: nothing where its mean counts and it has no
    /// holes.
    std::optional<FaceTexture> face_texture(MaskedTexture map, const BaseColour& base,
                                            const MeanSurface& surface, double covered) {
        map.shows_colours = shows_textures_;
        if (!shows_textures_) {
            scene_.remark_mean_texture(name_);
        } else if (surface.emission_cd_m2.luminance() > 0 || !shows_base(surface)) {
            warn("it shines or is transparent: its texture counts by its mean.");
            map.shows_colours = false;
        }
        if (!map.shows_colours && covered >= 1) return std::nullopt;
        return FaceTexture{std::move(map), [surface, factor = base.factor, name = name_](const Rgb& colour) {
                               MeanSurface face = surface;
                               face.base = factor * colour;
                               GroupedWarnings as_of_the_mean;  // which the scene has already
                               return material_of(face, name, as_of_the_mean);
                           }};
    }

    static bool is_invisible(const tinygltf::Material& material, const MeanSurface& surface) {
        constexpr double kFaintest = 0.02;
        if (material.alphaMode == "MASK") return surface.alpha < material.alphaCutoff;
        return surface.is_blended && surface.alpha < kFaintest;
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
