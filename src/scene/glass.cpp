#include "scene/glass.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "base/names.h"
#include "materials/solid.h"
#include "scene/glass_bodies.h"
#include "scene/instances.h"

namespace stilb::scene {
namespace {

double volume_m3(const Bounds& bounds) {
    const Vec3 size = bounds.max - bounds.min;
    return size.x * size.y * size.z;
}

/// On its surface, or near to it.
Vec3 some_point_of(const Shape& shape) {
    const Mesh* mesh = geometry::stored_mesh(shape);
    if (mesh == nullptr) return geometry::bounds_of(shape).middle();
    const auto [a, b, c] = geometry::corners_of(shape, 0);
    return (a + b + c) / 3;
}

/// A body among others.
struct Place {
    std::optional<std::size_t> around;  ///< the smallest body that contains it
    bool is_cavity = false;
    materials::Medium outside, inside;
};

class Nesting {
  public:
    Nesting(const Scene& scene, const std::vector<GlassBody>& bodies)
        : scene_(scene), bodies_(bodies), places_(bodies.size()) {
        for (const GlassBody& body : bodies) points_.push_back(body.some_points(scene));
        compare_all();
        std::vector<std::size_t> large_first(bodies.size());
        std::iota(large_first.begin(), large_first.end(), std::size_t{0});
        std::ranges::stable_sort(large_first, std::greater(),
                                 [&](std::size_t i) { return volume_m3(bodies[i].bounds); });
        for (const std::size_t i : large_first) settle(i);
    }

    const Place& operator[](std::size_t body) const { return places_[body]; }
    /// Pairs of bodies that cut each other.
    const std::vector<std::pair<std::size_t, std::size_t>>& cutting() const { return cutting_; }

  private:
    /// All pairs whose bounds overlap, by a sweep along x.
    void compare_all() {
        std::vector<std::size_t> order(bodies_.size()), open;
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::sort(order, {}, [&](std::size_t i) { return bodies_[i].bounds.min.x; });
        for (const std::size_t i : order) {
            const Bounds& own = bodies_[i].bounds;
            std::erase_if(open, [&](std::size_t j) { return bodies_[j].bounds.max.x <= own.min.x; });
            for (const std::size_t j : open) {
                const Bounds& other = bodies_[j].bounds;
                if (own.min.y < other.max.y && other.min.y < own.max.y && own.min.z < other.max.z &&
                    other.min.z < own.max.z)
                    compare(i, j);
            }
            open.push_back(i);
        }
    }

    void compare(std::size_t i, std::size_t j) {
        const auto inside = [&](std::size_t inner, std::size_t outer) {
            return static_cast<std::size_t>(std::ranges::count_if(
                points_[inner], [&](const Vec3& point) { return bodies_[outer].contains(point, scene_); }));
        };
        const std::size_t of_i = inside(i, j), of_j = inside(j, i);
        if (of_i == 0 && of_j == 0) return;
        if (of_i == points_[i].size() && of_j == 0) return put(i, j);
        if (of_j == points_[j].size() && of_i == 0) return put(j, i);
        cutting_.emplace_back(std::minmax(i, j));
    }
    void put(std::size_t inner, std::size_t outer) {
        std::optional<std::size_t>& around = places_[inner].around;
        if (!around || volume_m3(bodies_[outer].bounds) < volume_m3(bodies_[*around].bounds)) around = outer;
    }

    /// After the bodies around it.
    void settle(std::size_t i) {
        Place& place = places_[i];
        place.inside = bodies_[i].medium;
        if (!place.around) return;
        const Place& around = places_[*place.around];
        place.outside = around.inside;
        // A shell that is turned the other way in glass of its own kind is the surface of a cavity.
        place.is_cavity = !around.is_cavity && bodies_[i].medium == around.inside &&
                          bodies_[i].is_inside_out != bodies_[*place.around].is_inside_out;
        if (place.is_cavity) place.inside = around.outside;
    }

    const Scene& scene_;
    const std::vector<GlassBody>& bodies_;
    std::vector<Place> places_;
    std::vector<std::vector<Vec3>> points_;
    std::vector<std::pair<std::size_t, std::size_t>> cutting_;
};

/// Changes fronts and materials.
class GlassSettler {
  public:
    explicit GlassSettler(Scene& scene) : scene_(scene), found_(find_glass_bodies(scene)) {}

    std::vector<std::string> run() && {
        const Nesting nesting(scene_, found_.bodies);
        for (std::size_t i = 0; i < found_.bodies.size(); ++i) settle(found_.bodies[i], nesting[i]);
        for (const Part& part : found_.sheets) {
            for_each_material(part, [&](MaterialId id) { return sheet_of(id); });
        }
        return warnings(nesting);
    }

  private:
    void settle(const GlassBody& body, const Place& place) {
        for (const Part& part : body.turned) turn(part);
        // The front of a cavity is the cavity.
        if (body.is_inside_out != place.is_cavity) {
            for (const Part& part : body.parts) turn(part);
        }
        const auto [front, back] =
            place.is_cavity ? std::pair(place.inside, place.outside) : std::pair(place.outside, place.inside);
        const auto interface = [&, front = front, back = back](MaterialId id) {
            return between(id, front, back);
        };
        for (const Part& part : body.parts) for_each_material(part, interface);
        Object& object = scene_.objects[index_of(body.object)];
        if (body.parts.empty()) object.materials = {interface(object.materials[0])};
    }

