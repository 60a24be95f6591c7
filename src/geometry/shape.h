// Shapes of surfaces. Plain values in metres, in world coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "base/vec.h"
#include "geometry/transform.h"

namespace stilb {
struct Bounds;
}

namespace stilb::geometry {

class HarmonicArea;
class HarmonicCells;
class HarmonicSurface;

using Triangle = std::array<std::uint32_t, 3>;

/// Front: the side from which the vertices run counterclockwise. Every index is below vertices.size().
struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    /// Unit vectors on the front's side, normal to the surface that the triangles approximate; empty for
    /// flat triangles. Zero vectors are ignored.
    std::vector<Vec3> normals{};
    /// Indices into `normals` of the corners of each triangle, or kNoNormal; empty where they are the indices
    /// of the vertices.
    std::vector<Triangle> corner_normals{};

    std::array<Vec3, 3> corners_of(std::size_t triangle) const {
        const auto [a, b, c] = triangles[triangle];
        return {vertices[a], vertices[b], vertices[c]};
    }
};
inline constexpr std::uint32_t kNoNormal = ~0u;

/// A mesh that several objects share, each with a place of its own. It takes no memory beside the mesh.
struct Instance {
    std::shared_ptr<const Mesh> mesh;  ///< in its own coordinates; not null
    Transform to_world;                ///< not singular; a mirrored one keeps the front of the mesh the front

    /// In the world, in the order that triangulated() gives them.
    std::array<Vec3, 3> corners_of(std::size_t triangle) const;
};

/// The parallelogram corner + s edge_u + t edge_v, 0 <= s, t <= 1; its front is edge_u x edge_v.
struct Rectangle {
    Vec3 corner, edge_u, edge_v;
};

/// Axis-parallel; its front is the outside.
struct Box {
    Vec3 min, max;
};

/// Its front is the outside.
struct Sphere {
    Vec3 center;
    double radius = 1;
};

/// `normal` is a unit vector and points to the front.
struct Disk {
    Vec3 center, normal;
    double radius = 1;
};

/// The method of ray intersection with a surface by harmonics.
enum class HarmonicMethod {
    cells,  ///< polynomials in small cells: harmonics/cells.h
    roots,  ///< the roots of a trigonometric polynomial: HarmonicSurface::first_crossing
    march   ///< fixed steps and bisection, which miss thin parts: harmonics/surface.h
};

/// center + scale (x u + y v + z w) of the surface's points (x, y, z); u, v and w, the axes, are orthonormal,
/// left-handed where the object is mirrored. Its front is the outside.
struct Harmonics {
    std::shared_ptr<const HarmonicSurface> surface;  ///< not null; shared by copies, as is what follows
    std::shared_ptr<const HarmonicCells> cells;      ///< of the surface
    std::shared_ptr<const HarmonicArea> area;        ///< of the cells
    Vec3 center;
    double scale = 1;
    Frame axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    HarmonicMethod method = HarmonicMethod::cells;
    /// Whether fewer harmonics suffice where the object is small in a picture (run/level_of_detail.h).
    bool has_levels_of_detail = false;

    Vec3 to_world(const Vec3& own) const { return center + scale * axes.to_world(own); }
    Vec3 to_own(const Vec3& world) const { return axes.to_local(world - center) / scale; }
    explicit Harmonics(HarmonicSurface surface);

    /// The point in a direction from the centre, not necessarily a unit vector.
    Vec3 point_towards(const Vec3& direction) const;
    /// Unit, outwards, there.
    Vec3 normal_towards(const Vec3& direction) const;
};

/// The normal of the surface that a mesh approximates, interpolated between a triangle's corners by
/// barycentric coordinates: unit, on the side of the unit vector `geometric`, the triangle's own normal. The
/// latter is returned where there is no other, or one that deviates from it by more than 84 degrees.
Vec3 shading_normal(const Mesh& mesh, std::uint32_t triangle, const Vec3& barycentric, const Vec3& geometric);
/// The same in the world. `barycentric`: of the corners in the order of the shared mesh.
Vec3 shading_normal(const Instance& instance, std::uint32_t triangle, const Vec3& barycentric,
                    const Vec3& geometric);
/// The barycentric coordinates of a point in the plane of a triangle.
Vec3 barycentric_of(const Mesh& mesh, std::uint32_t triangle, const Vec3& point);
/// Swaps the front and the back of a triangle.
void turn_over(Mesh& mesh, std::uint32_t triangle);

using Shape = std::variant<Mesh, Instance, Rectangle, Box, Sphere, Disk, Harmonics>;

/// Whether rays meet the surface itself instead of triangles.
inline bool is_exact(const Shape& shape) {
    return std::holds_alternative<Sphere>(shape) || std::holds_alternative<Disk>(shape) ||
           std::holds_alternative<Harmonics>(shape);
}

/// The mesh that a shape stores, for its triangles and their connections: of an instance the shared one, in
/// its own coordinates. Null where it stores none.
const Mesh* stored_mesh(const Shape& shape);

/// The number of triangles of a mesh, an instance, or the triangulated() rectangle or box; 0 where the
/// surface is_exact().
std::size_t triangle_count(const Shape& shape);
/// The corners of one of these triangles, in the world.
std::array<Vec3, 3> corners_of(const Shape& shape, std::size_t triangle);

/// The mesh of a shape in the world: its own, or a copy where it is an instance.
class MeshInWorld {
  public:
    /// Keeps a reference to the shape.
    explicit MeshInWorld(const Shape& shape);
    /// False for shapes without a stored mesh.
    explicit operator bool() const { return own_ != nullptr || copy_; }
    const Mesh& operator*() const { return copy_ ? *copy_ : *own_; }
    const Mesh* operator->() const { return &**this; }

  private:
    const Mesh* own_ = nullptr;
    std::optional<Mesh> copy_;
};

/// The axis-parallel bounding box.
Bounds bounds_of(const Shape& shape);
/// The area of one side [m2].
double area_m2(const Shape& shape);
double triangle_area_m2(const Vec3& a, const Vec3& b, const Vec3& c);
inline double triangle_area_m2(const Mesh& mesh, std::size_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    return triangle_area_m2(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
}
/// Whether two shapes of one kind have the same corners, closer than `tolerance_m`, and the same front.
bool coincide(const Shape& a, const Shape& b, double tolerance_m);
/// The transformed shape; fronts stay fronts under mirrored transforms. Boxes become meshes unless their axes
/// stay axis-parallel. Precondition for spheres, disks and harmonics: the transform is a similarity.
Shape transformed(Shape shape, const Transform& transform);
/// A copy of the mesh in the world.
Mesh triangulated(const Instance& instance);
/// Two triangles with the rectangle's front.
Mesh triangulated(const Rectangle& rectangle);
/// Twelve triangles with the box's front.
Mesh triangulated(const Box& box);
/// The inscribed icosahedron with the sphere's front: twenty triangles, all vertices on the sphere.
Mesh inscribed_icosahedron(const Sphere& sphere);
/// The same of a surface by harmonics.
Mesh inscribed_icosahedron(const Harmonics& harmonics);

}  // namespace stilb::geometry

namespace stilb {
using geometry::Box;
using geometry::Disk;
using geometry::HarmonicMethod;
using geometry::Harmonics;
using geometry::Instance;
using geometry::kNoNormal;
using geometry::Mesh;
using geometry::Rectangle;
using geometry::Shape;
using geometry::Sphere;
using geometry::Triangle;
}  // namespace stilb
