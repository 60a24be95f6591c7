#include "io/import/textures/textured_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "geometry/mesh_topology.h"
#include "io/import/imported_scene.h"
#include "io/import/textures/palette.h"

namespace stilb::io {
namespace {

MaterialId material_of_face(const Object& object, std::size_t triangle) {
    return object.materials[object.materials.size() == 1 ? 0 : triangle];
}

/// Triangles of some objects as one mesh.
struct JoinedObjects {
    Mesh mesh;  ///< without normals
    std::vector<ObjectId> objects;
    std::vector<std::size_t> first_triangle{0};  ///< per object, and the number of all at the end

    void add(ObjectId object, const Mesh& part) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
        for (const auto& [a, b, c] : part.triangles)
            mesh.triangles.push_back({first + a, first + b, first + c});
        objects.push_back(object);
        first_triangle.push_back(mesh.triangles.size());
    }
};

/// The normal of a mesh at a point of a triangle; nothing where the triangle is flat.
std::optional<Vec3> interpolated_normal(const Mesh& mesh, std::size_t triangle,
                                        const std::array<double, 3>& barycentric) {
    const Triangle& normals =
        mesh.corner_normals.empty() ? mesh.triangles[triangle] : mesh.corner_normals[triangle];
    Vec3 sum;
    for (std::size_t i = 0; i < 3; ++i) {
        if (mesh.normals.empty() || normals[i] == kNoNormal) return std::nullopt;
        sum += barycentric[i] * mesh.normals[normals[i]];
    }
    const double size = length(sum);
    return size > 1e-9 ? sum / size : Vec3{};
}

/// Numbers the vertices of one object after the other.
class VertexNumbers {
  public:
    explicit VertexNumbers(const std::vector<Vec3>& vertices)
        : vertices_(vertices), numbers_(vertices.size()), object_of_(vertices.size(), kNone) {}

    std::uint32_t in_object(std::uint32_t vertex, std::uint32_t object, Mesh& mesh) {
        if (object_of_[vertex] != object) {
            object_of_[vertex] = object;
            numbers_[vertex] = static_cast<std::uint32_t>(mesh.vertices.size());
            mesh.vertices.push_back(vertices_[vertex]);
        }
        return numbers_[vertex];
    }

  private:
    static constexpr std::uint32_t kNone = ~0u;
    const std::vector<Vec3>& vertices_;
    std::vector<std::uint32_t> numbers_, object_of_;
};

/// The normals of the pieces of one object.
class CornerNormals {
  public:
    CornerNormals(const Mesh& old, Mesh& mesh) : old_(old), mesh_(mesh) {}

    template <typename PlaceOf>
    void add(std::size_t triangle, const Piece& piece, const PlaceOf& place_of) {
        if (old_.normals.empty()) return;
        if (triangle != triangle_) known_.clear();
        triangle_ = triangle;
        Triangle normals{};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const auto next = static_cast<std::uint32_t>(mesh_.normals.size());
            const auto [found, is_new] = known_.try_emplace(piece.corners[corner], next);
            if (is_new) {
                const auto normal = interpolated_normal(old_, triangle, place_of(corner));
                if (normal)
                    mesh_.normals.push_back(*normal);
                else
                    found->second = kNoNormal;
            }
            normals[corner] = found->second;
        }
        mesh_.corner_normals.push_back(normals);
    }

  private:
    const Mesh& old_;
    Mesh& mesh_;
    std::size_t triangle_ = 0;
    std::unordered_map<std::uint32_t, std::uint32_t> known_;  ///< normals by vertex, in one triangle
};

/// Decides which pieces with parts of holes are surface, so that their area in all is that of the surface.
class Coverage {
  public:
    bool takes(const Piece& piece) {
        if (piece.filled <= 0 || piece.filled >= 1) return piece.filled > 0;
        constexpr double half = 0.5;
        missing_m2_ += piece.filled * piece.area_m2;
        const bool is_surface = missing_m2_ >= half * piece.area_m2;
        if (is_surface) missing_m2_ -= piece.area_m2;
        return is_surface;
    }

  private:
    double missing_m2_ = 0;  ///< the surface of earlier pieces without their area
};

class SurfaceDivision {
  public:
    SurfaceDivision(Scene& scene, const SceneTextures& textures, UniqueNames& names, GroupedWarnings& remarks,
                    GroupedWarnings& warnings, const TextureLimits& limits)
        : scene_(scene),
          names_(names),
          remarks_(remarks),
          warnings_(warnings),
          limits_(limits),
          given_(textures) {
        for (const auto& [material, texture] : textures.of_material) {
            number_of_[material] = static_cast<std::uint32_t>(materials_.size());
            materials_.push_back(material);
            textures_.push_back(texture.texture);
        }
    }

    void run() {
        join_objects();
        if (std::ranges::all_of(faces_.textures, [](std::uint32_t t) { return t == kNoTexture; })) return;
        const std::size_t most = std::min(limits_.faces_of_material, limits_.faces / materials_.size());
        const TexturePieces all = divide_by_texture(faces_, textures_, most);
        const std::vector<std::optional<MaterialId>> materials = materials_of(all);
        replace_objects(all, materials);
    }

