#include "sensors/areas/floors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "geometry/horizontal_section.h"

namespace stilb::sensors {
namespace {

/// Horizontal surfaces that lie so close are one level.
constexpr double kSameLevel_m = 5e-3;
constexpr double kLevelCosine = 0.999;
constexpr double kLeastClear_m = 1.8, kSection_m = 1.9, kSectionShare = 0.9;
constexpr double kLargestFurniture_m2 = 6, kHighestFurniture_m = 1.2;
constexpr double kLeastStanding = 0.25, kMostOpen = 0.5;
/// The edges of floors are looked at in steps, a little beside and above them.
constexpr double kEdgeStep_m = 0.1, kBeside_m = 0.02, kAbove_m = 0.01;
/// Heights at which a wall or a railing may bar an edge: skirtings and slits may be at its foot.
constexpr std::array<double, 3> kBarred_m{kAbove_m, 0.1, 1};
constexpr double kMostSteps = 1. / 3;
/// Parts of a floor that are narrower belong to no room: they are inside of walls, or slits beside doors.
constexpr double kNarrow_m = 0.5;

/// All objects but lamps, as triangles.
struct Surface {
    ObjectId object;
    Mesh mesh;
};
std::vector<Surface> surfaces_of(const Scene& scene) {
    const std::set<ObjectId> lamps = scene::lamps_of(scene);
    std::vector<Surface> surfaces;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        if (!lamps.contains(ObjectId{i}))
            surfaces.push_back({ObjectId{i}, geometry::drawn_as_mesh(scene.objects[i].shape)});
    }
    return surfaces;
}

/// Horizontal triangles at one height.
struct Level {
    double z = 0;
    Paths triangles;
};
std::vector<Level> levels_of(std::span<const Surface> surfaces, std::span<const ObjectId> floors_of) {
    std::vector<std::pair<double, Path>> triangles;
    for (const Surface& surface : surfaces) {
        const bool is_wanted =
            floors_of.empty() || std::ranges::find(floors_of, surface.object) != floors_of.end();
        if (!is_wanted) continue;
        for (const Triangle& corners : surface.mesh.triangles) {
            const Vec3 &a = surface.mesh.vertices[corners[0]], &b = surface.mesh.vertices[corners[1]],
                       &c = surface.mesh.vertices[corners[2]];
            const Vec3 across = cross(b - a, c - a);
            if (!(std::abs(across.z) > kLevelCosine * length(across))) continue;
            Path path{to_units(a), to_units(b), to_units(c)};
            if (!ClipperLib::Orientation(path)) ClipperLib::ReversePath(path);
            triangles.emplace_back(std::max({a.z, b.z, c.z}), std::move(path));
        }
    }
    std::ranges::sort(triangles, {}, &std::pair<double, Path>::first);
    std::vector<Level> levels;
    for (auto& [z, path] : triangles) {
        if (levels.empty() || z > levels.back().z + kSameLevel_m) levels.push_back({z, {}});
        levels.back().z = z;
        levels.back().triangles.push_back(std::move(path));
    }
    return levels;
}

/// The heights of free space above points that are spread over a piece; infinite where nothing is above.
std::vector<double> clear_heights(const Piece& piece, double z, const rays::RayCaster& caster) {
    // A house on its grounds is found where the points are a metre apart.
    constexpr double kLeastPoints = 100, kMostPoints = 40'000, kStep_m = 1;
    const double step_m = std::max(std::min(std::sqrt(area_m2(piece) / kLeastPoints), kStep_m),
                                   std::sqrt(area_m2(piece) / kMostPoints));
    const double step = step_m * kUnits_per_m;
    const ClipperLib::IntRect bounds = [&] {
        ClipperLib::IntRect of{piece.outline[0].X, piece.outline[0].Y, piece.outline[0].X,
                               piece.outline[0].Y};
        for (const auto& p : piece.outline) {
            of.left = std::min(of.left, p.X), of.right = std::max(of.right, p.X);
            of.top = std::min(of.top, p.Y), of.bottom = std::max(of.bottom, p.Y);
        }
        return of;
    }();
    std::vector<double> heights;
    for (double y = static_cast<double>(bounds.top) + 0.47 * step; y < static_cast<double>(bounds.bottom);
         y += step) {
        for (double x = static_cast<double>(bounds.left) + 0.53 * step; x < static_cast<double>(bounds.right);
             x += step) {
            const ClipperLib::IntPoint point(std::llround(x), std::llround(y));
            if (!contains(piece, point)) continue;
            const auto above = caster.closest(to_metres(point, z + kAbove_m), {0, 0, 1});
            heights.push_back(above ? above->distance_m : std::numeric_limits<double>::infinity());
        }
    }
    return heights;
}

/// What is above a piece.
struct Headroom {
    double height_m = 0;            ///< the median of the places where one can stand
    double standing = 0, open = 0;  ///< the shares of these places, and of those that are open to the sky