    void turn(const Part& part) {
        if (part.triangles->empty()) return;
        Object& object = scene_.objects[index_of(part.object)];
        make_own_mesh(object);
        if (auto* rectangle = std::get_if<Rectangle>(&object.shape)) {
            std::swap(rectangle->edge_u, rectangle->edge_v);
        } else if (auto* mesh = std::get_if<Mesh>(&object.shape)) {
            for (const std::uint32_t t : *part.triangles) turn_over(*mesh, t);
        }
    }

    /// Replaces the materials of glass of these triangles.
    template <typename Replace>
    void for_each_material(const Part& part, const Replace& replace) {
        Object& object = scene_.objects[index_of(part.object)];
        const auto is_glass = [&](MaterialId id) {
            return materials::medium_inside(scene_.material(id)).has_value();
        };
        const Mesh* mesh = geometry::stored_mesh(object.shape);
        const std::size_t count = mesh ? mesh->triangles.size() : part.triangles->size();
        if (object.materials.size() == 1 && part.triangles->size() == count) {
            if (is_glass(object.materials[0])) object.materials = {replace(object.materials[0])};
            return;
        }
        std::vector<MaterialId> materials(object.materials.begin(), object.materials.end());
        materials.resize(count, materials[0]);
        for (const std::uint32_t t : *part.triangles) {
            if (is_glass(materials[t])) materials[t] = replace(materials[t]);
        }
        object.materials = std::move(materials);
    }

    MaterialId between(MaterialId id, const materials::Medium& front, const materials::Medium& back) {
        const Material& now = scene_.material(id);
        if (materials::medium_inside(now) == back && materials::medium_outside(now) == front) return id;
        return derived({index_of(id), front, back}, [&] {
            return NamedMaterial{
                fmt::format("{} (in a medium of ior {:g})", scene_.materials[index_of(id)].name, front.ior),
                materials::between_media(scene_.material(id), back, front)};
        });
    }
    MaterialId sheet_of(MaterialId id) {
        return derived({index_of(id), {0, {}}, {0, {}}}, [&] {
            return NamedMaterial{scene_.materials[index_of(id)].name + " (a sheet)",
                                 materials::sheet_of(scene_.material(id))};
        });
    }
    /// A material, and the media on its front and its back.
    using Derived = std::tuple<std::uint32_t, materials::Medium, materials::Medium>;
    template <typename Make>
    MaterialId derived(const Derived& key, const Make& make) {
        const auto [known, is_new] =
            derived_.try_emplace(key, MaterialId{static_cast<std::uint32_t>(scene_.materials.size())});
        if (is_new) scene_.materials.push_back(make());
        return known->second;
    }

    std::vector<std::string> warnings(const Nesting& nesting) const {
        std::vector<std::string> texts;
        const auto add = [&](const std::vector<std::string>& names, std::string_view text) {
            if (names.empty()) return;
            texts.push_back(
                fmt::format("{} {}: {}", names.size() == 1 ? "object" : "objects", list_of(names), text));
        };
        add(found_.open,
            "the faces of type \"glass\" close no body, and are computed as thin sheets (type \"pane\"), "
            "which absorb nothing. Close the body, or give them the type \"pane\".");
        add(found_.nearly_closed,
            "a body of type \"glass\" is closed but for a few edges. Close it: light that passes the holes "
            "is "
            "refracted only once.");
        add(found_.partly_glass,
            "only some faces of a closed surface are of type \"glass\". They are computed as thin sheets "
            "(type "
            "\"pane\"), and the space inside as air.");
        add(found_.mostly_glass,
            "not all faces of a closed surface are of type \"glass\". The space inside is computed as glass; "
            "if it "
            "is air, give the faces the type \"pane\".");
        add(in_coloured_glass(),
            "this lies in glass that has a color. Light that passes between it and other things in there, or "
            "a "
            "frosted face, is not absorbed on this way.");
        std::vector<std::string> pairs;
        for (const auto& [i, j] : nesting.cutting()) {
            const std::string &first = scene_.object(found_.bodies[i].object).name,
                              &second = scene_.object(found_.bodies[j].object).name;
            pairs.push_back(first == second ? first : fmt::format("{} and {}", first, second));
        }
        add(pairs,
            "these bodies of type \"glass\" cut or touch each other, and each is computed as if it stood "
            "alone there. "
            "Put one wholly inside of the other, or leave a gap between them.");
        return texts;
    }

    /// The names of objects, other than smooth bodies of glass, that lie in glass that absorbs: light knows
    /// the media on both sides of smooth glass only.
    std::vector<std::string> in_coloured_glass() const {
        std::vector<std::string> names;
        for (const Object& object : scene_.objects) {
            if (scene_.material(object.materials[0]).is<Dielectric>()) continue;
            const Vec3 point = some_point_of(object.shape);
            if (std::ranges::any_of(found_.bodies, [&](const GlassBody& body) {
                    return !body.medium.is_clear() && body.contains(point, scene_);
                }))
                names.push_back(object.name);
        }
        return names;
    }

    Scene& scene_;
    GlassBodies found_;
    std::map<Derived, MaterialId> derived_;
};

}  // namespace

std::vector<std::string> settle_glass(Scene& scene) {
    const bool has_glass = std::ranges::any_of(scene.materials, [](const NamedMaterial& named) {
        return materials::medium_inside(named.material).has_value();
    });
    if (!has_glass) return {};
    return GlassSettler(scene).run();
}

}  // namespace stilb::scene