  private:
    /// The number of the texture of an object's triangle; kNoTexture where it has none, or no place in it.
    std::uint32_t texture_of(ObjectId object, std::size_t triangle) const {
        const auto places = given_.places.find(object);
        if (places == given_.places.end() || !has_place(places->second[triangle])) return kNoTexture;
        const auto number = number_of_.find(material_of_face(scene_.object(object), triangle));
        return number == number_of_.end() ? kNoTexture : number->second;
    }

    /// The objects whose faces are divided: those with textures, and those connected to them.
    std::vector<ObjectId> connected_objects() const {
        JoinedObjects all;
        std::vector<bool> is_textured;
        for (std::uint32_t i = 0; i < scene_.objects.size(); ++i) {
            const auto* const mesh = std::get_if<Mesh>(&scene_.objects[i].shape);
            if (mesh == nullptr) continue;
            all.add(ObjectId{i}, *mesh);
            for (std::size_t t = 0; t < mesh->triangles.size(); ++t)
                is_textured.push_back(texture_of(ObjectId{i}, t) != kNoTexture);
        }
        const SharedList<std::uint32_t> component_of = geometry::find_components(all.mesh).of_triangle;
        std::set<std::uint32_t> divided;
        for (std::size_t t = 0; t < is_textured.size(); ++t) {
            if (is_textured[t]) divided.insert(component_of[t]);
        }
        std::vector<ObjectId> connected;
        for (std::size_t i = 0; i < all.objects.size(); ++i) {
            const auto first = component_of.begin() + static_cast<std::ptrdiff_t>(all.first_triangle[i]);
            const auto last = component_of.begin() + static_cast<std::ptrdiff_t>(all.first_triangle[i + 1]);
            if (std::any_of(first, last, [&](std::uint32_t c) { return divided.contains(c); }))
                connected.push_back(all.objects[i]);
        }
        return connected;
    }

