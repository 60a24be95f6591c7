
#include "patches/patches.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <unordered_map>
#include <utility>

#include "base/parallel.h"
#include "geometry/harmonics/surface.h"
#include "geometry/mesh_topology.h"
#include "patches/patch_collector.h"
#include "patches/refinement.h"
#include "stilb/error.h"

namespace stilb::patches {

namespace {

/// The area of a patch in squares of the longest edge, approximately: halving leaves edges between half of
/// the limit and the limit.
constexpr double kMeanArea = 0.2;

/// The division of a shape: its starting mesh, the limit of its edges, and the positions of new vertices.
struct Division {
    Mesh coarse;
    double longest_edge_m;
    MiddleOf middle_of = [](const Vec3& a, const Vec3& b) { return 0.5 * (a + b); };
};

Division division_of(const Mesh& mesh, double longest_edge_m) {
    const std::vector<std::uint32_t> vertex_at = geometry::welded(mesh.vertices);
    Division division{{mesh.vertices, mesh.triangles}, longest_edge_m};
    for (Triangle& t : division.coarse.triangles) t = {vertex_at[t[0]], vertex_at[t[1]], vertex_at[t[2]]};
    return division;
}
Division division_of(const Instance& instance, double longest_edge_m) {
    return division_of(triangulated(instance), longest_edge_m);
}
Division division_of(const Rectangle& rectangle, double longest_edge_m) {
    return {triangulated(rectangle), longest_edge_m};
}
Division division_of(const Box& box, double longest_edge_m) { return {triangulated(box), longest_edge_m}; }

Division division_of(const Sphere& sphere, double longest_edge_m) {
    return {inscribed_icosahedron(sphere), std::min(longest_edge_m, kLongestCurvedEdge * sphere.radius),
            [sphere](const Vec3& a, const Vec3& b) {
                const Vec3 outwards = (a - sphere.center) + (b - sphere.center);
                return sphere.center + sphere.radius * normalized(outwards);
            }};
}

Division division_of(const Harmonics& harmonics, double longest_edge_m) {
    const double radius_m = harmonics.scale * harmonics.surface->greatest_radius();
    return {inscribed_icosahedron(harmonics), std::min(longest_edge_m, kLongestCurvedEdge * radius_m),
            [harmonics](const Vec3& a, const Vec3& b) {
                return harmonics.point_towards((a - harmonics.center) + (b - harmonics.center));
            }};
}

/// Six triangles about the middle. Only edges along the rim have both ends on it, and those that halve them.
Division division_of(const Disk& disk, double longest_edge_m) {
    const Frame frame = Frame::around(disk.normal);
    Mesh mesh{{disk.center}, {}};
    for (std::uint32_t i = 0; i < 6; ++i) {
        const double angle = i * std::numbers::pi / 3;
        mesh.vertices.push_back(disk.center +
                                disk.radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v));
        mesh.triangles.push_back({0, i + 1, (i + 1) % 6 + 1});
    }
    return {std::move(mesh), std::min(longest_edge_m, kLongestCurvedEdge * disk.radius),
            [disk](const Vec3& a, const Vec3& b) {
                const Vec3 middle = 0.5 * (a + b) - disk.center;
                const double inner = 0.999999 * disk.radius;
                const auto is_on_rim = [&](const Vec3& p) { return length(p - disk.center) > inner; };
                if (!is_on_rim(a) || !is_on_rim(b)) return disk.center + middle;
                return disk.center + disk.radius * normalized(middle);
            }};
}

void check_size(const Scene& scene, double longest_edge_m) {
    if (!(longest_edge_m > 0) || !std::isfinite(longest_edge_m)) {
        throw InputError(
            fmt::format("the patch size is {} m, but must be above 0; "
                        "about {:.2g} m gives 10,000 patches here.",
                        longest_edge_m, patch_size_m(scene)));
    }
    const double about = surface_area_m2(scene) / (kMeanArea * longest_edge_m * longest_edge_m);
    if (about > static_cast<double>(kMostPatches)) {
        const Object& largest =
            std::ranges::max(scene.objects, {}, [](const Object& object) { return area_m2(object.shape); });
        throw InputError(fmt::format(
            "a patch size of {} m would give about {:.1g} patches, more than the limit of {}: object "
            "\"{}\" has {:.2g} % of the area. Leave it out if it matters to nothing, or use {:.2g} m or "
            "more.",
            longest_edge_m, about, kMostPatches, largest.name,
            100 * area_m2(largest.shape) / surface_area_m2(scene),
            patch_size_m(scene, static_cast<double>(kMostPatches))));
    }
}

}  // namespace

