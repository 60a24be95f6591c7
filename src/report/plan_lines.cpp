#include "report/plan_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "geometry/horizontal_section.h"
#include "geometry/mesh_topology.h"

namespace stilb::report {
namespace {

/// Below this cosine to the vertical a face is a side, else a top or bottom.
constexpr double kSideCosine = 0.1;
/// Tops that meet at a larger angle have an edge between them (the cosine).
constexpr double kCreaseCosine = 0.87;
/// Visibility is looked up for pieces of this length, a little beside the edges [m].
constexpr double kPiece_m = 0.05, kBeside_m = 1e-3;
/// The size of things that are left out, as a share of the plan's.
constexpr double kTooSmall = 0.01;

double horizontal_length(const Vec3& v) { return std::hypot(v.x, v.y); }
PlanPoint from_above(const Vec3& p) { return {p.x, p.y}; }

/// The extent of each connected component from above.
std::vector<double> component_sizes(const Mesh& mesh, const geometry::ConnectedComponents& components) {
    std::vector<Bounds> bounds(components.count());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t corner : mesh.triangles[t])
            bounds[components.of_triangle[t]].include(mesh.vertices[corner]);
    }
    std::vector<double> sizes;
    for (const Bounds& of : bounds) sizes.push_back(horizontal_length(of.max - of.min));
    return sizes;
}

/// The lines of one object after the other.
class Section {
  public:
    Section(const rays::RayCaster& caster, double height_m, double least_m)
        : caster_(caster), least_m_(least_m), lines_{height_m, {}, {}} {}

    void add(const Mesh& mesh) {
        const geometry::ConnectedComponents components = geometry::find_components(mesh);
        const std::vector<double> sizes = component_sizes(mesh, components);
        const auto is_small = [&](std::uint32_t triangle) {
            return sizes[components.of_triangle[triangle]] < least_m_;
        };
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            if (!is_small(t)) add_cut(mesh, mesh.triangles[t]);
        }
        geometry::Edges(mesh).for_each([&](auto first, auto last) {
            if (!is_small(first->triangle) && is_drawn(mesh, {first, last}))
                add_seen(mesh.vertices[first->low], mesh.vertices[first->high]);
        });
    }
    PlanLines finish() && { return std::move(lines_); }

  private:
    void add_cut(const Mesh& mesh, const Triangle& triangle) {
        if (const auto cut = geometry::cut_at(mesh, triangle, lines_.height_m))
            lines_.cut.push_back({from_above((*cut)[0]), from_above((*cut)[1])});
    }

    /// Whether an edge bounds a top, or lies between two that are tilted against each other.
    static bool is_drawn(const Mesh& mesh, std::span<const geometry::EdgeUse> uses) {
        std::vector<Vec3> normals;
        std::size_t tops = 0;
        for (const geometry::EdgeUse& use : uses) {
            const auto [a, b, c] = mesh.triangles[use.triangle];
            const Vec3 across =
                cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
            if (squared_length(across) == 0) return false;
            normals.push_back(normalized(across));
            if (std::abs(normals.back().z) > kSideCosine) ++tops;
        }
        if (tops == 0) return false;
        if (normals.size() != 2 || tops == 1) return true;
        return std::abs(dot(normals[0], normals[1])) < kCreaseCosine;
    }

    /// Adds the parts of an edge below the section that nothing hides.
    void add_seen(Vec3 from, Vec3 to) {
        const double height = lines_.height_m;
        if (from.z >= height && to.z >= height) return;
        if (from.z > height) std::swap(from, to);
        if (to.z > height) to = from + (height - from.z) / (to.z - from.z) * (to - from);
        const Vec3 along = to - from;
        const double length_m = horizontal_length(along);
        if (length_m < kBeside_m) return;
        const Vec3 aside = kBeside_m / length_m * Vec3{-along.y, along.x, 0};
        const int pieces = std::clamp(static_cast<int>(length_m / kPiece_m), 1, 1000);
        std::optional<int> first;  // of the pieces in a row that are seen
        for (int i = 0; i <= pieces; ++i) {
            const bool is_seen = i < pieces && sees(from + (i + 0.5) / pieces * along, aside);
            if (is_seen && !first) first = i;
            if (is_seen || !first) continue;
            lines_.seen.push_back({from_above(from + *first / double(pieces) * along),
                                   from_above(from + i / double(pieces) * along)});
            first.reset();
        }
    }

    /// Whether the place on one of both sides of an edge is open to above.
    bool sees(const Vec3& edge, const Vec3& aside) const {
        for (const Vec3& start : {edge + aside, edge - aside}) {
            const Vec3 above{start.x, start.y, start.z + kBeside_m}, top{start.x, start.y, lines_.height_m};
            if (above.z >= top.z || !caster_.occluded(above, top)) return true;
        }
        return false;
    }

    const rays::RayCaster& caster_;
    double least_m_;
    PlanLines lines_;
};

}  // namespace

double usual_plan_height(const Bounds& bounds) {
    constexpr double kAboveFloor_m = 1.2;
    return bounds.min.z + std::min(kAboveFloor_m, (bounds.max.z - bounds.min.z) / 2);
}

PlanLines plan_lines(const Scene& scene, const rays::RayCaster& caster, double height_m) {
    const std::set<ObjectId> lamps = scene::lamps_of(scene);
    const Bounds bounds = scene::bounds_of(scene);
    Section section(caster, height_m,
                    kTooSmall * std::max(bounds.max.x - bounds.min.x, bounds.max.y - bounds.min.y));
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        if (!lamps.contains(ObjectId{i})) section.add(geometry::drawn_as_mesh(scene.objects[i].shape));
    }
    return std::move(section).finish();
}

std::vector<PlanPoint> outline_from_above(const Shape& shape) {
    std::vector<PlanPoint> points;
    for (const Vec3& vertex : geometry::drawn_as_mesh(shape).vertices) points.push_back(from_above(vertex));
    std::ranges::sort(points, [](const PlanPoint& a, const PlanPoint& b) {
        return std::pair(a.x, a.y) < std::pair(b.x, b.y);
    });
    // The lower and then the upper half of the hull [Andrew 1979].
    std::vector<PlanPoint> hull;
    const auto turns_left = [](const PlanPoint& a, const PlanPoint& b, const PlanPoint& c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0;
    };
    for (int half = 0; half < 2; ++half) {
        const std::size_t start = hull.size();
        for (const PlanPoint& point : points) {
            while (hull.size() >= start + 2 && !turns_left(hull[hull.size() - 2], hull.back(), point))
                hull.pop_back();
            hull.push_back(point);
        }
        hull.pop_back();
        std::ranges::reverse(points);
    }
    return hull;
}

}  // namespace stilb::report
