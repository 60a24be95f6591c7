#include "sensors/areas/area.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "sensors/areas/raster.h"

namespace stilb::sensors {
namespace {

/// Lengths below this share of the polygon's extent are rounding.
constexpr double kRounding = 1e-9;
/// A corner that is further off the plane, as a share of the extent, is a mistake.
constexpr double kOffPlane = 1e-6;

/// The plane of a polygon: `frame.w` is the side from which its corners run counterclockwise, or up.
struct Plane {
    Vec3 origin;
    Frame frame;
    double extent_m = 0;

    PlanePoint of(const Vec3& position) const {
        const Vec3 local = frame.to_local(position - origin);
        return {local.x, local.y};
    }
    Vec3 at(double x, double y) const { return origin + x * frame.u + y * frame.v; }
};

/// Twice the area times the normal [Newell].
Vec3 doubled_area_vector(const std::vector<Vec3>& corners) {
    Vec3 sum;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    return sum;
}

/// The plane with u along the longest edge; nothing for a polygon without area.
std::optional<Plane> plane_of(const std::vector<Vec3>& outline) {
    if (outline.empty()) return std::nullopt;
    Plane plane{outline.front(), {}, 0};
    Vec3 longest;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec3 edge = outline[(i + 1) % outline.size()] - outline[i];
        // Of edges of the same length, the first one.
        if (length(edge) > length(longest) * (1 + kRounding)) longest = edge;
        plane.extent_m = std::max(plane.extent_m, length(outline[i] - plane.origin));
    }
    const Vec3 area = doubled_area_vector(outline);
    if (!(length(area) > kRounding * plane.extent_m * plane.extent_m)) return std::nullopt;
    Vec3 w = normalized(area);
    if (std::hypot(w.x, w.y) < kOffPlane) w = {0, 0, 1};
    const Vec3 u = normalized(longest - dot(longest, w) * w);
    plane.frame = {u, cross(w, u), w};
    return plane;
}

std::optional<std::string> fault_off_plane(const std::vector<Vec3>& corners, const Plane& plane) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double off_m = std::abs(dot(corners[i] - plane.origin, plane.frame.w));
        if (off_m > kOffPlane * plane.extent_m) {
            return fmt::format(
                "corner {}, counted from 0, is {:.3g} m off the plane of the outline. Allowed: corners in "
                "one "
                "plane.",
                i, off_m);
        }
    }
    return std::nullopt;
}

struct Extent {
    PlanePoint least, most;
};

Extent extent_of(const Ring& ring, double margin_m) {
    const auto [x0, x1] = std::ranges::minmax_element(ring, {}, &PlanePoint::x);
    const auto [y0, y1] = std::ranges::minmax_element(ring, {}, &PlanePoint::y);
    return {{x0->x - margin_m, y0->y - margin_m}, {x1->x + margin_m, y1->y + margin_m}};
}

/// The side d of EN 12464-1.
double deciding_side_m(double short_m, double long_m) {
    return long_m >= 2 * short_m * (1 - kRounding) ? short_m : long_m;
}

/// The numbers of cells along both sides. By default [EN 12464-1, 4.4] the whole number nearest to d / p
/// along the side d that the spacing p follows from, and cells that are nearly square.
std::array<double, 2> cells_of(const Area& area, double x_m, double y_m) {
    if (area.spacing_m) return {cells_along(x_m, *area.spacing_m), cells_along(y_m, *area.spacing_m)};
    const double width_m = area.band_m[1] - area.band_m[0];
    if (width_m > 0) {  // d is its width, the shorter side of a long strip
        const double cell_m = width_m / cells_along(width_m, raster_spacing_m(width_m, 2 * width_m));
        return {cells_along(x_m, cell_m), cells_along(y_m, cell_m)};
    }
    const auto [short_m, long_m] = std::minmax(x_m, y_m);
    const double d_m = deciding_side_m(short_m, long_m);
    const double cell_m = d_m / cells_along(d_m, raster_spacing_m(short_m, long_m));
    return {cells_along(x_m, cell_m), cells_along(y_m, cell_m)};
}