ObjectId Patches::object_of(std::uint32_t patch) const {
    const auto after = std::ranges::upper_bound(first_of_object, patch);
    return ObjectId{static_cast<std::uint32_t>(after - first_of_object.begin() - 1)};
}

Vec3 Patches::position(std::uint32_t patch, const math::Barycentric& barycentric) const {
    const auto& [a, b, c] = corners[patch];
    return center + barycentric.b0 * Vec3(vertices[a]) + barycentric.b1 * Vec3(vertices[b]) +
           barycentric.b2 * Vec3(vertices[c]);
}

Vec3 Patches::middle(std::uint32_t patch) const { return position(patch, {1. / 3, 1. / 3, 1. / 3}); }

Vec3 Patches::normal_of(std::uint32_t side) const {
    const Vec3 normal(normals[patch_of(side)]);
    return is_front(side) ? normal : -normal;
}

namespace {

std::vector<Division> divisions_of(const Scene& scene, double longest_edge_m) {
    std::vector<Division> divisions;
    for (const Object& object : scene.objects) {
        divisions.push_back(
            std::visit([&](const auto& shape) { return division_of(shape, longest_edge_m); }, object.shape));
    }
    return divisions;
}

Vec3 center_of(const std::vector<Division>& divisions, const std::optional<Vec3>& exact_at) {
    Bounds bounds;
    for (const Division& division : divisions) {
        for (const Vec3& vertex : division.coarse.vertices) bounds.include(vertex);
    }
    if (bounds.is_empty()) return {};
    return exact_at && bounds.half_extent() > scene::kLargeHalfExtent_m ? *exact_at : bounds.middle();
}

RefinedMesh refined(const Division& division) {
    return patches::refined(division.coarse, division.longest_edge_m, division.middle_of);
}

}  // namespace

Patches make_patches(const Scene& scene, double longest_edge_m, const Monitor& monitor,
                     const std::optional<Vec3>& exact_at) {
    check_size(scene, longest_edge_m);
    const std::vector<Division> divisions = divisions_of(scene, longest_edge_m);
    Patches patches;
    patches.center = center_of(divisions, exact_at);
    PatchCollector collector(patches);
    Stage stage(monitor, "patches", divisions.size());
    for (std::size_t i = 0; i < divisions.size(); ++i) {
        collector.add(refined(divisions[i]), scene.objects[i].materials);
        stage.advance();
    }
    return patches;
}

