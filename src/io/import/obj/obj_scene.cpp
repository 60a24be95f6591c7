#include "io/import/obj/obj_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "geometry/mesh_part.h"
#include "io/import/imported_scene.h"
#include "io/import/obj/mtl_file.h"
#include "io/import/obj/mtl_surface.h"
#include "io/import/obj/unit_guess.h"
#include "io/mesh/mesh_file.h"
#include "io/text/text.h"
#include "io/text/utf8.h"
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
    /// Keeps references to all of them.
    ObjMaterials(const MeshFile& mesh, const fs::path& folder, bool shows_textures, ImportedScene& scene)
        : mesh_(mesh), folder_(folder), shows_textures_(shows_textures), scene_(scene) {
        for (const std::string& statement : mesh.material_libraries) {
            for (const fs::path& path : library_paths(statement, folder)) read_library(path);
        }
        find_usual_specular(materials_);
        faces_.resize(mesh.material_names.size());
        for (std::uint32_t t = 0; t < mesh.material_of_triangle.size(); ++t)
            faces_[mesh.material_of_triangle[t]].push_back(t);
    }

    /// Adds the materials of all names in the OBJ file.
    std::vector<MaterialId> add_all() {
        std::vector<MaterialId> materials;
        for (std::size_t m = 0; m < mesh_.material_names.size(); ++m) materials.push_back(add(m));
        return materials;
    }

    /// For each triangle, its place in the texture that it shows; empty where none shows one.
    std::vector<FacePlace> places() && { return std::move(places_); }

  private:
    MaterialId add(std::size_t index) {
        const std::string& name = mesh_.material_names[index];
        const auto known = materials_.find(name);
        name_ = name.empty() ? "default" : name;
        if (known == materials_.end()) {
            warn("no MTL file describes it; a diffuse reflectance of 0.5 is used.");
            return scene_.add_material(name_, Diffuse{Rgb::grey(0.5)});
        }
        MtlMaterial material = known->second;
        material.name = name_;
        const std::optional<TextureMap> texture = map_of(material.diffuse_map);
        apply_pictures(material, faces_[index]);
        for (const std::string& statement : material.ignored)
            warn(fmt::format("its statement {} is left out.", in_quotes(statement)));
        const MaterialId id =
            scene_.add_material(name_, mtl_surface(material, material.diffuse, scene_.warnings));
        if (material.emission_cd_m2.luminance() > 0)
            scene_.set_emission(id, {material.emission_cd_m2, false});
        if (texture) show_texture(id, *texture, material, known->second.diffuse, faces_[index]);
        return id;
    }

    void warn(std::string_view message) { scene_.warnings.add("material", name_, message); }

    void read_library(const fs::path& path) {
        if (!fs::is_regular_file(path)) {
            scene_.warnings.add("file", in_quotes(path.string()), "this MTL file does not exist.");
            return;
        }
        scene_.file.sources.push_back(path);
        for (MtlMaterial& material : read_mtl(read_text_file(path), path.string())) {
            const std::string name = material.name;
            materials_.try_emplace(name, std::move(material));
        }
    }

    /// Nothing where there is no picture, or it cannot be read (which is a warning).
    std::optional<TextureMap> map_of(const MtlPicture& picture) {
        if (picture.file.empty()) return std::nullopt;
        std::string name = picture.file;
        std::ranges::replace(name, '\\', '/');
        const TextureWrap wrap = picture.is_clamped ? TextureWrap::clamp : TextureWrap::repeat;
        if (auto known = pictures_[name].lock()) return TextureMap{std::move(known), wrap, wrap};
        const fs::path path = folder_ / name;
        try {
            auto texture =
                std::make_shared<const Texture>(read_texture(read_whole_file(path), path.string()));
            pictures_[name] = texture;
            scene_.file.sources.push_back(path);
            return TextureMap{std::move(texture), wrap, wrap};
        } catch (const InputError& error) {
            warn(fmt::format("a texture is left out ({}).", error.what()));
            return std::nullopt;
        }
    }

    /// The place of a triangle in a picture, whose first row is the top while OBJ counts from the bottom.
    FacePlace place_of(std::uint32_t triangle, const MtlPicture& picture) const {
        if (mesh_.corner_coordinates.empty()) return no_place();
        FacePlace place{};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t index = mesh_.corner_coordinates[triangle][corner];
            if (index == kNoCoordinates) return no_place();
            const auto& [u, v] = mesh_.texture_coordinates[index];
            place[corner] = {picture.scale[0] * u + picture.offset[0],
                             1 - (picture.scale[1] * v + picture.offset[1])};
        }
        return place;
    }

    /// The means of a picture over triangles; ones where there is none. Where the file says nothing about its
    /// place on one of them, the whole picture counts.
    std::array<double, 4> mean_on(const std::vector<std::uint32_t>& triangles, const MtlPicture& picture) {
        const std::optional<TextureMap> map = map_of(picture);
        if (!map) return {1, 1, 1, 1};
        std::vector<double> areas_m2;
        for (const std::uint32_t t : triangles) areas_m2.push_back(geometry::triangle_area_m2(mesh_.mesh, t));
        std::vector<Uv> places;
        for (const auto& [triangle, barycentric] : points_on_surface(areas_m2)) {
            const FacePlace place = place_of(triangles[triangle], picture);
            if (!has_place(place)) return mean_of(*map, {}, true);
            places.push_back(uv_at(place, barycentric));
        }
        return mean_of(*map, places, true);
    }

    static void multiply(Rgb& rgb, const std::array<double, 4>& mean) {
        rgb *= Rgb{{mean[0], mean[1], mean[2]}};
    }

    void apply_pictures(MtlMaterial& material, const std::vector<std::uint32_t>& triangles) {
        multiply(material.diffuse, mean_on(triangles, material.diffuse_map));
        multiply(material.specular, mean_on(triangles, material.specular_map));
        multiply(material.emission_cd_m2, mean_on(triangles, material.emission_map));
        const auto opacity = mean_on(triangles, material.opacity_map);
        material.opacity *= Rgb{{opacity[0], opacity[1], opacity[2]}}.luminance();
    }

    /// `factor`: Kd, which the picture multiplies.
    void show_texture(MaterialId id, const TextureMap& map, const MtlMaterial& material, const Rgb& factor,
                      const std::vector<std::uint32_t>& triangles) {
        if (!shows_textures_) return scene_.remark_mean_texture(name_);
        if (material.emission_cd_m2.luminance() > 0 || !shows_diffuse(material))
            return warn("it shines or is transparent: its texture counts by its mean.");
        FaceTexture texture;
        texture.texture.map = map;
        texture.material = [material, factor](const Rgb& colour) {
            GroupedWarnings as_of_the_mean;  // which the scene has already
            return mtl_surface(material, factor * colour, as_of_the_mean);
        };
        scene_.set_texture(id, std::move(texture));
        places_.resize(mesh_.mesh.triangles.size(), no_place());
        for (const std::uint32_t t : triangles) places_[t] = place_of(t, material.diffuse_map);
    }

    const MeshFile& mesh_;
    fs::path folder_;
    bool shows_textures_;
    ImportedScene& scene_;
    std::map<std::string, MtlMaterial> materials_;
    std::vector<std::vector<std::uint32_t>> faces_;  ///< triangles by the index of their material
    std::map<std::string, std::weak_ptr<const Texture>> pictures_;  ///< those in use
    std::vector<FacePlace> places_;
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

