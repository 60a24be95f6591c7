#include "sensors/areas/rooms.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "sensors/areas/floors.h"
#include "sensors/areas/raster.h"
#include "sensors/areas/surface_points.h"

namespace stilb::sensors {
namespace {

/// Half the width of the openings that end a room: the margin of working planes.
constexpr double kHalfDoor_m = 0.5;
/// What is narrower, such as the depth of a window in its wall, is no part of a room.
constexpr double kLeastNiche_m = 0.5;
constexpr double kLeastCore_m2 = 1e-4;
/// Points are looked at a little in front of their surface.
constexpr double kInFront_m = 0.02;
constexpr double kRoundingOnPlan_m = 1e-4;
/// A wall below a window stands so far in front of the pane at most.
constexpr double kDeepestWindow_m = 0.3;

Paths joined(const Paths& a, const Paths& b) { return combined(a, ClipperLib::ctUnion, b); }
Paths common(const Paths& a, const Paths& b) { return combined(a, ClipperLib::ctIntersection, b); }

Paths beyond(const Paths& region, double distance_m) {
    return widened(region, ClipperLib::etClosedPolygon, distance_m);
}

/// The parts of a floor that its doors part. Niches belong to the part at which they end.
std::vector<Paths> parts_between_doors(const Piece& floor, const Paths& walls) {
    const Paths all = floor.paths();
    const Paths cores = combined(beyond(all, -kHalfDoor_m), ClipperLib::ctDifference,
                                 widened(walls, ClipperLib::etOpenSquare, kHalfDoor_m));
    std::vector<Paths> parts;
    Paths rest = all;
    for (const Piece& core : pieces_of(cores)) {
        if (area_m2(core) < kLeastCore_m2) continue;
        parts.push_back(common(beyond(core.paths(), kHalfDoor_m), all));
        rest = combined(rest, ClipperLib::ctDifference, parts.back());
    }
    if (parts.empty()) return {all};
    const Paths niches = common(beyond(beyond(rest, -kLeastNiche_m / 2), kLeastNiche_m / 2), rest);
    for (const Piece& niche : pieces_of(niches)) {
        const Paths around = common(beyond(niche.paths(), kLeastMargin_m), all);
        Paths* only = nullptr;
        std::size_t touched = 0;
        for (Paths& part : parts) {
            if (common(around, part).empty()) continue;
            only = &part;
            ++touched;
        }
        if (touched == 1) *only = joined(*only, around);
    }
    return parts;
}

Region region_of(const Piece& piece) {
    Region region;
    Paths paths{piece.outline};
    paths.insert(paths.end(), piece.holes.begin(), piece.holes.end());
    for (const Path& path : paths) {
        Ring& ring = region.emplace_back();
        for (const Vec3& corner : corners_at(path, 0)) ring.push_back({corner.x, corner.y});
    }
    return region;
}

/// Looks for the surfaces of a room, in which lamps and panes do not count.
class Surveyor {
  public:
    Surveyor(const Scene& scene, const rays::RayCaster& caster)
        : scene_(scene), caster_(caster), lamps_(scene::lamps_of(scene)) {}

    std::optional<rays::Hit> first(Vec3 from, const Vec3& direction) const {
        while (auto hit = caster_.closest(from, direction)) {
            if (!lamps_.contains(hit->object) && !transmits(scene_.material(hit->material))) return hit;
            from = hit->lifted_behind();
        }
        return std::nullopt;
    }
    std::optional<rays::Hit> last(const Vec3& from, const Vec3& to) const {
        const Vec3 direction = normalized(to - from);
        std::optional<rays::Hit> found;
        for (auto hit = first(from, direction); hit && dot(to - hit->position, direction) > 0;
             hit = first(hit->lifted_behind(), direction))
            found = hit;
        return found;
    }
    /// The coordinate z of the ceiling above a point of the plan; infinite where none is.
    double ceiling_m(const Room& room, const Vec3& point) const {
        const auto hit = first({point.x, point.y, room.floor_m + room.section_m}, {0, 0, 1});
        return hit ? hit->position.z : std::numeric_limits<double>::infinity();
    }

  private:
    const Scene& scene_;
    const rays::RayCaster& caster_;
    std::set<ObjectId> lamps_;
};

/// The walls between neighbouring corners of a room's outlines, as rectangles up to the highest place of the
/// ceiling along them.
std::vector<PlaneFace> wall_faces(const Room& room, const Surveyor& surveyor) {
    constexpr int kPlaces = 5;
    std::vector<PlaneFace> faces;
    for (const Ring& ring : room.floor) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const auto &from = ring[i], &to = ring[(i + 1) % ring.size()];
            const Vec3 a{from.x, from.y, room.floor_m}, b{to.x, to.y, room.floor_m};
            const double length_m = length(b - a);
            if (!(length_m > kLeastMargin_m)) continue;
            // Outlines run counterclockwise, holes clockwise: the room is on the left.
            const Vec3 inwards = normalized({a.y - b.y, b.x - a.x, 0});
            double top_m = room.floor_m;
            for (int k = 0; k < kPlaces; ++k) {
                const Vec3 place = a + (k + 0.5) / kPlaces * (b - a) + kInFront_m * inwards;
                const double ceiling_m = surveyor.ceiling_m(room, place);
                top_m = std::max(top_m, std::isfinite(ceiling_m) ? ceiling_m : room.highest_m);
            }
            const Vec3 up{0, 0, top_m - room.floor_m};
            faces.push_back({{{b, a, a + up}, {b, a + up, b + up}}, inwards, length_m * up.z});
        }
    }
    return faces;
}

