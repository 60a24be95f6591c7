#include "scene/overlaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "base/rays.h"
#include "base/vec.h"
#include "geometry/mesh_topology.h"
#include "materials/solid.h"
#include "scene/instances.h"

namespace stilb::scene {
namespace {

/// The smallest overlap that counts, as a share of the smaller triangle.
constexpr double kLeastShare = 1e-3;
/// The distance of a lamp that was put in front of a surface, in units of the offset of lifted points.
constexpr double kLampGap = 2;
/// Surfaces up to this distance apart overlap, in the same unit. A little above kLampGap, so that lamps that
/// were put in front of a surface are still found, and named in a warning.
constexpr double kLargestGap = 2.25;
/// Triangles at larger angles (the cosine of half a degree) lie in different planes, however small they are.
constexpr double kLeastCosine = 0.99996;
/// Lists of triangles up to this length are compared pair by pair.
constexpr std::size_t kFew = 16;
/// Where triangles extend over more than this share of their box on average, it is not divided further.
constexpr double kLongestShare = 0.3;
constexpr int kDeepest = 48;

/// Around the lamps: what is far from them changes nothing.
Lift lift_of_lamps(const Scene& scene) {
    std::vector<Vec3> lamps;
    for (const Light& light : scene.lights) {
        if (lights::emitting_object(light)) lamps.push_back(*place_of(scene, light));
    }
    return lift_of(scene, lamps);
}

/// The offset of lifted points at a place where lamps may lie in front of a surface. Half a millimetre is
/// more than rounding for kilometres, and far things change no more where the centre of ray queries is
/// elsewhere.
double offset_m(const Lift& lift, const Vec3& place) {
    return std::min(lift.offset_m(place, lift.largest_size_m()), lift.common_offset_m());
}

}  // namespace

Mesh flat_mesh(const Shape& shape) {
    if (const auto* instance = std::get_if<Instance>(&shape)) return triangulated(*instance);
    if (const auto* rectangle = std::get_if<Rectangle>(&shape)) return triangulated(*rectangle);
    if (const auto* box = std::get_if<Box>(&shape)) return triangulated(*box);
    const auto* disk = std::get_if<Disk>(&shape);
    if (disk == nullptr) return {};
    constexpr std::uint32_t corners = 24;
    const Frame frame = Frame::around(disk->normal);
    Mesh mesh;
    for (std::uint32_t i = 0; i < corners; ++i) {
        const double angle = 2 * kPi * i / corners;
        mesh.vertices.push_back(disk->center +
                                disk->radius * (std::cos(angle) * frame.u + std::sin(angle) * frame.v));
        if (i >= 2) mesh.triangles.push_back({0, i - 1, i});
    }
    return mesh;
}

namespace {

struct Point2 {
    double u = 0, v = 0;
};
using Polygon2 = std::vector<Point2>;
using Corners = std::array<Vec3, 3>;

double doubled_area(const Point2& a, const Point2& b, const Point2& c) {
    return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

std::size_t dominant_axis(const Vec3& n) {
    const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

/// A triangle projected along an axis, counterclockwise.
Polygon2 projected(const Corners& corners, std::size_t axis) {
    Polygon2 flat;
    for (const Vec3& corner : corners) flat.push_back({corner[(axis + 1) % 3], corner[(axis + 2) % 3]});
    if (doubled_area(flat[0], flat[1], flat[2]) < 0) std::swap(flat[1], flat[2]);
    return flat;
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

/// The polygon that two triangles share; empty where it is smaller than kLeastShare.
Polygon2 shared_part(const Polygon2& first, const Polygon2& second) {
    Polygon2 shared = first;
    for (std::size_t i = 0; i < 3; ++i) shared = clipped(shared, second[i], second[(i + 1) % 3]);
    double doubled = 0;
    for (std::size_t i = 2; i < shared.size(); ++i) {
        doubled += doubled_area(shared[0], shared[i - 1], shared[i]);
    }
    const double smaller =
        std::min(doubled_area(first[0], first[1], first[2]), doubled_area(second[0], second[1], second[2]));
    return doubled > kLeastShare * smaller ? shared : Polygon2{};
}

Vec3 normal_of(const Corners& t) { return cross(t[1] - t[0], t[2] - t[0]); }

/// The part of an overlap that depends on the two triangles alone.
struct SharedPlace {
    Vec3 middle, normal;
    double gap_m = 0;
};

std::optional<SharedPlace> shared_place(const Corners& first, const Corners& second, const Lift& lift) {
    const Vec3 normal = normal_of(first), other_normal = normal_of(second);
    const double cosine = dot(normal, other_normal) / (length(normal) * length(other_normal));
    if (!(std::abs(cosine) > kLeastCosine)) return std::nullopt;
    SharedPlace place{{}, normalized(normal)};
    const std::size_t w = dominant_axis(normal), u = (w + 1) % 3, v = (w + 2) % 3;
    const Polygon2 shared = shared_part(projected(first, w), projected(second, w));
    if (shared.empty()) return std::nullopt;
    const Vec3& n = place.normal;
    std::vector<Vec3> points;
    for (const Point2& at : shared) {
        std::array<double, 3> p{};
        p[u] = at.u, p[v] = at.v;
        p[w] = first[0][w] - (n[u] * (at.u - first[0][u]) + n[v] * (at.v - first[0][v])) / n[w];
        points.push_back({p[0], p[1], p[2]});
        place.middle += points.back() / static_cast<double>(shared.size());
    }
    const Vec3 along = std::copysign(1, cosine) * normalized(other_normal);
    const double largest_gap_m = kLargestGap * offset_m(lift, place.middle);
    place.gap_m = largest_gap_m;
    for (const Vec3& point : points) {
        const double gap_m = dot(along, point - second[0]);
        if (std::abs(gap_m) > largest_gap_m) return std::nullopt;
        place.gap_m = std::min(place.gap_m, gap_m);
    }
    return place;
}

/// Half the largest gap, along each axis.
Vec3 margin_of(const Lift& lift) {
    const double margin_m = kLargestGap * lift.common_offset_m() / 2;
    return {margin_m, margin_m, margin_m};
}

/// The triangles of the scene, and the division of space that finds those that overlap.
class OverlapSearch {
  public:
    OverlapSearch(const Scene& scene, OverlapsOf of, std::size_t most)
        : of_(of),
          most_(most),
          lift_(lift_of_lamps(scene)),
          margin_(margin_of(lift_)),
          shapes_(scene.objects.size()) {
        std::vector<bool> is_lamp(scene.objects.size());
        for (const Light& light : scene.lights) {
            if (const auto surface = lights::emitting_object(light)) is_lamp[index_of(*surface)] = true;
        }
        if (of == OverlapsOf::lamps) {
            wanted_ = {};
            for (std::size_t i = 0; i < is_lamp.size(); ++i) {
                if (!is_lamp[i]) continue;
                const Bounds lamp = geometry::bounds_of(scene.objects[i].shape);
                wanted_.include(lamp.min - margin_), wanted_.include(lamp.max + margin_);
            }
        }
        if (of == OverlapsOf::all_surfaces) pieces_.reserve(triangle_count(scene));
        for (std::uint32_t i = 0; i < scene.objects.size(); ++i) add(scene, i, is_lamp[i]);
    }

    /// All triangles of a mesh.
    OverlapSearch(const Mesh& mesh, const Lift& lift)
        : of_(OverlapsOf::all_surfaces),
          most_(std::numeric_limits<std::size_t>::max()),
          lift_(lift),
          margin_(margin_of(lift)),
          shapes_(1) {
        shapes_[0].mesh = &mesh;
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) pieces_.push_back({ObjectId{0}, t, t});
    }

    std::vector<Overlap> run() {
        std::vector<std::uint32_t> all(pieces_.size());
        std::iota(all.begin(), all.end(), 0u);
        Bounds box;
        for (const Piece& piece : pieces_) {
            const Bounds own = bounds_of(piece);
            box.include(own.min), box.include(own.max);
        }
        search(std::move(all), box, 0);
        return std::move(overlaps_);
    }

  private:
    /// Without its bounds, which are found anew from the mesh: they would take more memory than it does.
    struct Piece {
        ObjectId object{};
        std::uint32_t triangle = 0;
        std::uint32_t look = 0;  ///< the same for pieces whose overlap changes nothing
    };

    /// Of meshes: other shapes have few.
    static std::size_t triangle_count(const Scene& scene) {
        std::size_t count = 0;
        for (const Object& object : scene.objects) {
            if (const auto* mesh = std::get_if<Mesh>(&object.shape)) count += mesh->triangles.size();
        }
        return count;
    }

    void add(const Scene& scene, std::uint32_t index, bool is_lamp) {
        const Object& object = scene.objects[index];
        // The triangles of instances would take the memory that instances save.
        if (of_ == OverlapsOf::all_surfaces && std::holds_alternative<Instance>(object.shape)) return;
        if (!meet(geometry::bounds_of(object.shape), wanted_)) return;
        const auto* mesh = std::get_if<Mesh>(&object.shape);
        Shapes& shape = shapes_[index];
        if (mesh == nullptr) shape.own = flat_mesh(object.shape);
        shape.mesh = mesh ? mesh : &shape.own;
        const auto look_at = [&](MaterialId material) {
            // Of two bodies of glass each face counts, even if they have one material.
            const bool is_glass = of_ == OverlapsOf::all_surfaces &&
                                  materials::medium_inside(scene.material(material)).has_value();
            return look_of(material, is_lamp || is_glass ? index + 1 : 0);
        };
        std::uint32_t look = look_at(object.materials[0]);
        shape.is_lamp = is_lamp;
        for (std::uint32_t t = 0; t < shape.mesh->triangles.size(); ++t) {
            Piece piece{ObjectId{index}, t, look};
            if (!meet(bounds_of(piece), wanted_)) continue;
            if (object.materials.size() > 1) piece.look = look_at(object.materials[t]);
            pieces_.push_back(piece);
        }
    }

    /// With a margin of half the largest gap.
    Bounds bounds_of(const Piece& piece) const {
        Bounds bounds;
        for (const Vec3& corner : corners_of(piece)) bounds.include(corner);
        return {bounds.min - margin_, bounds.max + margin_};
    }
    bool is_lamp(const Piece& piece) const { return shapes_[index_of(piece.object)].is_lamp; }

    static bool meet(const Bounds& a, const Bounds& b) {
        return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
               a.min.z <= b.max.z && b.min.z <= a.max.z;
    }

    /// `lamp`: 0 for what is none. To find lamps all others look alike.
    std::uint32_t look_of(MaterialId material, std::uint32_t lamp) {
        if (of_ == OverlapsOf::lamps) return lamp == 0 ? 0 : 1;
        const auto next = static_cast<std::uint32_t>(looks_.size());
        return looks_.try_emplace({index_of(material), lamp}, next).first->second;
    }

    void search(std::vector<std::uint32_t> pieces, const Bounds& box, int depth) {
        if (overlaps_.size() >= most_ || look_alike(pieces)) return;
        const auto [axis, share] = best_axis(pieces, box);
        if (pieces.size() <= kFew || depth == kDeepest || share > kLongestShare)
            return compare(pieces, box, axis);
        const double middle = (box.min[axis] + box.max[axis]) / 2;
        Bounds low = box, high = box;
        set(low.max, axis, middle), set(high.min, axis, middle);
        std::vector<std::uint32_t> below, above;
        for (const std::uint32_t i : pieces) {
            const Bounds own = bounds_of(pieces_[i]);
            if (own.min[axis] < middle) below.push_back(i);
            if (own.max[axis] >= middle) above.push_back(i);
        }
        pieces = {};  // the memory is not needed any more
        search(std::move(below), low, depth + 1);
        search(std::move(above), high, depth + 1);
    }

    bool look_alike(std::span<const std::uint32_t> pieces) const {
        return std::ranges::all_of(
            pieces, [&](std::uint32_t i) { return pieces_[i].look == pieces_[pieces[0]].look; });
    }

    static void set(Vec3& v, std::size_t axis, double value) {
        (axis == 0 ? v.x : axis == 1 ? v.y : v.z) = value;
    }

    struct AxisChoice {
        std::size_t axis = 0;
        double share = 1;  ///< of the box's extent that a piece has on average
    };

    AxisChoice best_axis(std::span<const std::uint32_t> pieces, const Bounds& box) const {
        Vec3 sum;
        for (const std::uint32_t i : pieces) {
            const Bounds own = bounds_of(pieces_[i]);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double inside =
                    std::min(own.max[axis], box.max[axis]) - std::max(own.min[axis], box.min[axis]);
                set(sum, axis, sum[axis] + inside);
            }
        }
        AxisChoice best;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double whole = static_cast<double>(pieces.size()) * (box.max[axis] - box.min[axis]);
            if (sum[axis] < best.share * whole) best = {axis, sum[axis] / whole};
        }
        return best;
    }

    /// All pairs whose extents along `axis` overlap.
    void compare(std::span<const std::uint32_t> pieces, const Bounds& box, std::size_t axis) {
        struct Placed {
            Bounds bounds;
            std::uint32_t number;
        };
        std::vector<Placed> placed;
        for (const std::uint32_t i : pieces) placed.push_back({bounds_of(pieces_[i]), i});
        std::ranges::sort(placed, {},
                          [&](const Placed& p) { return std::pair(p.bounds.min[axis], p.number); });
        for (std::size_t i = 0; i < placed.size(); ++i) {
            const Piece& first = pieces_[placed[i].number];
            for (std::size_t j = i + 1; j < placed.size(); ++j) {
                const Piece& second = pieces_[placed[j].number];
                if (placed[j].bounds.min[axis] > placed[i].bounds.max[axis]) break;
                if (first.look == second.look || !is_met_in(box, placed[i].bounds, placed[j].bounds))
                    continue;
                const bool is_lamp_first = is_lamp(first) && !is_lamp(second);
                const bool is_lamp_second = is_lamp(second) && !is_lamp(first);
                if (is_lamp_first || (!is_lamp_second && first.object <= second.object)) {
                    add_overlap(first, second);
                } else {
                    add_overlap(second, first);
                }
                if (overlaps_.size() >= most_) return;
            }
        }
    }

    /// Whether the first corner of what both bounds share lies in the box: so a pair that is in several boxes
    /// counts once.
    static bool is_met_in(const Bounds& box, const Bounds& a, const Bounds& b) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double corner = std::max(a.min[axis], b.min[axis]);
            if (corner > std::min(a.max[axis], b.max[axis])) return false;
            if (corner < box.min[axis] || corner >= box.max[axis]) return false;
        }
        return true;
    }

