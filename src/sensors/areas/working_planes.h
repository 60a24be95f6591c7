// Working planes over the floors of rooms, found in the scene.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rays/ray_caster.h"
#include "scene/scene.h"
#include "sensors/sensor.h"

namespace stilb::sensors {

struct WorkingPlaneOptions {
    double height_m = 0.75;  ///< above the floor
    double margin_m = 0.5;   ///< distance from walls: EN 12464-1 leaves out a strip of that width
};

/// A plane over a floor, or a part of it.
struct WorkingPlane {
    PolygonInSpace polygon;
    double floor_m = 0;  ///< coordinate z of the floor
};

/// The working planes of all rooms, from the lowest floor up, or of those whose floors belong to the objects.
///
/// A floor is a horizontal surface of 1 m2 or more with 1.8 m or more of free space up to something above it,
/// of whose edges no more than a third are steps down: tables have more, landings fewer. Walls are what a
/// horizontal section 1.9 m above the floor cuts (in lower rooms nine tenths of the way up), so that
/// furniture and parapets are none, and lintels close no door. A plane keeps its margin from walls and from
/// the ends of the floor; what is left in several pieces is several planes. Doors narrower than two margins
/// part rooms so.
std::vector<WorkingPlane> working_planes(const Scene& scene, const rays::RayCaster& caster,
                                         const WorkingPlaneOptions& options,
                                         std::span<const ObjectId> floors_of = {});
/// The same over a floor that is given as a horizontal polygon, without walls.
std::vector<WorkingPlane> working_planes(const PolygonInSpace& floor, const WorkingPlaneOptions& options);

/// Why there may be none.
std::string no_plane_message(const WorkingPlaneOptions& options);

/// An area for each plane: `name`, or where there are several NAME_1, NAME_2 and so on. By default the
/// spacing is that of EN 12464-1. Planes that are so narrow that they hold no point are left out.
std::vector<Sensor> sensors_on(std::span<const WorkingPlane> planes, const std::string& name,
                               const std::optional<double>& spacing_m);

}  // namespace stilb::sensors
