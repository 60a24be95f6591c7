#include "io/import/obj/obj_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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
#include "materials/diffuse.h"
#include "stilb/error.h"

namespace stilb::io {
namespace {

namespace fs = std::filesystem;

/// A name with blanks is written in quotes or with backslashes before them.
std::string unquoted(std::string_view name) {
    if (name.size() > 1 && name.front() == '"' && name.ends_with('"'))
        return std::string(name.substr(1, name.size() - 2));
    std::string plain;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (!(name[i] == '\\' && i + 1 < name.size() && name[i + 1] == ' ')) plain += name[i];
    }
    return plain;
}

/// The file beside the scene that a statement names: as it is written, else without quotes, with the slashes
/// of other systems, in UTF-8, or in the scene's folder in place of one of another computer. Where there is
/// none, the path of the first.
fs::path file_beside(const fs::path& folder, const std::string& name) {
    const std::string plain = unquoted(name);
    std::string slashed = plain;
    std::ranges::replace(slashed, '\\', '/');
    std::error_code error;
    for (const std::string& spelled :
         {name, plain, slashed, as_utf8(slashed), fs::path(as_utf8(slashed)).filename().string()}) {
        if (fs::is_regular_file(folder / spelled, error)) return folder / spelled;
    }
    return folder / slashed;
}

/// The paths that a statement mtllib names: one name with blanks, or several names.
std::vector<fs::path> library_paths(const std::string& statement, const fs::path& folder) {
    const fs::path whole = file_beside(folder, statement);
    std::vector<fs::path> paths;
    std::error_code error;
    if (fs::is_regular_file(whole, error) || statement.starts_with('"')) return {whole};
    std::string_view rest = statement;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest))
        paths.push_back(file_beside(folder, std::string(word)));
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
        holes_ = holes_of(material.opacity_map);
        apply_pictures(material, faces_[index]);
        for (const std::string& remark : material.remarks) warn(remark);
        const MaterialId id =
            scene_.add_material(name_, mtl_surface(material, material.diffuse, scene_.warnings));
        if (material.emission_cd_m2.luminance() > 0)
            scene_.set_emission(id, {material.emission_cd_m2, false});
        if (texture) show_texture(id, *texture, material, known->second.diffuse, faces_[index]);
        if (cuts_holes()) cut_holes(id, faces_[index]);
        return id;
    }

    void warn(std::string_view message) { scene_.warnings.add("material", name_, message); }

    void read_library(const fs::path& path) {
        if (!fs::is_regular_file(path)) {
            scene_.warnings.add("file", in_quotes(path.string()), "this MTL file does not exist.");
            return;
        }
        scene_.file.sources.push_back(path);
        MtlLibrary library = read_mtl(read_text_file(path));
        for (const std::string& remark : library.remarks)
            scene_.warnings.add("file", in_quotes(path.string()), remark);
        for (MtlMaterial& material : library.materials) {
            const std::string name = material.name;
            materials_.try_emplace(name, std::move(material));
        }
    }

    /// Nothing where there is no picture, or it cannot be read (which is a warning).
    std::optional<TextureMap> map_of(const MtlPicture& picture) {
        if (picture.file.empty()) return std::nullopt;
        const TextureWrap wrap = picture.is_clamped ? TextureWrap::clamp : TextureWrap::repeat;
        if (auto known = pictures_[picture.file].lock()) return TextureMap{std::move(known), wrap, wrap};
        const fs::path path = file_beside(folder_, picture.file);
        try {
            auto texture =
                std::make_shared<const Texture>(read_texture(read_whole_file(path), path.string()));
            pictures_[picture.file] = texture;
            scene_.file.sources.push_back(path);
            return TextureMap{std::move(texture), wrap, wrap};
        } catch (const InputError& error) {
            warn(
                fmt::format("a texture is left out: a colour counts as 0.5 times its factor, another value "
                            "as its factor ({}).",
                            error.what()));
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

    /// The means of a picture over triangles; ones where there is none, `unread` where it cannot be read.
    /// Where the file says nothing about its place on one of them, the whole picture counts.
    std::array<double, 4> mean_on(const std::vector<std::uint32_t>& triangles, const MtlPicture& picture,
                                  double unread = 1) {
        if (picture.file.empty()) return {1, 1, 1, 1};
        const std::optional<TextureMap> map = map_of(picture);
        if (!map) return {unread, unread, unread, unread};
        return mean_over(triangles, picture, *map, Texels::colours);
    }

    std::array<double, 4> mean_over(const std::vector<std::uint32_t>& triangles, const MtlPicture& picture,
                                    const TextureMap& map, Texels texels) const {
        std::vector<double> areas_m2;
        for (const std::uint32_t t : triangles) areas_m2.push_back(geometry::triangle_area_m2(mesh_.mesh, t));
        std::vector<Uv> places;
        for (const auto& [triangle, barycentric] : points_on_surface(areas_m2)) {
            const FacePlace place = place_of(triangles[triangle], picture);
            if (!has_place(place)) return mean_of(map, {}, texels);
            if (!is_in_hole(triangles[triangle], barycentric)) places.push_back(uv_at(place, barycentric));
        }
        return mean_of(map, places, texels);
    }

    // Opacity

    /// The holes that a picture of opacities cuts.
    struct Holes {
        MaskedTexture mask;
        MtlPicture picture;
    };

    /// A picture whose alpha is the opacity: its own, if it has one, else its grey.
    std::optional<TextureMap> opacities_of(const MtlPicture& picture) {
        std::optional<TextureMap> map = map_of(picture);
        if (!map) return std::nullopt;
        const auto is_opaque = [](const auto& texel) { return texel[3] == 255; };
        if (!std::ranges::all_of(map->picture->texels, is_opaque)) return map;
        auto opacities = std::make_shared<Texture>(*map->picture);
        for (auto& texel : opacities->texels)
            texel[3] = static_cast<std::uint8_t>((texel[0] + texel[1] + texel[2]) / 3);
        map->picture = std::move(opacities);
        return map;
    }

    /// Without a picture of its mask where there are none.
    Holes holes_of(const MtlPicture& picture) {
        constexpr double half = 0.5;
        const std::optional<TextureMap> map = opacities_of(picture);
        if (!map || !has_holes(*map->picture)) return {};
        return {{*map, half, false}, picture};
    }
    bool cuts_holes() const { return holes_.mask.map.picture != nullptr; }

    bool is_in_hole(std::uint32_t triangle, const std::array<double, 3>& barycentric) const {
        if (!cuts_holes()) return false;
        const FacePlace place = place_of(triangle, holes_.picture);
        return has_place(place) && holes_.mask.is_hole(holes_.mask.map.at(uv_at(place, barycentric)));
    }

    double mean_opacity(const std::vector<std::uint32_t>& triangles, const MtlPicture& picture) {
        const std::optional<TextureMap> map = opacities_of(picture);
        return map ? mean_over(triangles, picture, *map, Texels::numbers)[3] : 1;
    }

    void cut_holes(MaterialId id, const std::vector<std::uint32_t>& triangles) {
        if (shows_textures_) warn("it has holes: its texture counts by its mean.");
        scene_.set_texture(id, {holes_.mask, {}});
        set_places(triangles, holes_.picture);
    }

    void set_places(const std::vector<std::uint32_t>& triangles, const MtlPicture& picture) {
        places_.resize(mesh_.mesh.triangles.size(), no_place());
        for (const std::uint32_t t : triangles) places_[t] = place_of(t, picture);
    }

    static void multiply(Rgb& rgb, const std::array<double, 4>& mean) {
        rgb *= Rgb{{mean[0], mean[1], mean[2]}};
    }

    void apply_pictures(MtlMaterial& material, const std::vector<std::uint32_t>& triangles) {
        constexpr double kUnreadColour = 0.5;
        multiply(material.diffuse, mean_on(triangles, material.diffuse_map, kUnreadColour));
        multiply(material.specular, mean_on(triangles, material.specular_map));
        multiply(material.emission_cd_m2, mean_on(triangles, material.emission_map));
        if (!cuts_holes()) material.opacity *= mean_opacity(triangles, material.opacity_map);
    }

    /// `factor`: Kd, which the picture multiplies.
    void show_texture(MaterialId id, const TextureMap& map, const MtlMaterial& material, const Rgb& factor,
                      const std::vector<std::uint32_t>& triangles) {
        if (!shows_textures_) return scene_.remark_mean_texture(name_);
        if (cuts_holes()) return;
        if (material.emission_cd_m2.luminance() > 0 || !shows_diffuse(material))
            return warn("it shines or is transparent: its texture counts by its mean.");
        FaceTexture texture;
        texture.texture.map = map;
        texture.material = [material, factor](const Rgb& colour) {
            GroupedWarnings as_of_the_mean;  // which the scene has already
            return mtl_surface(material, factor * colour, as_of_the_mean);
        };
        scene_.set_texture(id, std::move(texture));
        set_places(triangles, material.diffuse_map);
    }

    const MeshFile& mesh_;
    fs::path folder_;
    bool shows_textures_;
    ImportedScene& scene_;
    std::map<std::string, MtlMaterial> materials_;
    std::vector<std::vector<std::uint32_t>> faces_;  ///< triangles by the index of their material
    std::map<std::string, std::weak_ptr<const Texture>> pictures_;  ///< those in use
    std::vector<FacePlace> places_;
    std::string name_;  ///< of the material that is added
    Holes holes_;       ///< its own
};

/// Metres and z upwards, as the options say or as it seems. All commands warn of what is a guess.
geometry::Transform placement(const MeshFile& mesh, const ImportOptions& options, ImportedScene& scene) {
    if (options.scale && options.up) return to_metres_and_z_up(*options.scale, *options.up);
    const PlacementGuess guess = guess_placement(mesh, options);
    std::vector<std::string> guesses, others;
    if (!options.scale) {
        guesses.push_back(fmt::format("scale = {} ({}), {}", guess.scale, guess.unit, guess.scale_reason));
        others.emplace_back("--set import.scale=METRES");
    }
    if (!options.up) {
        guesses.push_back(fmt::format("up = \"{}\", {}", guess.up == UpAxis::z ? "z" : "y", guess.up_reason));
        others.emplace_back(guess.up == UpAxis::z ? "--set import.up=y" : "--set import.up=z");
    }
    const auto& [x, y, z] = guess.size_m;
    scene.note(
        fmt::format("OBJ files do not state their unit and axes. It is taken as {:.3g} x {:.3g} m large and "
                    "{:.3g} m high: {}. "
                    "If that is wrong: {}",
                    x, y, z, fmt::join(guesses, "; "), fmt::join(others, ", ")));
    return to_metres_and_z_up(guess.scale, guess.up);
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
    for (const std::string& warning : mesh_warnings(mesh)) scene.note(warning);
    std::vector<MaterialId> materials;
    std::vector<FacePlace> places;
    {
        ObjMaterials library(mesh, path.has_parent_path() ? path.parent_path() : ".",
                             settings.options().textures, scene);
        materials = library.add_all();
        places = std::move(library).places();
    }
    add_groups(std::move(mesh), materials, places, scene);
    scene.settle_faces(settings);
    return std::move(scene).finish(settings);
}

}  // namespace stilb::io