/// The floor as an area.
Area level_area(const Room& room) {
    Area area{.polygon = {}, .normal = Vec3{0, 0, 1}};
    for (const Ring& ring : room.floor) {
        std::vector<Vec3>& corners =
            &ring == &room.floor.front() ? area.polygon.outline : area.polygon.holes.emplace_back();
        for (const PlanePoint& corner : ring) corners.push_back({corner.x, corner.y, room.floor_m});
    }
    return area;
}

/// Of the largest face of a room: of its floor, which is settled, or of a wall.
double spacing_of_largest_m(const Area& floor, double floor_m2, std::span<const PlaneFace> walls) {
    const auto largest = std::ranges::max_element(walls, {}, &PlaneFace::area_m2);
    double u_m = length(floor.raster.edge_u), v_m = length(floor.raster.edge_v);
    if (largest->area_m2 > floor_m2) {
        u_m = length(largest->triangles[0][1] - largest->triangles[0][0]);
        v_m = largest->area_m2 / u_m;
    }
    return raster_spacing_m(std::min(u_m, v_m), std::max(u_m, v_m));
}

/// The wall at a point of a room's outline: the last surface before it, because parapets reach out from below
/// windows, and things stand in front of walls. Nothing in openings.
std::optional<MeasuringPoint> on_wall(const MeasuringPoint& point, const Room& room,
                                      const Surveyor& surveyor) {
    const Vec3 in_front = point.position + kInFront_m * point.normal;
    if (in_front.z >= surveyor.ceiling_m(room, in_front)) return std::nullopt;
    const auto hit = surveyor.last(point.position + kDeepestWindow_m * point.normal,
                                   point.position - kInFront_m * point.normal);
    if (!hit || !is_of_part({{}, hit->normal, 0}, SurfacePart::walls)) return std::nullopt;
    return MeasuringPoint{hit->position, point.normal};
}

std::optional<MeasuringPoint> on_ceiling(const MeasuringPoint& point, const Room& room,
                                         const Surveyor& surveyor) {
    const double z = surveyor.ceiling_m(room, point.position);
    if (!std::isfinite(z)) return std::nullopt;
    return MeasuringPoint{{point.position.x, point.position.y, z}, {0, 0, -1}};
}

/// Leaves out the columns and rows of the raster that have no points.
void shrink_raster(Area& area) {
    if (area.points.empty()) return;
    Grid& raster = area.raster;
    const auto ends_of = [&](const Vec3& edge, int count) {
        std::array<int, 2> ends{count, 0};
        for (const MeasuringPoint& point : area.points) {
            const double share = dot(point.position - raster.corner, edge) / squared_length(edge);
            const int cell = std::clamp(static_cast<int>(share * count), 0, count - 1);
            ends = {std::min(ends[0], cell), std::max(ends[1], cell + 1)};
        }
        return ends;
    };
    const auto u = ends_of(raster.edge_u, raster.count[0]), v = ends_of(raster.edge_v, raster.count[1]);
    const Vec3 cell_u = raster.edge_u / raster.count[0], cell_v = raster.edge_v / raster.count[1];
    raster.corner += u[0] * cell_u + v[0] * cell_v;
    raster.count = {u[1] - u[0], v[1] - v[0]};
    raster.edge_u = raster.count[0] * cell_u;
    raster.edge_v = raster.count[1] * cell_v;
}

}  // namespace

double Room::area_m2() const {
    double doubled = 0;
    for (const Ring& ring : floor) doubled += doubled_area(ring);  // below 0 of holes
    return doubled / 2;
}

Bounds Room::extent() const {
    Bounds bounds;
    for (const PlanePoint& corner : floor.front()) {
        bounds.include({corner.x, corner.y, floor_m});
        bounds.include({corner.x, corner.y, highest_m});
    }
    return bounds;
}

bool Room::is_under(const Vec3& point) const {
    const PlanePoint p{point.x, point.y};
    return sensors::contains(floor.front(), p, kRoundingOnPlan_m) &&
           std::none_of(floor.begin() + 1, floor.end(), [&](const Ring& hole) {
               return sensors::contains(hole, p, 0) && distance_to(hole, p) > kRoundingOnPlan_m;
           });
}