    void add_overlap(const Piece& first, const Piece& second) {
        const auto place = shared_place(corners_of(first), corners_of(second), lift_);
        if (!place) return;
        overlaps_.push_back({first.object, second.object, first.triangle, second.triangle, place->middle,
                             place->normal, place->gap_m});
    }

    Corners corners_of(const Piece& piece) const {
        const Mesh& mesh = *shapes_[index_of(piece.object)].mesh;
        const auto [a, b, c] = mesh.triangles[piece.triangle];
        return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
    }

    struct Shapes {
        Mesh own;  ///< the triangles of what is no mesh
        const Mesh* mesh = nullptr;
        bool is_lamp = false;
    };

    OverlapsOf of_;
    std::size_t most_;
    Lift lift_;
    Vec3 margin_;  ///< half the largest gap
    /// Triangles elsewhere are left out: where lamps are wanted, the bounds of all lamps.
    Bounds wanted_{{-Bounds::kInfinity, -Bounds::kInfinity, -Bounds::kInfinity},
                   {Bounds::kInfinity, Bounds::kInfinity, Bounds::kInfinity}};
    std::vector<Shapes> shapes_;  ///< by object
    std::vector<Piece> pieces_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> looks_;
    std::vector<Overlap> overlaps_;
};

/// A triangle that has to move by `distance_m` along its unit normal.
struct Push {
    std::uint32_t triangle = 0;
    Vec3 normal;
    double distance_m = 0;

