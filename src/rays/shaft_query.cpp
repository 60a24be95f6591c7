#include "rays/shaft_query.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "math/morton.h"
#include "rays/embree_geometry.h"

namespace stilb::rays {
namespace {

constexpr std::uint32_t kItemsOfLeaf = 4;
/// Nodes that a query looks at before it gives up: it must cost less than the rays that it saves.
constexpr int kMostNodes = 400;
/// The rounding error of single precision, with a margin, in shares of the coordinates; points are lifted by
/// eight times that.
constexpr double kRounding = 0x1p-22;
/// Of the ray caster's triangles: larger ones are cut.
constexpr double kLargeTriangle_m = 8;

Vec3 to_vector(const std::array<float, 3>& p) { return {p[0], p[1], p[2]}; }

std::array<float, 3> to_point(const Vec3& p) {
    return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

}  // namespace

/// In coordinates relative to the centre.
class ShaftQuery::Shaft {
  public:
    Shaft(std::span<const Vec3> from, std::span<const Vec3> to, const Vec3& center)
        : from_(from), to_(to), center_(center) {
        Bounds a, b;
        for (const Vec3& p : from) a.include(p - center);
        for (const Vec3& p : to) b.include(p - center);
        Bounds both = a;
        both.include(b.min), both.include(b.max);
        margin_ = kRounding * std::max(largest_coordinate(both.min), largest_coordinate(both.max));
        box_ = {both.min - Vec3{margin_, margin_, margin_}, both.max + Vec3{margin_, margin_, margin_}};
        for (std::size_t axis = 0; axis < 3; ++axis) add_planes(a, b, axis);
    }

    bool excludes(const Box& box) const {
        for (std::size_t i = 0; i < 3; ++i) {
            if (box.max[i] < box_.min[i] || box.min[i] > box_.max[i]) return true;
        }
        return std::any_of(planes_.begin(), planes_.begin() + plane_count_, [&](const Plane& plane) {
            double nearest = 0;
            for (std::size_t i = 0; i < 3; ++i)
                nearest += plane.normal[i] * (plane.normal[i] > 0 ? box.min[i] : box.max[i]);
            return nearest > plane.end;
        });
    }

    bool excludes_triangle(const std::array<Point, 3>& corners) const {
        const Vec3 p = to_vector(corners[0]), q = to_vector(corners[1]), r = to_vector(corners[2]);
        for (const Plane& plane : std::span(planes_).first(plane_count_)) {
            if (std::min({dot(plane.normal, p), dot(plane.normal, q), dot(plane.normal, r)}) > plane.end)
                return true;
        }
        return is_on_one_side(p, q - p, r - p);
    }

  private:
    /// The shaft is where dot(normal, p) <= end.
    struct Plane {
        Vec3 normal;
        double end = 0;
    };

    /// The planes through two boxes' edges along an axis: beside it, those through corners of the same kind
    /// that have all of both boxes on one side.
    void add_planes(const Bounds& a, const Bounds& b, std::size_t axis) {
        const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
        for (const bool high_x : {false, true}) {
            for (const bool high_y : {false, true}) {
                const double ax = (high_x ? a.max : a.min)[x], ay = (high_y ? a.max : a.min)[y];
                const double bx = (high_x ? b.max : b.min)[x], by = (high_y ? b.max : b.min)[y];
                double nx = by - ay, ny = ax - bx;
                if (nx * (high_x ? 1 : -1) < 0) nx = -nx, ny = -ny;
                const bool bounds_both = nx * (high_x ? 1 : -1) > 0 && ny * (high_y ? 1 : -1) > 0;
                if (!bounds_both) continue;
                std::array<double, 3> normal{};
                const double size = std::hypot(nx, ny);
                normal[x] = nx / size, normal[y] = ny / size;
                planes_[plane_count_++] = {{normal[0], normal[1], normal[2]},
                                           normal[x] * ax + normal[y] * ay + margin_};
            }
        }
    }

    /// Whether all points of the hull are clearly on the same side of a triangle's plane.
    bool is_on_one_side(const Vec3& corner, const Vec3& edge_1, const Vec3& edge_2) const {
        const Vec3 across = cross(edge_1, edge_2);
        const double size = length(across);
        if (size == 0) return false;
        const Vec3 normal = across / size;
        const double extent =
            std::min(kLargeTriangle_m, std::max(largest_coordinate(edge_1), largest_coordinate(edge_2)));
        bool above = true, below = true;
        const auto include = [&](const Vec3& point) {
            const Vec3 p = point - center_;
            const double height = dot(normal, p - corner);
            const double rounding = kRounding * std::max(extent, largest_coordinate(p));
            above = above && height > rounding;
            below = below && height < -rounding;
            return above || below;
        };
        return std::ranges::all_of(from_, include) && std::ranges::all_of(to_, include);
    }

