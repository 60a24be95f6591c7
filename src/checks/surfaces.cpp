
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "base/vec.h"
#include "checks/checks.h"

namespace stilb::checks {

namespace {

/// The largest vector area, as a share of the area, of a nearly closed surface. The vector area of a closed
/// surface is 0; that of an open one is the area of its holes, if flat. A box without a lid (0.2 of its area,
/// or more for a flat one) is open on purpose.
constexpr double kLargestHole = 0.05;

struct Hole {
    std::size_t components = 0, edges = 0;
};

Hole holes_of(const Mesh& mesh, const geometry::ConnectedComponents& components) {
    std::vector<Vec3> vector_area(components.count());
    std::vector<double> area(components.count());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        const Vec3 doubled = cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
        vector_area[components.of_triangle[t]] += doubled;
        area[components.of_triangle[t]] += length(doubled);
    }
    Hole hole;
    for (std::uint32_t s = 0; s < components.count(); ++s) {
        if (components.is_closed(s) || length(vector_area[s]) > kLargestHole * area[s]) continue;
        ++hole.components;
        hole.edges += components.open_edges[s];
    }
    return hole;
}

}  // namespace

std::vector<std::string> hole_warnings(const Scene& scene,
                                       const std::vector<geometry::ConnectedComponents>& components) {
    std::vector<std::string> warnings;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        const auto* mesh = std::get_if<Mesh>(&object.shape);
        if (mesh == nullptr) continue;
        const Hole hole = holes_of(*mesh, components[i]);
        if (hole.components == 0) continue;
        const std::string which =
            components[i].count() == 1
                ? "it nearly closes"
                : fmt::format("{} of its {} parts nearly close", hole.components, components[i].count());
        warnings.push_back(fmt::format(
            "object \"{}\": {}, except for {} open edges: light passes through the holes. Close them, "
            "or leave them "
            "if they are meant.",
            object.name, which, hole.edges));
    }
    for (const Light& light : scene.lights) {
        const auto surface = lights::surface_emission(light);
        if (!surface || components[index_of(surface->object)].turned_edges == 0) continue;
        warnings.push_back(fmt::format(
            "light \"{}\": at {} edges of object \"{}\" the front changes sides, but only fronts emit light. "
            "Turn "
            "its triangles to one side.",
            light.name, components[index_of(surface->object)].turned_edges,
            scene.object(surface->object).name));
    }
    return warnings;
}

