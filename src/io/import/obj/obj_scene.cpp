#include "io/import/obj/obj_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/mesh_part.h"
#include "io/image/texture_file.h"
#include "io/import/coated_surface.h"
#include "io/import/imported_scene.h"
#include "io/import/obj/mtl_file.h"
#include "io/import/obj/unit_guess.h"
#include "io/mesh/mesh_file.h"
#include "io/text/text.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

namespace fs = std::filesystem;

/// The paths that a statement mtllib names: one name with blanks, or several names.
std::vector<fs::path> library_paths(const std::string& statement, const fs::path& folder) {
    if (fs::exists(folder / statement)) return {folder / statement};
    std::vector<fs::path> paths;
    std::string_view rest = statement;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest))
        paths.push_back(folder / word);
    return paths;
}

class ObjMaterials {
  public:
    ObjMaterials(const MeshFile& mesh, const fs::path& folder, ImportedScene& scene)
        : folder_(folder), scene_(scene) {
        for (const std::string& statement : mesh.material_libraries) {
            for (const fs::path& path : library_paths(statement, folder)) read_library(path);
        }
    }

    /// The scene's material of a name in the OBJ file.
    MaterialId add(const std::string& name) {
        const auto known = materials_.find(name);
        name_ = name.empty() ? "default" : name;
        if (known == materials_.end()) {
            warn("no MTL file describes it; a diffuse reflectance of 0.5 is used.");
            return scene_.add_material(name_, Diffuse{Rgb::grey(0.5)});
        }
        MtlMaterial material = known->second;
        apply_pictures(material);
        for (const std::string& statement : material.ignored)
            warn(fmt::format("its statement {} is left out.", in_quotes(statement)));
        const MaterialId id = scene_.add_material(name_, convert(material));
        if (material.emission_cd_m2.luminance() > 0)
            scene_.set_emission(id, {material.emission_cd_m2, false});
        return id;
    }

  private:
    static constexpr double kOpaque = 0.98, kDark = 0.1;

    void warn(std::string_view message) { scene_.warnings.add("material", name_, message); }

    void read_library(const fs::path& path) {
        if (!fs::is_regular_file(path)) {
            scene_.warnings.add("file", in_quotes(path.string()), "this MTL file does not exist.");
            return;
        }
        scene_.file.sources.push_back(path);
        for (MtlMaterial& material : read_mtl(read_whole_file(path), path.string())) {
            const std::string name = material.name;
            materials_.try_emplace(name, std::move(material));
        }
    }

    /// The means of a picture; ones where there is none, or it cannot be read (which is a warning).
    std::array<double, 4> mean_of(std::string picture) {
        constexpr std::array<double, 4> ones{1, 1, 1, 1};
        if (picture.empty()) return ones;
        std::ranges::replace(picture, '\\', '/');
        const fs::path path = folder_ / picture;
        try {
            const std::array<double, 4> mean =
                linear_mean(read_texture(read_whole_file(path), path.string()));
            scene_.file.sources.push_back(path);
            return mean;
        } catch (const InputError& error) {
            warn(fmt::format("a texture is left out ({}).", error.what()));
            return ones;
        }
    }

    static void multiply(Rgb& rgb, const std::array<double, 4>& mean) {
        rgb *= Rgb{{mean[0], mean[1], mean[2]}};
    }

    void apply_pictures(MtlMaterial& material) {
        multiply(material.diffuse, mean_of(material.diffuse_map));
        multiply(material.specular, mean_of(material.specular_map));
        multiply(material.emission_cd_m2, mean_of(material.emission_map));
        const auto opacity = mean_of(material.opacity_map);
        material.opacity *= Rgb{{opacity[0], opacity[1], opacity[2]}}.luminance();
    }

    Rgb share(const Rgb& rgb, std::string_view key) {
        if (rgb.max() > 1) warn(fmt::format("{} is above 1; 1 is used.", key));
        return {{std::min(rgb[0], 1.0), std::min(rgb[1], 1.0), std::min(rgb[2], 1.0)}};
    }

