#include "lights/opening_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace stilb::lights {
namespace {

constexpr double kThinShare = 1e-2;   ///< of the largest extent: the width of a line
constexpr double kPlateShare = 1e-3;  ///< of the smaller extent: the thickness of a plate
constexpr double kEqualShare = 1e-2;  ///< relative difference of the diameters of a circle
constexpr std::uint32_t kCorners = 16;

struct Axes {
    Vec3 u, v, w;  ///< u and v span the outline, w is the axis of the prism; of the lengths of the extents
};

/// Circles become polygons of their area, or of their perimeter: then the polygon's width is that of the
/// circle, in the mean over all directions.
enum class Outline { rectangle, circle_by_area, circle_by_perimeter };

/// The outline of a prism relative to its edges, as a polygon around 0.
std::vector<std::array<double, 2>> corners_of(Outline outline) {
    if (outline == Outline::rectangle) return {{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}};
    const double step = 2 * kPi / kCorners;
    const double radius = outline == Outline::circle_by_area ? 0.5 * std::sqrt(step / std::sin(step))
                                                             : 0.25 * step / std::sin(step / 2);
    std::vector<std::array<double, 2>> corners;
    for (std::uint32_t i = 0; i < kCorners; ++i)
        corners.push_back({radius * std::cos(i * step), radius * std::sin(i * step)});
    return corners;
}

/// Flat faces with corners of their own, whose fronts are the outside.
class ConvexMesh {
  public:
    explicit ConvexMesh(const Vec3& middle) : middle_(middle) {}

    void add(const std::vector<Vec3>& face) {
        const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
        mesh_.vertices.insert(mesh_.vertices.end(), face.begin(), face.end());
        const Vec3 across = cross(face[1] - face[0], face[2] - face[0]);
        const bool is_outward = dot(across, face[0] - middle_) > 0;
        for (std::uint32_t i = 1; i + 1 < face.size(); ++i) {
            const std::uint32_t b = first + i, c = b + 1;
            mesh_.triangles.push_back(is_outward ? Triangle{first, b, c} : Triangle{first, c, b});
        }
    }
    Mesh take() { return std::move(mesh_); }

  private:
    Vec3 middle_;
    Mesh mesh_;
};

enum class Sides { all, none };

/// Without sides it is a plate: two faces back to back.
Mesh prism(const Vec3& middle, const Axes& axes, Outline outline, Sides sides) {
    std::vector<Vec3> lower, upper;
    for (const auto& [s, t] : corners_of(outline)) {
        const Vec3 corner = middle + s * axes.u + t * axes.v;
        lower.push_back(corner - 0.5 * axes.w);
        upper.push_back(corner + 0.5 * axes.w);
    }
    ConvexMesh mesh(middle);
    mesh.add(lower);
    mesh.add(upper);
    for (std::size_t i = 0; sides == Sides::all && i < lower.size(); ++i) {
        const std::size_t next = (i + 1) % lower.size();
        mesh.add({lower[i], lower[next], upper[next], upper[i]});
    }
    return mesh.take();
}

bool is_circle(const Vec3& extent_m) {
    return std::abs(extent_m.x - extent_m.y) <= kEqualShare * std::max(extent_m.x, extent_m.y);
}

/// One side of a flat opening; a one-sided ellipse is the lower face of its prism.
Shape one_side(const Opening& opening, const Luminaire& at, bool is_down) {
    const Vec3 &size = opening.extent_m, normal = is_down ? at.nadir : -at.nadir;
    if (opening.form != Opening::Form::box && is_circle(size))
        return Disk{at.position, normal, (size.x + size.y) / 4};
    const Vec3 u = size.x * at.c0, v = size.y * at.c90;
    if (opening.form == Opening::Form::box) {
        const Vec3 corner = at.position - 0.5 * (u + v);
        return is_down ? Rectangle{corner, v, u} : Rectangle{corner, u, v};
    }
    std::vector<Vec3> face;
    for (const auto& [s, t] : corners_of(Outline::circle_by_area))
        face.push_back(at.position + s * u + t * v);
    ConvexMesh mesh(at.position - normal);
    mesh.add(face);
    return mesh.take();
}

/// The sides of tubes are seen, of drums their ends, too.
Outline outline_of(Opening::Form form) {
    if (form == Opening::Form::box) return Outline::rectangle;
    return form == Opening::Form::vertical_cylinder ? Outline::circle_by_area : Outline::circle_by_perimeter;
}

Axes axes_of(Opening::Form form, const Vec3& size, const Luminaire& at) {
    const Vec3 x = size.x * at.c0, y = size.y * at.c90, z = -size.z * at.nadir;
    if (form == Opening::Form::cylinder_along_c0) return {y, z, x};
    if (form == Opening::Form::cylinder_along_c90) return {z, x, y};
    return {x, y, z};
}

}  // namespace

Opening Opening::of_signed(const Vec3& e) {
    Opening opening{Form::box, {std::abs(e.x), std::abs(e.y), std::abs(e.z)}};
    const bool x = e.x < 0, y = e.y < 0, z = e.z < 0;
    if (x && y) {
        opening.form = z ? Form::ball : Form::vertical_cylinder;
    } else if (x != y && z) {
        opening.form = x ? Form::cylinder_along_c90 : Form::cylinder_along_c0;
    }
    return opening;
}

OpeningShape shape_of(const Opening& opening, const Luminaire& luminaire, const PhotometricSolid& solid,
                      const BodyExtent& body) {
    Vec3 size = opening.extent_m;
    if (opening.form == Opening::Form::ball) {
        return {Sphere{luminaire.position, std::cbrt(size.x * size.y * size.z) / 2}, 0};
    }
    const double thin_m = kThinShare * std::max({size.x, size.y, size.z});
    size.x = std::max(size.x, thin_m), size.y = std::max(size.y, thin_m);
    const bool is_flat = !(size.z > 0);
    Vec3 middle = luminaire.position;
    if (is_flat) {
        const double below = solid.share_below();
        const double hidden = std::min(below, 1 - below);
        if (hidden < kMostHiddenShare) {
            Luminaire moved = luminaire;
            moved.position += (below > 0.5 ? body.below_m : -body.above_m) * luminaire.nadir;
            return {one_side({opening.form, size}, moved, below > 0.5), hidden};
        }
        const double lower_m = std::max(body.below_m, kPlateShare * std::min(size.x, size.y));
        size.z = lower_m + body.above_m;
        middle += (lower_m - body.above_m) / 2 * luminaire.nadir;
    }
    const Axes axes = axes_of(opening.form, size, luminaire);
    return {prism(middle, axes, outline_of(opening.form), is_flat ? Sides::none : Sides::all), 0};
}

}  // namespace stilb::lights