bool is_measured(const Region& region, const std::array<double, 2>& band_m, const PlanePoint& point,
                 double margin_m) {
    const Ring& outline = region.front();
    if (band_m[1] > 0) {
        const double distance_m = distance_to(outline, point);
        return !contains(outline, point, margin_m) && distance_m > band_m[0] && distance_m <= band_m[1];
    }
    return contains(outline, point, margin_m) &&
           std::none_of(region.begin() + 1, region.end(),
                        [&](const Ring& hole) { return contains(hole, point, 0); });
}

}  // namespace

double area_m2(const PolygonInSpace& polygon) {
    double doubled_m2 = length(doubled_area_vector(polygon.outline));
    for (const std::vector<Vec3>& hole : polygon.holes) doubled_m2 -= length(doubled_area_vector(hole));
    return doubled_m2 / 2;
}

double raster_spacing_m(double short_m, double long_m) {
    return std::min(10.0, 0.2 * std::pow(5, std::log10(deciding_side_m(short_m, long_m))));
}

std::optional<Fault> Area::settle(const GivenKeys& given) {
    if (surfaces.are_given()) {
        for (const std::string_view key : {"normal", "surround", "background"}) {
            if (given.has(key))
                return Fault{key, fmt::format("does not go with \"{}\": faces have normals of their own, and "
                                              "no bands around them. Allowed: one of the two.",
                                              surfaces.room ? "room" : "object")};
        }
        return std::nullopt;
    }
    if (given.has("part"))
        return Fault{"part",
                     "picks faces of objects. Needed: \"object\", the name of one, or a list of names, or "
                     "\"room\", a point in one."};
    const std::string_view outline_key = given.has("corners") ? "corners" : "edge_v";
    const auto plane = plane_of(polygon.outline);
    if (!plane)
        return Fault{outline_key, "the area has no extent. Allowed: corners that are not on one line."};
    if (const auto fault = fault_off_plane(polygon.outline, *plane)) return Fault{outline_key, *fault};
    Region region;
    const auto add_ring = [&](const std::vector<Vec3>& corners) {
        Ring& ring = region.emplace_back();
        for (const Vec3& corner : corners) ring.push_back(plane->of(corner));
    };
    add_ring(polygon.outline);
    for (const std::vector<Vec3>& hole : polygon.holes) {
        if (const auto fault = fault_off_plane(hole, *plane)) return Fault{"holes", *fault};
        add_ring(hole);
    }
    if (const auto fault = fault_of(region)) {
        if (fault->ring == 0) return Fault{outline_key, fault->message};
        return Fault{"holes", fmt::format("hole {}, counted from 0, {}", fault->ring - 1, fault->message)};
    }

    const auto [least, most] = extent_of(region.front(), band_m[1]);
    const auto [nx, ny] = cells_of(*this, most.x - least.x, most.y - least.y);
    const std::string_view spacing_key = given.has("spacing") ? "spacing" : outline_key;
    if (nx * ny > static_cast<double>(kMostReadings)) {
        return Fault{spacing_key,
                     fmt::format("asks for a raster of {:g} x {:g} points. Allowed: {} readings in all "
                                 "sensors together.",
                                 nx, ny, kMostReadings)};
    }
    cell_m = {(most.x - least.x) / nx, (most.y - least.y) / ny};
    const Vec3 facing = normal.value_or(plane->frame.w);
    raster = {plane->at(least.x, least.y),
              (most.x - least.x) * plane->frame.u,
              (most.y - least.y) * plane->frame.v,
              {static_cast<int>(nx), static_cast<int>(ny)},
              facing};
    points.clear();
    for (double row = 0; row < ny; ++row) {
        for (double column = 0; column < nx; ++column) {
            const PlanePoint point{least.x + (column + 0.5) * cell_m[0], least.y + (row + 0.5) * cell_m[1]};
            if (is_measured(region, band_m, point, kRounding * plane->extent_m))
                points.push_back({plane->at(point.x, point.y), facing});
        }
    }
    if (points.empty()) {
        return Fault{spacing_key,
                     fmt::format("no point of the raster of {:.3g} m x {:.3g} m lies in the area. "
                                 "Allowed: a smaller spacing.",
                                 cell_m[0], cell_m[1])};
    }
    return std::nullopt;
}

}  // namespace stilb::sensors