bool Room::contains(const Vec3& point) const {
    return point.z >= floor_m - kRoundingOnPlan_m && point.z <= highest_m + kRoundingOnPlan_m &&
           is_under(point);
}

std::vector<Room> find_rooms(const Scene& scene, const rays::RayCaster& caster) {
    std::vector<Room> rooms;
    for (const FloorSurface& surface : find_floors(scene, caster)) {
        for (const Piece& floor : surface.floors) {
            for (const Paths& part : parts_between_doors(floor, surface.walls)) {
                Paths whole = beyond(part, kLeastMargin_m);
                ClipperLib::CleanPolygons(whole, kLeastMargin_m * kUnits_per_m);
                std::vector<Piece> pieces = pieces_of(whole);
                if (pieces.empty()) continue;
                const auto largest = std::ranges::max_element(
                    pieces, {}, [](const Piece& piece) { return sensors::area_m2(piece); });
                rooms.push_back(
                    {region_of(*largest), surface.z, surface.z + surface.height_m, surface.section_m});
            }
        }
    }
    return rooms;
}

const rays::RayCaster& RoomsOnDemand::caster() {
    if (!caster_) caster_.emplace(scene_);
    return *caster_;
}

const std::vector<Room>& RoomsOnDemand::rooms() {
    if (!rooms_) rooms_ = find_rooms(scene_, caster());
    return *rooms_;
}

const Room* room_at(std::span<const Room> rooms, const Vec3& point) {
    const auto found = std::ranges::find_if(rooms, [&](const Room& room) { return room.contains(point); });
    return found == rooms.end() ? nullptr : &*found;
}

const Room* room_of(std::span<const Room> rooms, const Area& area) {
    constexpr std::size_t kMostLooks = 1000;
    std::map<const Room*, std::size_t> points;
    const std::size_t step = std::max<std::size_t>(1, area.points.size() / kMostLooks);
    for (std::size_t j = 0; j < area.points.size(); j += step) {
        const MeasuringPoint& point = area.points[j];
        if (const Room* room = room_at(rooms, point.position + kInFront_m * point.normal)) ++points[room];
    }
    const auto most =
        std::ranges::max_element(points, {}, &std::pair<const Room* const, std::size_t>::second);
    return most == points.end() ? nullptr : most->first;
}

void end_at_walls(const Room& room, const Scene& scene, const rays::RayCaster& caster, Area& band) {
    const Surveyor surveyor(scene, caster);
    const bool is_level = !band.points.empty() && std::abs(band.points.front().normal.z) > 0.999;
    std::erase_if(band.points, [&](const MeasuringPoint& point) {
        const Vec3 in_front = point.position + kInFront_m * point.normal;
        if (!room.is_under(in_front)) return true;
        return !is_level && (in_front.z < room.floor_m || in_front.z > surveyor.ceiling_m(room, in_front));
    });
    shrink_raster(band);
}

std::optional<Fault> place_in(const Room& room, const Scene& scene, const rays::RayCaster& caster,
                              Area& area) {
    const SurfacePart part = area.surfaces.part;
    const bool is_all = part == SurfacePart::all;
    const Surveyor surveyor(scene, caster);
    const std::vector<PlaneFace> walls = wall_faces(room, surveyor);
    std::optional<double> spacing_m = area.spacing_m;
    std::vector<MeasuringPoint> points;
    const auto add = [&](const std::optional<MeasuringPoint>& point) {
        if (point) points.push_back(*point);
    };
    if (part != SurfacePart::walls) {
        Area level = level_area(room);
        level.spacing_m = spacing_m;
        if (const auto fault = level.settle(GivenKeys({}))) return Fault{"room", fault->message};
        if (is_all && !spacing_m) {
            level.spacing_m = spacing_m = spacing_of_largest_m(level, room.area_m2(), walls);
            if (const auto fault = level.settle(GivenKeys({}))) return Fault{"room", fault->message};
        }
        area.cell_m = level.cell_m;
        for (const MeasuringPoint& point : level.points) {
            if (part != SurfacePart::ceiling) points.push_back(point);
            if (part != SurfacePart::floor) add(on_ceiling(point, room, surveyor));
        }
    }
    if (is_all || part == SurfacePart::walls) {
        Area on_walls{.polygon = {}, .spacing_m = spacing_m};
        if (const auto fault = place_on(walls, on_walls)) return Fault{"room", fault->message};
        for (const MeasuringPoint& point : on_walls.points) add(on_wall(point, room, surveyor));
        if (!is_all) area.cell_m = on_walls.cell_m;
    }
    if (points.empty()) {
        return Fault{"part", fmt::format("the room has no {} that could be measured. Allowed: another part.",
                                         kSurfacePartNames[static_cast<std::size_t>(part)])};
    }
    area.points = std::move(points);
    return std::nullopt;
}

}  // namespace stilb::sensors