    /// Adds to a displacement what it lacks: one that goes far enough already stays.
    void complete(Vec3& displacement) const {
        displacement += std::max(distance_m - dot(normal, displacement), 0.0) * normal;
    }
};

/// Moves a lamp, or the faces of it that were found.
struct Mover {
    std::span<const Push> pushes;

    void operator()(Rectangle& rectangle) const { rectangle.corner += whole(); }
    void operator()(Disk& disk) const { disk.center += whole(); }
    void operator()(Box& box) const {
        Vec3 of_min, of_max;
        for (const Push& push : pushes) push.complete(dot(push.normal, {1, 1, 1}) > 0 ? of_max : of_min);
        box = {box.min + of_min, box.max + of_max};
    }
    void operator()(Mesh& mesh) const {
        // Vertices at one position stay together: the faces beside those that move stay connected to them.
        const std::vector<std::uint32_t> vertex_at = geometry::welded(mesh.vertices);
        std::vector<Vec3> displacements(mesh.vertices.size());
        for (const Push& push : pushes) {
            for (const std::uint32_t v : mesh.triangles[push.triangle])
                push.complete(displacements[vertex_at[v]]);
        }
        for (std::size_t v = 0; v < displacements.size(); ++v)
            mesh.vertices[v] += displacements[vertex_at[v]];
    }
    void operator()(const Instance&) const {}  // lamps have meshes of their own
    void operator()(const Sphere&) const {}
    void operator()(const Harmonics&) const {}