namespace {

using EdgeLimits = std::unordered_map<std::uint64_t, double>;

/// An object on its way from patches to finer ones.
struct RefinedObject {
    Division division;
    RefinedMesh patches;                   ///< the triangles of the patches, and some without area
    std::vector<std::uint32_t> number_of;  ///< per triangle of `patches`: the patch before or at it
    RefinedMesh fine;                      ///< its parents are triangles of `patches`
    std::map<Triangle, double> limits{};   ///< of the triangles of `fine` before the last halving
};

/// The limits of all triangles; those that were halved last are new.
std::vector<double> limits_of_triangles(RefinedObject& object, const LongestEdge& longest_edge_m) {
    constexpr std::size_t at_once = 64;
    const Mesh& mesh = object.fine.mesh;
    std::vector<double> limits;
    std::vector<std::size_t> unknown;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto known = object.limits.find(mesh.triangles[i]);
        limits.push_back(known == object.limits.end() ? 0 : known->second);
        if (known == object.limits.end()) unknown.push_back(i);
    }
    const auto look = [&](std::size_t first, std::size_t last) {
        for (const std::size_t i : std::span(unknown).subspan(first, last - first)) {
            const auto [a, b, c] = mesh.triangles[i];
            limits[i] = longest_edge_m(object.number_of[object.fine.parents[i]],
                                       {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
        }
    };
    parallel_for_parts(unknown.size(), look, at_once);
    object.limits.clear();
    for (std::size_t i = 0; i < limits.size(); ++i) object.limits.emplace(mesh.triangles[i], limits[i]);
    return limits;
}

/// For each edge, the shortest of the limits of the triangles that share it.
EdgeLimits limits_of(RefinedObject& object, const LongestEdge& longest_edge_m) {
    const Mesh& mesh = object.fine.mesh;
    const std::vector<double> limits = limits_of_triangles(object, longest_edge_m);
    EdgeLimits of_edges;
    for (std::size_t i = 0; i < limits.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Triangle& t = mesh.triangles[i];
            const auto [found, is_new] = of_edges.try_emplace(edge_key(t[k], t[(k + 1) % 3]), limits[i]);
            if (!is_new) found->second = std::min(found->second, limits[i]);
        }
    }
    return of_edges;
}

/// Halves the edges that are longer than the limit once; returns whether there were any.
bool halve_once(RefinedObject& object, const LongestEdge& longest_edge_m) {
    const EdgeLimits limits = limits_of(object, longest_edge_m);
    return halve_edges(
        object.fine,
        [&](const Edge& edge) {
            const double limit_m = limits.at(edge_key(edge.a, edge.b));
            return edge.squared_length_m2 > limit_m * limit_m;
        },
        object.division.middle_of);
}

std::vector<RefinedObject> objects_of(const Scene& scene, double longest_edge_m) {
    std::vector<RefinedObject> objects;
    Patches again;
    PatchCollector collector(again);
    for (Division& division : divisions_of(scene, longest_edge_m)) {
        RefinedMesh patches = refined(division);
        RefinedMesh fine = unrefined(patches.mesh);
        const auto first = static_cast<std::uint32_t>(again.count());
        std::vector<std::uint32_t> number_of(patches.parents.size(), first);
        const auto kept = collector.add(patches, scene.objects[objects.size()].materials);
        for (std::uint32_t i = 0; i < kept.size(); ++i) number_of[kept[i]] = first + i;
        objects.push_back({std::move(division), std::move(patches), std::move(number_of), std::move(fine)});
    }
    return objects;
}

std::size_t count_of(const std::vector<RefinedObject>& objects) {
    std::size_t count = 0;
    for (const RefinedObject& object : objects) count += object.fine.parents.size();
    return count;
}

}  // namespace

FinePatches make_fine_patches(const Scene& scene, double size_m, const LongestEdge& longest_edge_m,
                              std::size_t most, const Monitor& monitor, const std::optional<Vec3>& exact_at) {
    constexpr std::uint64_t most_rounds = 8;
    std::vector<RefinedObject> objects = objects_of(scene, size_m);
    Stage stage(monitor, "finer patches", most_rounds * objects.size());
    bool has_changed = true;
    for (std::uint64_t round = 0; round < most_rounds && has_changed; ++round) {
        has_changed = false;
        for (RefinedObject& object : objects) {
            if (count_of(objects) < most && halve_once(object, longest_edge_m)) has_changed = true;
            stage.advance();
        }
    }
    FinePatches fine;
    std::vector<Division> divisions;
    for (const RefinedObject& object : objects) divisions.push_back(object.division);
    fine.patches.center = center_of(divisions, exact_at);
    PatchCollector collector(fine.patches);
    for (std::size_t o = 0; o < objects.size(); ++o) {
        const RefinedObject& object = objects[o];
        RefinedMesh whole{object.fine.mesh, {}};
        for (const std::uint32_t parent : object.fine.parents)
            whole.parents.push_back(object.patches.parents[parent]);
        for (const std::uint32_t i : collector.add(whole, scene.objects[o].materials))
            fine.parents.push_back(object.number_of[object.fine.parents[i]]);
    }
    return fine;
}

Bounds bounds_of(const Patches& patches) {
    Bounds bounds;
    for (const Float3& vertex : patches.vertices) bounds.include(Vec3(vertex));
    return bounds;
}

double patch_size_m(const Scene& scene, double count) {
    return std::sqrt(surface_area_m2(scene) / (kMeanArea * count));
}

}  // namespace stilb::patches