    void join_objects() {
        for (const ObjectId id : connected_objects()) {
            const auto& mesh = std::get<Mesh>(scene_.object(id).shape);
            joined_.add(id, mesh);
            for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
                faces_.textures.push_back(texture_of(id, t));
                const bool has_texture = faces_.textures.back() != kNoTexture;
                faces_.places.push_back(has_texture ? given_.places.at(id)[t] : no_place());
            }
        }
        faces_.mesh = joined_.mesh;
        const std::vector<std::uint32_t> vertex_at = geometry::welded(faces_.mesh.vertices);
        for (Triangle& triangle : faces_.mesh.triangles) {
            for (std::uint32_t& corner : triangle) corner = vertex_at[corner];
        }
    }

    /// The materials of all pieces: nothing for holes.
    std::vector<std::optional<MaterialId>> materials_of(const TexturePieces& all) {
        constexpr double smallest_m2 = 1e-300;
        std::vector<Coverage> coverages(textures_.size());
        std::vector<std::optional<MaterialId>> materials(all.pieces.size());
        std::vector<std::vector<std::size_t>> of_texture(textures_.size());
        for (std::size_t p = 0; p < all.pieces.size(); ++p) {
            const Piece& piece = all.pieces[p];
            if (const std::uint32_t texture = faces_.textures[piece.parent]; texture == kNoTexture)
                materials[p] = own_material(piece.parent);
            else if (coverages[texture].takes(piece))
                of_texture[texture].push_back(p);
        }
        const std::size_t share = limits_.colours / textures_.size();
        const std::size_t most_colours = std::clamp<std::size_t>(share, 1, limits_.colours_of_material);
        for (std::size_t t = 0; t < textures_.size(); ++t) {
            std::vector<WeightedColour> colours;
            for (const std::size_t p : of_texture[t])
                colours.push_back({all.pieces[p].colour, std::max(all.pieces[p].area_m2, smallest_m2)});
            const Palette palette = make_palette(colours, most_colours);
            report(t, colours.size(), palette.colours.size(), all.coarsest_m[t]);
            const std::vector<MaterialId> added = add_materials(t, palette);
            for (std::size_t i = 0; i < of_texture[t].size(); ++i)
                materials[of_texture[t][i]] = added[palette.colour_of[i]];
        }
        return materials;
    }

    MaterialId own_material(std::uint32_t parent) const {
        const auto next = std::ranges::upper_bound(joined_.first_triangle, parent);
        const auto i = static_cast<std::size_t>(next - joined_.first_triangle.begin()) - 1;
        return material_of_face(scene_.object(joined_.objects[i]), parent - joined_.first_triangle[i]);
    }

    void report(std::size_t texture, std::size_t faces, std::size_t colours, double coarsest_m) {
        const std::string& name = scene_.materials[index_of(materials_[texture])].name;
        if (!textures_[texture].shows_colours) {
            remarks_.add("material", name, fmt::format("its holes are cut: {} faces remain.", faces));
            return;
        }
        remarks_.add("material", name, fmt::format("its texture is {} faces of {} colours.", faces, colours));
        if (!(coarsest_m > 0)) return;
        warnings_.add(
            "material", name,
            fmt::format("its texture is finer than the {} faces that show it: those of up to {:.2g} "
                        "m have the mean colour of their part.",
                        faces, coarsest_m));
    }

    std::vector<MaterialId> add_materials(std::size_t texture, const Palette& palette) {
        const MaterialId mean = materials_[texture];
        if (!textures_[texture].shows_colours) return std::vector(palette.colours.size(), mean);
        const std::string name = scene_.materials[index_of(mean)].name;
        bool is_mean_free = !has_plain_faces(mean);  // its place can be taken
        std::vector<MaterialId> added;
        for (const Rgb& colour : palette.colours) {
            NamedMaterial material{name, given_.of_material.at(mean).material(colour)};
            if (palette.colours.size() > 1 || !is_mean_free)
                material.name = names_.make(colour_name(name, added.size() + 1), "material");
            if (std::exchange(is_mean_free, false)) {
                added.push_back(mean);
                scene_.materials[index_of(mean)] = std::move(material);
            } else {
                added.push_back(MaterialId{static_cast<std::uint32_t>(scene_.materials.size())});
                scene_.materials.push_back(std::move(material));
            }
        }
        return added;
    }

    /// Whether faces have this material without a place in its texture.
    bool has_plain_faces(MaterialId material) const {
        for (std::uint32_t i = 0; i < scene_.objects.size(); ++i) {
            const auto* const mesh = std::get_if<Mesh>(&scene_.objects[i].shape);
            if (mesh == nullptr) continue;
            for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
                if (material_of_face(scene_.objects[i], t) == material &&
                    texture_of(ObjectId{i}, t) == kNoTexture)
                    return true;
            }
        }
        return false;
    }

    void replace_objects(const TexturePieces& all, const std::vector<std::optional<MaterialId>>& materials) {
        VertexNumbers numbers(all.vertices);
        std::size_t next = 0;
        std::set<ObjectId> empty;
        for (std::size_t i = 0; i < joined_.objects.size(); ++i) {
            const ObjectId id = joined_.objects[i];
            Object& object = scene_.objects[index_of(id)];
            const Mesh old = std::exchange(std::get<Mesh>(object.shape), Mesh{});
            auto& mesh = std::get<Mesh>(object.shape);
            std::vector<MaterialId> of_pieces;
            CornerNormals normals(old, mesh);
            for (; next < all.pieces.size() && all.pieces[next].parent < joined_.first_triangle[i + 1];
                 ++next) {
                if (!materials[next]) continue;
                const Piece& piece = all.pieces[next];
                of_pieces.push_back(*materials[next]);
                Triangle triangle{};
                for (std::size_t corner = 0; corner < 3; ++corner)
                    triangle[corner] = numbers.in_object(piece.corners[corner], index_of(id), mesh);
                mesh.triangles.push_back(triangle);
                normals.add(piece.parent - joined_.first_triangle[i], piece,
                            [&](std::size_t corner) { return place_in_parent(faces_, all, piece, corner); });
            }
            if (mesh.normals.empty()) mesh.corner_normals.clear();
            if (of_pieces.empty()) empty.insert(id);
            object.materials = simplified(std::move(of_pieces));
        }
        remove(empty);
    }

    static SharedList<MaterialId> simplified(std::vector<MaterialId> materials) {
        const bool is_one = !materials.empty() && std::ranges::all_of(materials, [&](MaterialId m) {
            return m == materials.front();
        });
        if (is_one) return {materials.front()};
        return materials;
    }

    void remove(const std::set<ObjectId>& objects) {
        std::uint32_t number = 0;
        std::erase_if(scene_.objects,
                      [&](const Object&) { return objects.contains(static_cast<ObjectId>(number++)); });
    }

    Scene& scene_;
    UniqueNames& names_;
    GroupedWarnings &remarks_, &warnings_;
    TextureLimits limits_;
    const SceneTextures& given_;
    std::map<MaterialId, std::uint32_t> number_of_;  ///< of textures
    std::vector<MaterialId> materials_;              ///< by the numbers of their textures
    std::vector<MaskedTexture> textures_;
    JoinedObjects joined_;
    TexturedMesh faces_;  ///< of the joined objects
};

constexpr std::string_view kOfTexture = " (texture ";

}  // namespace

std::string colour_name(std::string_view material, std::size_t number) {
    return fmt::format("{}{}{})", material, kOfTexture, number);
}

std::string_view material_of_colour(std::string_view name) {
    const std::size_t end = name.rfind(kOfTexture);
    const bool is_one = end != name.npos && name.ends_with(')');
    return is_one ? name.substr(0, end) : std::string_view{};
}

void apply_textures(Scene& scene, const SceneTextures& textures, UniqueNames& names, GroupedWarnings& remarks,
                    GroupedWarnings& warnings, const TextureLimits& limits) {
    if (!textures.of_material.empty())
        SurfaceDivision(scene, textures, names, remarks, warnings, limits).run();
}

}  // namespace stilb::io