  private:
    Vec3 whole() const {
        Vec3 displacement;
        for (const Push& push : pushes) push.complete(displacement);
        return displacement;
    }
};

}  // namespace

std::vector<Overlap> find_overlaps(const Scene& scene, OverlapsOf of, std::size_t most) {
    const bool has_lamps = std::ranges::any_of(
        scene.lights, [](const Light& light) { return lights::emitting_object(light).has_value(); });
    if (of == OverlapsOf::lamps && !has_lamps) return {};
    return OverlapSearch(scene, of, most).run();
}

std::vector<std::array<std::uint32_t, 2>> find_overlaps(const Mesh& mesh, const Lift& lift) {
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (const Overlap& overlap : OverlapSearch(mesh, lift).run())
        pairs.push_back({overlap.triangle, overlap.second_triangle});
    return pairs;
}

void put_lamps_in_front(Scene& scene) {
    for (const ObjectId lamp : lamps_of(scene)) make_own_mesh(scene.objects[index_of(lamp)]);
    constexpr std::size_t most = 10'000'000;
    const Lift lift = lift_of_lamps(scene);
    std::map<ObjectId, std::vector<Push>> pushes;
    for (const Overlap& overlap : find_overlaps(scene, OverlapsOf::lamps, most)) {
        const double wanted_m = kLampGap * offset_m(lift, overlap.position);
        if (overlap.gap_m >= wanted_m) continue;
        pushes[overlap.first].push_back({overlap.triangle, overlap.normal, wanted_m - overlap.gap_m});
    }
    for (const auto& [object, of_lamp] : pushes)
        std::visit(Mover{of_lamp}, scene.objects[index_of(object)].shape);
}

}  // namespace stilb::scene
