#include "scene/glass_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "geometry/mesh_topology.h"
#include "materials/solid.h"

namespace stilb::scene {
namespace {

using Corners = std::array<Vec3, 3>;

/// From this share of a closed surface on, glass makes it a body: a room with a wall of glass is none.
constexpr double kShareOfBody = 0.5;
/// Corners of different objects are rounded to this, because their rounding errors differ.
constexpr double kWeld_m = 1e-7;

Vec3 doubled_area(const Corners& c) { return cross(c[1] - c[0], c[2] - c[0]); }

/// Of a shape that stores a mesh, or of a rectangle, in the world.
Corners corners_at(const Shape& shape, std::uint32_t triangle) {
    if (const auto* rectangle = std::get_if<Rectangle>(&shape))
        return triangulated(*rectangle).corners_of(triangle);
    return geometry::corners_of(shape, triangle);
}

TriangleList shared(std::vector<std::uint32_t> triangles) {
    return std::make_shared<const std::vector<std::uint32_t>>(std::move(triangles));
}

/// For each triangle, whether its front lies on the other side of the surface than that of the first triangle
/// which edges of two triangles connect it with.
std::vector<bool> turned_triangles(const Mesh& mesh) {
    struct Neighbour {
        std::uint32_t triangle;
        bool is_turned;
    };
    std::vector<std::vector<Neighbour>> neighbours(mesh.triangles.size());
    geometry::Edges(mesh).for_each([&](auto first, auto last) {
        if (last - first != 2) return;
        const std::uint32_t a = first->triangle, b = (first + 1)->triangle;
        const bool is_turned = first->upwards == (first + 1)->upwards;
        neighbours[a].push_back({b, is_turned});
        neighbours[b].push_back({a, is_turned});
    });
    std::vector<bool> turned(mesh.triangles.size()), is_known(mesh.triangles.size());
    std::vector<std::uint32_t> next;
    for (std::uint32_t start = 0; start < mesh.triangles.size(); ++start) {
        if (is_known[start]) continue;
        is_known[start] = true;
        for (next.push_back(start); !next.empty();) {
            const std::uint32_t at = next.back();
            next.pop_back();
            for (const Neighbour& neighbour : neighbours[at]) {
                if (is_known[neighbour.triangle]) continue;
                is_known[neighbour.triangle] = true;
                turned[neighbour.triangle] = turned[at] != neighbour.is_turned;
                next.push_back(neighbour.triangle);
            }
        }
    }
    return turned;
}

/// A connected component of a mesh.
struct Component {
    TriangleList triangles, turned;
    bool is_closed = false, is_nearly_closed = false, is_inside_out = false;
    bool has_rim = false;  ///< an edge of one triangle
};

std::vector<Component> components_of(const Mesh& mesh) {
    const geometry::ConnectedComponents found = find_components(mesh);
    const std::vector<bool> is_turned =
        found.turned_edges > 0 ? turned_triangles(mesh) : std::vector<bool>(mesh.triangles.size());
    struct Sums {
        std::vector<std::uint32_t> triangles, turned;
        Vec3 origin, vector_area;
        double area = 0, volume = 0;
    };
    std::vector<Sums> sums(found.count());
    std::vector<bool> has_rim(found.count());
    geometry::Edges(mesh).for_each([&](auto first, auto last) {
        if (last - first == 1) has_rim[found.of_triangle[first->triangle]] = true;
    });
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        Sums& of = sums[found.of_triangle[t]];
        const Corners corners = mesh.corners_of(t);
        if (of.triangles.empty()) of.origin = corners[0];
        const Vec3 doubled = (is_turned[t] ? -1 : 1) * doubled_area(corners);
        of.triangles.push_back(t);
        if (is_turned[t]) of.turned.push_back(t);
        of.vector_area += doubled;
        of.area += length(doubled);
        of.volume += dot(doubled, corners[0] - of.origin);
    }
    std::vector<Component> components;
    for (std::uint32_t c = 0; c < found.count(); ++c) {
        Sums& of = sums[c];
        const std::size_t open = found.open_edges[c], count = of.triangles.size();
        components.push_back({shared(std::move(of.triangles)), shared(std::move(of.turned)), open == 0,
                              open > 0 && geometry::nearly_closes(of.vector_area, of.area, open, count),
                              of.volume < 0, has_rim[c]});
    }
    return components;
}

void name(std::vector<std::string>& names, const std::string& object) {
    if (names.empty() || names.back() != object) names.push_back(object);
}

class GlassSearch {
  public:
    explicit GlassSearch(const Scene& scene) : scene_(scene), left_out_(lamps_of(scene)) {
        for (const Object& object : scene.objects) {
            if (object.cut_from) left_out_.insert(*object.cut_from);
        }
    }