/// The triangles of each group.
std::vector<std::vector<std::uint32_t>> triangles_of_groups(const MeshFile& file) {
    std::vector<std::size_t> counts(file.group_names.size());
    for (const std::uint32_t group : file.group_of_triangle) ++counts[group];
    std::vector<std::vector<std::uint32_t>> triangles(counts.size());
    for (std::size_t g = 0; g < counts.size(); ++g) triangles[g].reserve(counts[g]);
    for (std::uint32_t t = 0; t < file.mesh.triangles.size(); ++t)
        triangles[file.group_of_triangle[t]].push_back(t);
    return triangles;
}

/// An object of each group of the file. What is not needed any more is released on the way, because the
/// memory of a large file counts.
void add_groups(MeshFile file, const std::vector<MaterialId>& materials, const std::vector<FacePlace>& places,
                ImportedScene& scene) {
    const std::vector<std::vector<std::uint32_t>> triangles = triangles_of_groups(file);
    std::vector<std::uint32_t>().swap(file.group_of_triangle);
    std::vector<Triangle>().swap(file.corner_coordinates);
    std::vector<std::array<float, 2>>().swap(file.texture_coordinates);
    std::vector<Mesh> parts = geometry::parts_of(file.mesh, triangles);
    file.mesh = {};
    for (std::size_t g = 0; g < parts.size(); ++g) {
        ImportedMesh part{std::move(parts[g]), {}, {}};
        part.materials.reserve(triangles[g].size());
        for (const std::uint32_t t : triangles[g])
            part.materials.push_back(materials[file.material_of_triangle[t]]);
        for (const std::uint32_t t : triangles[g])
            if (!places.empty()) part.places.push_back(places[t]);
        const std::string& name = file.group_names[g];
        scene.add_object(name.empty() ? scene.file.scene.name : name, std::move(part));
    }
}

}  // namespace

bool names_materials(const fs::path& path) {
    constexpr std::string_view kStatement = "\nmtllib";
    FilePieces file(path);
    std::string_view bytes = file.extended({});
    if (bytes.starts_with(kStatement.substr(1))) return true;
    while (bytes.find(kStatement) == bytes.npos) {
        if (file.left() == 0) return false;
        const std::size_t border = std::min(bytes.size(), kStatement.size() - 1);
        bytes = file.extended(bytes.substr(bytes.size() - border));
    }
    return true;
}

SceneFile read_obj_scene(const fs::path& path, std::span<const std::string> overrides,
                         const Monitor& monitor) {
    const ImportSettings settings(overrides, path.string());
    MeshFile mesh = read_mesh_file(path, monitor, TextureCoordinates::kept);
    ImportedScene scene(path);
    const geometry::Transform to_world = placement(mesh, settings.options(), scene);
    for (Vec3& vertex : mesh.mesh.vertices) vertex = to_world.point(vertex);
    for (Vec3& normal : mesh.mesh.normals) normal = to_world.normal(normal);
    if (mesh.degenerate_triangles > 0)
        scene.note(fmt::format("{} triangles without area are left out.", mesh.degenerate_triangles));
    std::vector<MaterialId> materials;
    std::vector<FacePlace> places;
    {
        ObjMaterials library(mesh, path.has_parent_path() ? path.parent_path() : ".",
                             settings.options().textures, scene);
        materials = library.add_all();
        places = std::move(library).places();
    }
    add_groups(std::move(mesh), materials, places, scene);
    return std::move(scene).finish(settings);
}

}  // namespace stilb::io