    /// Tables and shelves may cover most of a floor.
    bool is_room() const { return standing >= kLeastStanding && open <= kMostOpen; }
};
Headroom headroom_of(const Piece& piece, double z, const rays::RayCaster& caster) {
    const std::vector<double> heights = clear_heights(piece, z, caster);
    std::vector<double> standing;
    std::size_t open = 0;
    for (const double height : heights) {
        if (!std::isfinite(height)) {
            ++open;
        } else if (height >= kLeastClear_m) {
            standing.push_back(height);
        }
    }
    if (standing.empty()) return {};
    const auto all = static_cast<double>(heights.size());
    const auto middle = standing.begin() + static_cast<std::ptrdiff_t>(standing.size() / 2);
    std::ranges::nth_element(standing, middle);
    return {*middle, static_cast<double>(standing.size()) / all, static_cast<double>(open) / all};
}

/// The share of a piece's edges over which one may step down.
double share_of_steps(const Piece& piece, double z, const rays::RayCaster& caster) {
    std::size_t steps = 0, all = 0;
    const auto look = [&](const Path& path) {
        for (std::size_t i = 0; i < path.size(); ++i) {
            const Vec3 from = to_metres(path[i], z + kAbove_m),
                       to = to_metres(path[(i + 1) % path.size()], z + kAbove_m);
            const double length_m = length(to - from);
            if (!(length_m > 0)) continue;
            const Vec3 aside = kBeside_m / length_m * Vec3{-(to - from).y, (to - from).x, 0};
            const auto count = static_cast<int>(std::ceil(length_m / kEdgeStep_m));
            for (int k = 0; k < count; ++k) {
                const Vec3 edge = from + (k + 0.5) / count * (to - from);
                ++all;
                const auto is_barred = [&](double above_m) {
                    const Vec3 up{0, 0, above_m - kAbove_m};
                    return caster.occluded(edge + aside + up, edge - aside + up);
                };
                if (std::ranges::any_of(kBarred_m, is_barred)) continue;
                for (const Vec3& side : {edge + aside, edge - aside}) {
                    const auto below = caster.closest(side, {0, 0, -1});
                    if (below && below->distance_m < kAbove_m + kBeside_m) continue;
                    ++steps;
                    break;
                }
            }
        }
    };
    look(piece.outline);
    for (const Path& hole : piece.holes) look(hole);
    return static_cast<double>(steps) / static_cast<double>(std::max<std::size_t>(all, 1));
}

Paths section_at(std::span<const Surface> surfaces, double z) {
    Paths lines;
    for (const Surface& surface : surfaces) {
        for (const Triangle& triangle : surface.mesh.triangles) {
            if (const auto cut = geometry::cut_at(surface.mesh, triangle, z))
                lines.push_back({to_units((*cut)[0]), to_units((*cut)[1])});
        }
    }
    return lines;
}

/// A part as it is; but where it is narrow in between, each side of that; nothing where it is narrow
/// everywhere.
std::vector<Piece> cut_where_narrow(Piece part) {
    const std::vector<Piece> wide =
        pieces_of(widened(part.paths(), ClipperLib::etClosedPolygon, -kNarrow_m / 2));
    if (wide.size() == 1) return {std::move(part)};
    std::vector<Piece> sides;
    for (const Piece& piece : wide) {
        const Paths whole = widened(piece.paths(), ClipperLib::etClosedPolygon, kNarrow_m / 2);
        std::ranges::move(pieces_of(combined(part.paths(), ClipperLib::ctIntersection, whole)),
                          std::back_inserter(sides));
    }
    return sides;
}

/// The parts of a horizontal surface on the sides of walls: a house and its grounds may be one surface.
std::vector<Piece> parts_between(const Piece& piece, const Paths& walls) {
    std::vector<Piece> parts;
    for (Piece& part : pieces_of(combined(piece.paths(), ClipperLib::ctDifference,
                                          widened(walls, ClipperLib::etOpenSquare, kLeastMargin_m))))
        std::ranges::move(cut_where_narrow(std::move(part)), std::back_inserter(parts));
    return parts;
}

struct Floor {
    double z = 0;
    Piece piece;
};
/// Whether a small floor is the top of a bed or a table that stands on a larger one.
bool is_furniture(const Floor& floor, const std::vector<Floor>& below) {
    if (area_m2(floor.piece) > kLargestFurniture_m2) return false;
    return std::ranges::any_of(below, [&](const Floor& other) {
        const double height_m = floor.z - other.z;
        return height_m > kSameLevel_m && height_m < kHighestFurniture_m &&
               reaches(other.piece, floor.piece.outline.front());
    });
}

}  // namespace

std::vector<FloorSurface> find_floors(const Scene& scene, const rays::RayCaster& caster,
                                      std::span<const ObjectId> floors_of) {
    const std::vector<Surface> surfaces = surfaces_of(scene);
    std::vector<FloorSurface> all;
    std::vector<Floor> floors;
    std::map<double, Paths> sections;  // by their height: most floors of a storey have the same
    const auto walls_at = [&](double z) -> const Paths& {
        const auto [found, is_new] = sections.try_emplace(z);
        if (is_new) found->second = section_at(surfaces, z);
        return found->second;
    };
    for (const Level& level : levels_of(surfaces, floors_of)) {
        for (Piece& piece : pieces_of(outlines_of(level.triangles))) {
            if (area_m2(piece) < kLeastFloor_m2) continue;
            const Headroom headroom = headroom_of(piece, level.z, caster);
            if (!(headroom.standing > 0)) continue;
            FloorSurface own{level.z,
                             headroom.height_m,
                             std::min(kSection_m, kSectionShare * headroom.height_m),
                             std::move(piece),
                             {},
                             {}};
            own.walls = walls_at(level.z + own.section_m);
            for (Piece& part : parts_between(own.surface, own.walls)) {
                if (area_m2(part) < kLeastFloor_m2 || !headroom_of(part, level.z, caster).is_room()) continue;
                if (share_of_steps(part, level.z, caster) > kMostSteps) continue;
                Floor floor{level.z, std::move(part)};
                if (is_furniture(floor, floors)) continue;
                own.floors.push_back(floor.piece);
                floors.push_back(std::move(floor));
            }
            if (!own.floors.empty()) all.push_back(std::move(own));
        }
    }
    return all;
}

}  // namespace stilb::sensors
