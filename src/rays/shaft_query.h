// Certain visibility: whether no surface can lie between two groups of points, proved by separating planes
// instead of sampled by rays. An answer that is not certain is "no".
//
// The shaft between two groups is the convex hull of both, bounded by the planes of [Haines, Wallace 1991]
// for the groups' boxes. A triangle is outside of it where all of it is beyond one of these planes, or all of
// the hull on one side of the triangle's own plane. Curved surfaces and instances count as their parts'
// boxes. Thin surfaces are never missed, because nothing is sampled.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/ids.h"
#include "base/vec.h"
#include "scene/scene.h"

namespace stilb::rays {

/// A bounding volume hierarchy of a scene's surfaces, panes too. Immutable; queries allocate no memory.
class ShaftQuery {
  public:
    /// `center`: the origin of the ray caster's coordinates.
    ShaftQuery(const Scene& scene, const Vec3& center);

    /// True only where no surface meets any segment from the convex hull of `from` to that of `to`, which are
    /// lifted off their own surfaces. `except`: an object that is not looked at.
    bool is_empty(std::span<const Vec3> from, std::span<const Vec3> to, std::optional<ObjectId> except) const;

  private:
    using Point = std::array<float, 3>;
    struct Box {
        Point min, max;
    };
    /// A triangle or, with its box alone, a part of a curved surface or of an instance.
    struct Item {
        std::array<Point, 3> corners;  ///< of a curved part: the least and the greatest point
        std::uint32_t object = 0;
        bool is_triangle = true;
    };
    struct Node {
        Box box;
        std::uint32_t first = 0;  ///< item, or the first of two nodes
        std::uint32_t items = 0;  ///< 0: it has two nodes
    };
    class Shaft;

    void add(const Object& object, std::uint32_t number);
    void add_box(const Bounds& bounds, std::uint32_t object);
    void add_boxes(const Instance& instance, std::uint32_t object);
    void add_triangles(const Mesh& mesh, std::uint32_t object);
    void sort();
    Box divide(std::uint32_t node, std::uint32_t first, std::uint32_t end);
    static Box box_of(const Item& item);

    Vec3 center_;
    std::vector<Item> items_;
    std::vector<Node> nodes_;
};

}  // namespace stilb::rays
