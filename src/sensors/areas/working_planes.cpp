#include "sensors/areas/working_planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "sensors/areas/floors.h"

namespace stilb::sensors {
namespace {

constexpr double kLeastPlane_m2 = 0.1;

/// From the corner that is nearest to lower left on the plan, so that rasters begin there.
std::vector<Vec3> outline_at(Path path, double z) {
    const auto lower_left =
        std::ranges::min_element(path, {}, [](const ClipperLib::IntPoint& p) { return p.X + p.Y; });
    std::rotate(path.begin(), lower_left, path.end());
    return corners_at(path, z);
}

/// The parts of a floor that keep a margin from walls and edges, at a height above it.
std::vector<WorkingPlane> planes_over(const Piece& floor, double floor_m, const Paths& walls,
                                      const WorkingPlaneOptions& options) {
    const double margin_m = std::max(options.margin_m, kLeastMargin_m);
    Paths region = combined(widened(floor.paths(), ClipperLib::etClosedPolygon, -options.margin_m),
                            ClipperLib::ctDifference, widened(walls, ClipperLib::etOpenSquare, margin_m));
    ClipperLib::CleanPolygons(region, kLeastMargin_m * kUnits_per_m);
    std::vector<WorkingPlane> planes;
    const double z = floor_m + options.height_m;
    for (const Piece& piece : pieces_of(region)) {
        if (area_m2(piece) < kLeastPlane_m2) continue;
        WorkingPlane& plane = planes.emplace_back(WorkingPlane{{outline_at(piece.outline, z), {}}, floor_m});
        for (const Path& hole : piece.holes) plane.polygon.holes.push_back(corners_at(hole, z));
    }
    return planes;
}

}  // namespace

std::vector<WorkingPlane> working_planes(const Scene& scene, const rays::RayCaster& caster,
                                         const WorkingPlaneOptions& options,
                                         std::span<const ObjectId> floors_of) {
    std::vector<WorkingPlane> all;
    for (const FloorSurface& floor : find_floors(scene, caster, floors_of)) {
        for (WorkingPlane& plane : planes_over(floor.surface, floor.z, floor.walls, options)) {
            const ClipperLib::IntPoint corner = to_units(plane.polygon.outline.front());
            const auto is_over = [&](const Piece& piece) { return reaches(piece, corner); };
            if (std::ranges::any_of(floor.floors, is_over)) all.push_back(std::move(plane));
        }
    }
    const auto place = [](const WorkingPlane& plane) {
        const auto& outline = plane.polygon.outline;
        const double least_x = std::ranges::min(outline, {}, &Vec3::x).x,
                     least_y = std::ranges::min(outline, {}, &Vec3::y).y;
        return std::tuple(plane.floor_m, least_y, least_x);
    };
    std::ranges::sort(all, {}, place);
    return all;
}

std::vector<WorkingPlane> working_planes(const PolygonInSpace& floor, const WorkingPlaneOptions& options) {
    const auto path_of = [](const std::vector<Vec3>& corners, bool is_outline) {
        Path path;
        for (const Vec3& corner : corners) path.push_back(to_units(corner));
        if (ClipperLib::Orientation(path) != is_outline) ClipperLib::ReversePath(path);
        return path;
    };
    Piece piece{path_of(floor.outline, true), {}};
    for (const std::vector<Vec3>& hole : floor.holes) piece.holes.push_back(path_of(hole, false));
    return planes_over(piece, floor.outline.front().z, {}, options);
}

std::string no_plane_message(const WorkingPlaneOptions& options) {
    return fmt::format(
        "found no floor of a room with a place for a point {:g} m away from its walls. A floor is "
        "horizontal, has 1 m² or more, and something 1.8 m or more above it. Needed: a smaller margin or "
        "spacing, a ceiling, or a sensor with coordinates (type \"area\").",
        options.margin_m);
}

std::vector<Sensor> sensors_on(std::span<const WorkingPlane> planes, const std::string& name,
                               const std::optional<double>& spacing_m) {
    std::vector<Sensor> sensors;
    for (const WorkingPlane& plane : planes) {
        Area area{.polygon = plane.polygon, .normal = Vec3{0, 0, 1}, .spacing_m = spacing_m};
        if (!area.settle(GivenKeys({}))) sensors.push_back({name, std::move(area)});
    }
    if (sensors.size() == 1) return sensors;
    for (std::size_t i = 0; i < sensors.size(); ++i) sensors[i].name = fmt::format("{}_{}", name, i + 1);
    return sensors;
}

}  // namespace stilb::sensors