    Material convert(const MtlMaterial& material) {
        const double ior = std::clamp(material.ior.value_or(1.5), 1.0, 4.0);
        const Rgb diffuse = share(material.diffuse, "Kd");
        if (material.opacity < kOpaque) {
            if (material.illum && (*material.illum == 6 || *material.illum == 7)) {
                warn(
                    "illum with refraction becomes a thin pane, because an OBJ file does not say whether the "
                    "body is solid.");
            }
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

    /// Whether bright materials have the same Ks: then it is that of all materials, and no share of dark
    /// ones.
    bool is_habit(const Rgb& specular) const {
        return std::ranges::any_of(materials_, [&](const auto& entry) {
            const MtlMaterial& other = entry.second;
            return other.specular == specular && other.diffuse.max() > kDark && other.opacity >= kOpaque;
        });
    }
    Material glossy(const MtlMaterial& material, const Rgb& diffuse, const Rgb& specular, double ior) {
        constexpr double kMirrorExponent = 1e5;
        // Many programs write 0.5 for every material: how bright its highlights look, not a share of light.
        constexpr double kLargestShare = 0.25;
        const double exponent = std::min(material.exponent, 1e6);
        if (diffuse.max() <= 0 && exponent >= kMirrorExponent) return Mirror{specular};
        const bool is_share =
            specular.max() <= kLargestShare || (diffuse.max() <= kDark && !is_habit(material.specular));
        if (is_share && (diffuse + specular).max() <= 1) return Phong{diffuse, specular, exponent};
        warn(fmt::format(
            "its Ks is too large for a share of light beside its Kd; a coat of ior {:.3g} over Kd is "
            "used (type plastic).",
            ior));
        return plastic_returning(diffuse, std::max(ior, 1.01), std::sqrt(2 / (exponent + 2)));
    }

    fs::path folder_;
    ImportedScene& scene_;
    std::map<std::string, MtlMaterial> materials_;
    std::string name_;
};

/// Metres and z upwards, as the options say or as it seems.
geometry::Transform placement(const MeshFile& mesh, const ImportOptions& options, ImportedScene& scene) {
    UpAxis up = UpAxis::y;
    if (options.up) {
        up = *options.up;
    } else {
        const UpGuess guess = guess_up(mesh);
        up = guess.up;
        scene.file.notes.push_back(guess.reason);
    }
    if (options.scale) return to_metres_and_z_up(*options.scale, up);
    const ScaleGuess guess = guess_scale(mesh, up);
    // Another unit than the usual one is worth a warning, which all commands print.
    if (guess.scale != 1)
        scene.note(guess.reason);
    else
        scene.file.notes.push_back(guess.reason);
    return to_metres_and_z_up(guess.scale, up);
}

/// An object of each group of the file.
void add_groups(const MeshFile& file, const std::vector<MaterialId>& materials, ImportedScene& scene) {
    std::vector<std::vector<std::uint32_t>> triangles(file.group_names.size());
    for (std::uint32_t t = 0; t < file.mesh.triangles.size(); ++t)
        triangles[file.group_of_triangle[t]].push_back(t);
    for (std::size_t g = 0; g < triangles.size(); ++g) {
        ImportedMesh part{geometry::part_of(file.mesh, triangles[g]), {}};
        for (const std::uint32_t t : triangles[g])
            part.materials.push_back(materials[file.material_of_triangle[t]]);
        const std::string& name = file.group_names[g];
        scene.add_object(name.empty() ? scene.file.scene.name : name, std::move(part));
    }
}

}  // namespace

bool names_materials(const fs::path& path) {
    const std::string content = read_whole_file(path);
    return content.starts_with("mtllib") || content.find("\nmtllib") != content.npos;
}

SceneFile read_obj_scene(const fs::path& path, std::span<const std::string> overrides) {
    const ImportSettings settings(overrides, path.string());
    MeshFile mesh = read_mesh_file(path);
    ImportedScene scene(path);
    const geometry::Transform to_world = placement(mesh, settings.options(), scene);
    for (Vec3& vertex : mesh.mesh.vertices) vertex = to_world.point(vertex);
    for (Vec3& normal : mesh.mesh.normals) normal = to_world.normal(normal);
    if (mesh.degenerate_triangles > 0)
        scene.note(fmt::format("{} triangles without area are left out.", mesh.degenerate_triangles));
    ObjMaterials library(mesh, path.has_parent_path() ? path.parent_path() : ".", scene);
    std::vector<MaterialId> materials;
    for (const std::string& name : mesh.material_names) materials.push_back(library.add(name));
    add_groups(mesh, materials, scene);
    return std::move(scene).finish(settings);
}

}  // namespace stilb::io