    GlassBodies run() && {
        for (std::uint32_t i = 0; i < scene_.objects.size(); ++i) {
            if (!left_out_.contains(ObjectId{i})) add(ObjectId{i});
        }
        add_loose();
        return std::move(found_);
    }

  private:
    void add(ObjectId id) {
        const Object& object = scene_.object(id);
        const auto is_glass = [&](std::uint32_t triangle) {
            return glass_medium(scene_, object, triangle).has_value();
        };
        const Mesh* mesh = geometry::stored_mesh(object.shape);
        if (!mesh) return is_glass(0) ? add_simple(id) : void();
        if (std::ranges::none_of(object.materials, [&](MaterialId material) {
                return materials::medium_inside(scene_.material(material)).has_value();
            }))
            return;
        for (const Component& component : components_of_stored(*mesh)) {
            double area = 0, of_glass = 0;
            std::vector<std::uint32_t> glass;
            for (const std::uint32_t t : *component.triangles) {
                const double doubled = length(doubled_area(mesh->corners_of(t)));
                area += doubled;
                if (!is_glass(t)) continue;
                glass.push_back(t);
                of_glass += doubled;
            }
            if (glass.empty()) continue;
            const bool is_whole = glass.size() == component.triangles->size();
            if (component.is_closed && of_glass >= kShareOfBody * area) {
                if (!is_whole) name(found_.mostly_glass, object.name);
                add_body({{id, component.triangles}}, {{id, component.turned}},
                         *glass_medium(scene_, object, glass.front()), component.is_inside_out);
            } else {
                if (component.is_closed) name(found_.partly_glass, object.name);
                loosen({id, is_whole ? component.triangles : shared(std::move(glass))});
            }
        }
    }

    /// A shape without a stored mesh.
    void add_simple(ObjectId id) {
        const Shape& shape = scene_.object(id).shape;
        if (std::holds_alternative<Rectangle>(shape)) return loosen({id, shared({0, 1})});
        if (std::holds_alternative<Disk>(shape)) return add_sheet({id, shared({0})});
        found_.bodies.push_back(
            {id, {}, {}, *glass_medium(scene_, scene_.object(id), 0), false, bounds_of(shape)});
    }

    const std::vector<Component>& components_of_stored(const Mesh& mesh) {
        auto [known, is_new] = components_.try_emplace(&mesh);
        if (is_new) known->second = components_of(mesh);
        return known->second;
    }

    void loosen(Part part) { loose_.push_back(std::move(part)); }

    void add_body(std::vector<Part> parts, std::vector<Part> turned, const materials::Medium& medium,
                  bool is_inside_out) {
        GlassBody body{parts.front().object, std::move(parts), std::move(turned), medium, is_inside_out, {}};
        for (const Part& part : body.parts) {
            const Shape& shape = scene_.object(part.object).shape;
            for (const std::uint32_t t : *part.triangles) {
                for (const Vec3& point : corners_at(shape, t)) body.bounds.include(point);
            }
        }
        found_.bodies.push_back(std::move(body));
    }

    /// Parts that close no body by themselves may do so together, as six rectangles do.
    void add_loose() {
        const std::vector<Part>& parts = loose_;
        Mesh mesh;
        std::vector<std::pair<std::size_t, std::uint32_t>> origins;  // part, triangle
        for (std::size_t p = 0; p < parts.size(); ++p) {
            const Shape& shape = scene_.object(parts[p].object).shape;
            for (const std::uint32_t t : *parts[p].triangles) {
                const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
                for (const Vec3& point : corners_at(shape, t)) mesh.vertices.push_back(rounded(point));
                mesh.triangles.push_back({first, first + 1, first + 2});
                origins.emplace_back(p, t);
            }
        }
        for (const Component& component : components_of(mesh)) {
            const auto parts_of = [&](const TriangleList& triangles) {
                std::map<std::size_t, std::vector<std::uint32_t>> by_part;
                for (const std::uint32_t t : *triangles)
                    by_part[origins[t].first].push_back(origins[t].second);
                std::vector<Part> result;
                for (auto& [p, list] : by_part) result.push_back({parts[p].object, shared(std::move(list))});
                return result;
            };
            std::vector<Part> own = parts_of(component.triangles);
            const auto medium =
                glass_medium(scene_, scene_.object(own.front().object), own.front().triangles->front());
            const bool is_of_one_kind = std::ranges::all_of(own, [&](const Part& part) {
                return std::ranges::all_of(*part.triangles, [&](std::uint32_t t) {
                    return glass_medium(scene_, scene_.object(part.object), t) == medium;
                });
            });
            // Faces of several media may meet along a line, each between two of them: they stay as they are.
            if (!component.has_rim && !(component.is_closed && is_of_one_kind)) continue;
            if (is_of_one_kind && (component.is_closed || component.is_nearly_closed)) {
                if (component.is_nearly_closed)
                    name(found_.nearly_closed, scene_.object(own.front().object).name);
                add_body(std::move(own), parts_of(component.turned), *medium, component.is_inside_out);
            } else {
                for (Part& part : own) add_sheet(std::move(part));
            }
        }
    }