namespace {

/// The smallest overlap that counts, as a share of the smaller triangle.
constexpr double kLeastShare = 1e-3;
/// Quantisation steps of normals and (times the scene's size) distances of planes.
constexpr double kPlaneStep = 4e-6;

struct Point2 {
    double u = 0, v = 0;
};
using Polygon2 = std::vector<Point2>;

double doubled_area(const Point2& a, const Point2& b, const Point2& c) {
    return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

/// A triangle in its plane, projected along the axis that the plane faces most.
struct FlatTriangle {
    std::array<std::int64_t, 4> plane{};  ///< quantised normal and distance from the origin
    ObjectId object{};
    MaterialId material{};
    bool is_emitter = false;
    std::size_t axis = 0;
    Vec3 normal, vertex;
    std::array<Point2, 3> corners{};  ///< counterclockwise
    Point2 min, max;

    bool looks_like(const FlatTriangle& other) const {
        const bool same_emission = is_emitter == other.is_emitter && (!is_emitter || object == other.object);
        return material == other.material && same_emission;
    }
};

std::size_t dominant_axis(const Vec3& n) {
    const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

FlatTriangle flattened(const std::array<Vec3, 3>& corners, double size_m) {
    FlatTriangle flat;
    flat.normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
    flat.axis = dominant_axis(flat.normal);
    if (flat.normal[flat.axis] < 0) flat.normal = -flat.normal;  // the same for both sides
    flat.vertex = corners[0];
    const auto quantised = [](double value) { return std::llround(value / kPlaneStep); };
    flat.plane = {quantised(flat.normal.x), quantised(flat.normal.y), quantised(flat.normal.z),
                  quantised(dot(flat.normal, flat.vertex) / size_m)};
    for (std::size_t i = 0; i < 3; ++i)
        flat.corners[i] = {corners[i][(flat.axis + 1) % 3], corners[i][(flat.axis + 2) % 3]};
    auto& [a, b, c] = flat.corners;
    if (doubled_area(a, b, c) < 0) std::swap(b, c);
    flat.min = {std::min({a.u, b.u, c.u}), std::min({a.v, b.v, c.v})};
    flat.max = {std::max({a.u, b.u, c.u}), std::max({a.v, b.v, c.v})};
    return flat;
}

/// Triangles of flat shapes except disks; curved shapes are left out.
Mesh mesh_of(const Shape& shape) {
    if (const auto* mesh = std::get_if<Mesh>(&shape)) return *mesh;
    if (const auto* rectangle = std::get_if<Rectangle>(&shape)) return triangulated(*rectangle);
    if (const auto* box = std::get_if<Box>(&shape)) return triangulated(*box);
    return {};
}

/// All triangles of the scene, grouped by plane, from left to right.
std::vector<FlatTriangle> flat_triangles(const Scene& scene) {
    std::vector<bool> is_emitter(scene.objects.size());
    for (const Light& light : scene.lights) {
        if (const auto surface = lights::surface_emission(light))
            is_emitter[index_of(surface->object)] = true;
    }
    std::vector<Mesh> meshes;
    Bounds bounds;
    for (const Object& object : scene.objects) {
        meshes.push_back(mesh_of(object.shape));
        for (const Vec3& vertex : meshes.back().vertices) bounds.include(vertex);
    }
    const double size_m = bounds.is_empty() ? 1 : length(bounds.max - bounds.min);
    std::vector<FlatTriangle> triangles;
    for (std::uint32_t i = 0; i < meshes.size(); ++i) {
        const auto& materials = scene.objects[i].materials;
        for (std::size_t t = 0; t < meshes[i].triangles.size(); ++t) {
            const auto [a, b, c] = meshes[i].triangles[t];
            const auto& vertices = meshes[i].vertices;
            FlatTriangle& flat =
                triangles.emplace_back(flattened({vertices[a], vertices[b], vertices[c]}, size_m));
            flat.object = ObjectId{i};
            flat.material = materials.size() == 1 ? materials[0] : materials[t];
            flat.is_emitter = is_emitter[i];
        }
    }
    std::sort(triangles.begin(), triangles.end(), [](const FlatTriangle& a, const FlatTriangle& b) {
        return std::tie(a.plane, a.min.u) < std::tie(b.plane, b.min.u);
    });
    return triangles;
}

/// The part of the convex `polygon` to the left of the line from `a` to `b` [Sutherland and Hodgman 1974].
Polygon2 clipped(const Polygon2& polygon, const Point2& a, const Point2& b) {
    Polygon2 result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double at_p = doubled_area(a, b, p), at_q = doubled_area(a, b, q);
        if (at_p >= 0) result.push_back(p);
        if ((at_p >= 0) != (at_q >= 0)) {
            const double t = at_p / (at_p - at_q);
            result.push_back({p.u + t * (q.u - p.u), p.v + t * (q.v - p.v)});
        }
    }
    return result;
}

/// A point in the overlap of both triangles, in the plane of the first.
std::optional<Vec3> shared_point(const FlatTriangle& first, const FlatTriangle& second) {
    const auto& [a, b, c] = second.corners;
    const Polygon2 whole(first.corners.begin(), first.corners.end());
    const Polygon2 shared = clipped(clipped(clipped(whole, a, b), b, c), c, a);
    double doubled = 0;
    Point2 middle;
    for (std::size_t i = 0; i < shared.size(); ++i) {
        if (i >= 2) doubled += doubled_area(shared[0], shared[i - 1], shared[i]);
        const auto n = static_cast<double>(shared.size());
        middle = {middle.u + shared[i].u / n, middle.v + shared[i].v / n};
    }
    const double smaller = std::min(doubled_area(whole[0], whole[1], whole[2]), doubled_area(a, b, c));
    if (!(doubled > kLeastShare * smaller)) return std::nullopt;
    // The coordinate along the axis follows from the plane.
    const std::size_t w = first.axis, u = (w + 1) % 3, v = (w + 2) % 3;
    const Vec3& n = first.normal;
    const double along = (dot(n, first.vertex) - n[u] * middle.u - n[v] * middle.v) / n[w];
    std::array<double, 3> p{};
    p[w] = along, p[u] = middle.u, p[v] = middle.v;
    return Vec3{p[0], p[1], p[2]};
}

}  // namespace

std::vector<Overlap> find_overlaps(const Scene& scene) {
    const std::vector<FlatTriangle> triangles = flat_triangles(scene);
    std::vector<Overlap> overlaps;
    for (auto first = triangles.begin(); first != triangles.end(); ++first) {
        for (auto second = first + 1; second != triangles.end(); ++second) {
            if (second->plane != first->plane || second->min.u >= first->max.u) break;
            if (second->min.v >= first->max.v || second->max.v <= first->min.v) continue;
            if (first->looks_like(*second)) continue;
            const auto shared = shared_point(*first, *second);
            if (!shared) continue;
            const auto [a, b] = std::minmax(first->object, second->object);
            overlaps.push_back({a, b, *shared, first->normal});
            if (overlaps.size() == kMostOverlaps) return overlaps;
        }
    }
    return overlaps;
}

std::vector<std::string> overlap_warnings(const Scene& scene, const rays::RayCaster& caster,
                                          const Enclosures& enclosures) {
    const auto is_lit = [&](const Overlap& overlap) {
        const Vec3 offset = 2 * caster.offset_m(overlap.position, caster.half_extent_m()) * overlap.normal;
        return enclosures.is_lit(enclosures.enclosure_of({overlap.position + offset, overlap.normal})) ||
               enclosures.is_lit(enclosures.enclosure_of({overlap.position - offset, -overlap.normal}));
    };
    struct Found {
        std::size_t count = 0;
        Vec3 where;
    };
    std::map<std::pair<ObjectId, ObjectId>, Found> found;
    const std::vector<Overlap> overlaps = find_overlaps(scene);
    const char* at_least = overlaps.size() == kMostOverlaps ? "at least " : "";
    for (const Overlap& overlap : overlaps) {
        if (!is_lit(overlap)) continue;
        Found& pair = found[{overlap.first, overlap.second}];
        if (pair.count++ == 0) pair.where = overlap.position;
    }
    std::vector<std::string> warnings;
    for (const auto& [objects, pair] : found) {
        const std::string& first = scene.object(objects.first).name;
        const std::string& second = scene.object(objects.second).name;
        const std::string named = first == second ? fmt::format("object \"{}\": parts of it", first)
                                                  : fmt::format("objects \"{}\" and \"{}\"", first, second);
        warnings.push_back(fmt::format(
            "{} overlap in one plane ({}{} pair{} of triangles, one at ({:.4g}, {:.4g}, {:.4g})): rounding "
            "decides "
            "which of them light meets. Move one of them by a millimetre.",
            named, at_least, pair.count, pair.count == 1 ? "" : "s", pair.where.x, pair.where.y,
            pair.where.z));
    }
    return warnings;
}

}  // namespace stilb::checks
