#include "patches/patches.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "geometry/harmonics/surface.h"
#include "geometry/mesh_edges.h"
#include "patches/refinement.h"
#include "patches/smooth_vertices.h"

namespace stilb::patches {
namespace {

/// The area of a patch in squares of the longest edge, about: halving leaves edges anywhere between half of
/// it and all of it.
constexpr double kMeanArea = 0.2;

/// How a shape is divided: from what, how finely at most, and where new vertices go.
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
            fmt::format("the patch size is {} m: edges of patches have a length. It must be above 0; "
                        "about {:.2g} m makes 10,000 patches here.",
                        longest_edge_m, patch_size_m(scene)));
    }
    const double about = surface_area_m2(scene) / (kMeanArea * longest_edge_m * longest_edge_m);
    if (about > static_cast<double>(kMostPatches)) {
        throw InputError(fmt::format(
            "a patch size of {} m would make about {:.1g} patches, more than the {} that "
            "there may be. Take {:.2g} m or more.",
            longest_edge_m, about, kMostPatches, patch_size_m(scene, static_cast<double>(kMostPatches))));
    }
}

/// Adds one object after another.
class Collector {
  public:
    explicit Collector(Patches& patches) : patches_(patches) {}

    void add(const Object& object, const Division& division) {
        const RefinedMesh fine = refined(division.coarse, division.longest_edge_m, division.middle_of);
        triangles_.clear();
        normals_.clear();
        const std::size_t first = patches_.count();
        for (std::size_t i = 0; i < fine.parents.size(); ++i) {
            const std::size_t parent = object.materials.size() == 1 ? 0 : fine.parents[i];
            add_triangle(fine.mesh, fine.mesh.triangles[i], object.materials[parent]);
        }
        const auto smooth =
            divide_at_creases(triangles_, normals_, std::span(patches_.materials).subspan(first));
        const auto before = static_cast<std::uint32_t>(patches_.vertices.size());
        for (const std::uint32_t vertex : smooth.original) {
            patches_.vertices.push_back(in_floats(fine.mesh.vertices[vertex] - patches_.center));
        }
        for (const Triangle& t : smooth.triangles) {
            patches_.corners.push_back({t[0] + before, t[1] + before, t[2] + before});
        }
        patches_.first_of_object.push_back(static_cast<std::uint32_t>(patches_.count()));
    }

  private:
    static Float3 in_floats(const Vec3& v) {
        return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    }

    void add_triangle(const Mesh& mesh, const Triangle& t, MaterialId material) {
        const Vec3& a = mesh.vertices[t[0]];
        const Vec3 doubled = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
        const double doubled_area = length(doubled);
        if (!(static_cast<float>(doubled_area) > 0)) return;
        triangles_.push_back(t);
        normals_.push_back(doubled / doubled_area);
        patches_.normals.push_back(in_floats(normals_.back()));
        patches_.areas_m2.push_back(static_cast<float>(doubled_area / 2));
        patches_.materials.push_back(material);
    }

    Patches& patches_;
    std::vector<Triangle> triangles_;  ///< of the object, by its own vertices
    std::vector<Vec3> normals_;
};

}  // namespace

ObjectId Patches::object_of(std::uint32_t patch) const {
    const auto after = std::ranges::upper_bound(first_of_object, patch);
    return ObjectId{static_cast<std::uint32_t>(after - first_of_object.begin() - 1)};
}

Vec3 Patches::position(std::uint32_t patch, const math::Barycentric& place) const {
    const auto& [a, b, c] = corners[patch];
    return center + place.b0 * Vec3(vertices[a]) + place.b1 * Vec3(vertices[b]) +
           place.b2 * Vec3(vertices[c]);
}

Vec3 Patches::middle(std::uint32_t patch) const { return position(patch, {1. / 3, 1. / 3, 1. / 3}); }

Vec3 Patches::normal_of(std::uint32_t side) const {
    const Vec3 normal(normals[patch_of(side)]);
    return is_front(side) ? normal : -normal;
}

Patches make_patches(const Scene& scene, double longest_edge_m, const Monitor& monitor) {
    check_size(scene, longest_edge_m);
    std::vector<Division> divisions;
    Bounds bounds;
    for (const Object& object : scene.objects) {
        divisions.push_back(
            std::visit([&](const auto& shape) { return division_of(shape, longest_edge_m); }, object.shape));
        for (const Vec3& vertex : divisions.back().coarse.vertices) bounds.include(vertex);
    }
    Patches patches;
    if (!bounds.is_empty()) patches.center = 0.5 * (bounds.min + bounds.max);
    Collector collector(patches);
    Stage stage(monitor, "patches", divisions.size());
    for (std::size_t i = 0; i < divisions.size(); ++i) {
        collector.add(scene.objects[i], divisions[i]);
        stage.advance();
    }
    return patches;
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