    void add_sheet(Part part) {
        name(found_.open, scene_.object(part.object).name);
        found_.sheets.push_back(std::move(part));
    }

    static Vec3 rounded(const Vec3& v) {
        const auto snapped = [](double x) { return std::round(x / kWeld_m) * kWeld_m; };
        return {snapped(v.x), snapped(v.y), snapped(v.z)};
    }

    const Scene& scene_;
    std::set<ObjectId> left_out_;
    std::map<const Mesh*, std::vector<Component>> components_;
    std::vector<Part> loose_;  ///< faces of components that are no bodies by themselves
    GlassBodies found_;
};

/// Whether the ray from the point along a direction in general position meets the triangle.
bool meets(const Vec3& point, const Corners& corners) {
    constexpr Vec3 direction{0.2673, 0.5345, 0.8018};
    const Vec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
    const Vec3 p = cross(direction, v);
    const double determinant = dot(u, p);
    if (determinant == 0) return false;
    const Vec3 from = point - corners[0], q = cross(from, u);
    const double s = dot(from, p) / determinant, t = dot(direction, q) / determinant;
    return s >= 0 && t >= 0 && s + t <= 1 && dot(v, q) / determinant > 0;
}

std::vector<Vec3> points_of(const Shape& shape) {
    constexpr std::array<Vec3, 6> axes{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
    std::vector<Vec3> points;
    if (const auto* box = std::get_if<Box>(&shape)) {
        const Mesh mesh = triangulated(*box);
        points = mesh.vertices;
    } else if (const auto* sphere = std::get_if<Sphere>(&shape)) {
        for (const Vec3& axis : axes) points.push_back(sphere->center + sphere->radius * axis);
    } else if (const auto* harmonics = std::get_if<Harmonics>(&shape)) {
        for (const Vec3& axis : axes) points.push_back(harmonics->point_towards(axis));
    }
    return points;
}

}  // namespace

std::optional<materials::Medium> glass_medium(const Scene& scene, const Object& object,
                                              std::uint32_t triangle) {
    const MaterialId id = object.materials.size() > 1 ? object.materials[triangle] : object.materials[0];
    return materials::medium_inside(scene.material(id));
}

GlassBodies find_glass_bodies(const Scene& scene) { return GlassSearch(scene).run(); }

std::vector<Vec3> GlassBody::some_points(const Scene& scene) const {
    if (parts.empty()) return points_of(scene.object(object).shape);
    constexpr std::size_t most_of_part = 8;
    std::vector<Vec3> points;
    for (const Part& part : parts) {
        const std::size_t count = part.triangles->size();
        for (std::size_t i = 0; i < count; i += (count + most_of_part - 1) / most_of_part) {
            const Corners c = corners_at(scene.object(part.object).shape, (*part.triangles)[i]);
            points.push_back((c[0] + c[1] + c[2]) / 3);
        }
    }
    return points;
}

bool GlassBody::contains(const Vec3& point, const Scene& scene) const {
    const Vec3 above = point - bounds.min, below = bounds.max - point;
    if (std::min({above.x, above.y, above.z, below.x, below.y, below.z}) <= 0) return false;
    const Shape& shape = scene.object(object).shape;
    if (parts.empty()) {
        if (const auto* sphere = std::get_if<Sphere>(&shape))
            return length(point - sphere->center) < sphere->radius;
        const auto* harmonics = std::get_if<Harmonics>(&shape);
        if (!harmonics) return true;  // a box, which is its bounds
        const Vec3 from_center = point - harmonics->center;
        return length(from_center) < length(harmonics->point_towards(from_center) - harmonics->center);
    }
    bool is_inside = false;
    for (const Part& part : parts) {
        const Shape& of_part = scene.object(part.object).shape;
        for (const std::uint32_t t : *part.triangles) {
            if (meets(point, corners_at(of_part, t))) is_inside = !is_inside;
        }
    }
    return is_inside;
}

}  // namespace stilb::scene