    std::span<const Vec3> from_, to_;
    Vec3 center_;
    double margin_ = 0;
    Bounds box_;
    std::array<Plane, 12> planes_;
    std::uint32_t plane_count_ = 0;
};

ShaftQuery::ShaftQuery(const Scene& scene, const Vec3& center) : center_(center) {
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) add(scene.objects[i], i);
    if (items_.empty()) return;
    sort();
    nodes_.emplace_back();
    divide(0, 0, static_cast<std::uint32_t>(items_.size()));
}

void ShaftQuery::add(const Object& object, std::uint32_t number) {
    if (const auto* mesh = std::get_if<Mesh>(&object.shape)) return add_triangles(*mesh, number);
    if (const auto* instance = std::get_if<Instance>(&object.shape)) return add_boxes(*instance, number);
    if (const auto* rectangle = std::get_if<Rectangle>(&object.shape))
        return add_triangles(triangulated(*rectangle), number);
    if (const auto* box = std::get_if<stilb::Box>(&object.shape))
        return add_triangles(triangulated(*box), number);
    const auto surface = curved_surface(object.shape, center_);
    for (std::size_t part = 0; part < surface->part_count(); ++part)
        add_box(surface->bounds_of(part), number);
}

void ShaftQuery::add_box(const Bounds& bounds, std::uint32_t object) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Point least = to_point(bounds.min), greatest = to_point(bounds.max);
    for (std::size_t i = 0; i < 3; ++i) {
        least[i] = std::nextafter(least[i], -infinity);
        greatest[i] = std::nextafter(greatest[i], infinity);
    }
    items_.push_back({{least, greatest, greatest}, object, false});
}

/// Boxes around several triangles each, which mostly are neighbours: they take less memory than the
/// triangles.
void ShaftQuery::add_boxes(const Instance& instance, std::uint32_t object) {
    constexpr std::size_t at_once = 32;
    const std::size_t count = instance.mesh->triangles.size();
    for (std::size_t first = 0; first < count; first += at_once) {
        Bounds bounds;
        for (std::size_t t = first; t < std::min(first + at_once, count); ++t) {
            for (const Vec3& corner : instance.corners_of(t)) bounds.include(corner - center_);
        }
        add_box(bounds, object);
    }
}

void ShaftQuery::add_triangles(const Mesh& mesh, std::uint32_t object) {
    for (const auto& [a, b, c] : mesh.triangles) {
        items_.push_back({{to_point(mesh.vertices[a] - center_), to_point(mesh.vertices[b] - center_),
                           to_point(mesh.vertices[c] - center_)},
                          object,
                          true});
    }
}

/// Along a space-filling curve, so that neighbours share nodes.
void ShaftQuery::sort() {
    std::vector<Vec3> middles;
    middles.reserve(items_.size());
    for (const Item& item : items_) {
        const Box box = box_of(item);
        middles.push_back(0.5 * (to_vector(box.min) + to_vector(box.max)));
    }
    const std::vector<std::uint32_t> order = math::morton_order(middles);
    std::vector<Item> sorted;
    sorted.reserve(items_.size());
    for (const std::uint32_t i : order) sorted.push_back(items_[i]);
    items_ = std::move(sorted);
}

ShaftQuery::Box ShaftQuery::box_of(const Item& item) {
    Box box{item.corners[0], item.corners[0]};
    for (const Point& corner : item.corners) {
        for (std::size_t i = 0; i < 3; ++i) {
            box.min[i] = std::min(box.min[i], corner[i]);
            box.max[i] = std::max(box.max[i], corner[i]);
        }
    }
    return box;
}

ShaftQuery::Box ShaftQuery::divide(std::uint32_t node, std::uint32_t first, std::uint32_t end) {
    const auto join = [](Box a, const Box& b) {
        for (std::size_t i = 0; i < 3; ++i) {
            a.min[i] = std::min(a.min[i], b.min[i]);
            a.max[i] = std::max(a.max[i], b.max[i]);
        }
        return a;
    };
    Box box = box_of(items_[first]);
    if (end - first <= kItemsOfLeaf) {
        for (std::uint32_t i = first; i < end; ++i) box = join(box, box_of(items_[i]));
        nodes_[node] = {box, first, end - first};
        return box;
    }
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    const std::uint32_t middle = first + (end - first) / 2;
    box = join(divide(children, first, middle), divide(children + 1, middle, end));
    nodes_[node] = {box, children, 0};
    return box;
}

bool ShaftQuery::is_empty(std::span<const Vec3> from, std::span<const Vec3> to,
                          std::optional<ObjectId> except) const {
    if (nodes_.empty()) return true;
    const Shaft shaft(from, to, center_);
    const std::uint32_t left_out = except ? index_of(*except) : ~0u;
    std::array<std::uint32_t, 64> open;
    std::size_t count = 0;
    open[count++] = 0;
    for (int visited = 0; count > 0; ++visited) {
        if (visited == kMostNodes) return false;
        const Node& node = nodes_[open[--count]];
        if (shaft.excludes(node.box)) continue;
        if (node.items == 0) {
            open[count++] = node.first;
            open[count++] = node.first + 1;
            continue;
        }
        for (const Item& item : std::span(items_).subspan(node.first, node.items)) {
            if (item.object == left_out || shaft.excludes(box_of(item))) continue;
            if (!item.is_triangle || !shaft.excludes_triangle(item.corners)) return false;
        }
    }
    return true;
}

}  // namespace stilb::rays
