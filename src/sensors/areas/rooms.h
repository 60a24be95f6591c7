// The rooms of a scene, for what belongs to one of them: bands around areas, and its walls and ceiling.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "rays/ray_caster.h"
#include "scene/scene.h"
#include "sensors/areas/area.h"
#include "sensors/areas/plane_region.h"

namespace stilb::sensors {

/// A floor between walls (working_planes.h). Openings narrower than twice the margin of working planes end
/// it, as doors do.
struct Room {
    Region floor;                       ///< on the plan
    double floor_m = 0, highest_m = 0;  ///< z of the floor, and of what is above most of it
    double section_m = 0;               ///< the height above the floor at which walls were looked for

    double area_m2() const;
    Bounds extent() const;
    bool contains(const Vec3& point) const;
    /// A point on the plan; edges belong to the room.
    bool is_under(const Vec3& point) const;
};

/// From the lowest floor up.
std::vector<Room> find_rooms(const Scene& scene, const rays::RayCaster& caster);

/// The rooms of a scene, which are found when they are asked for.
class RoomsOnDemand {
  public:
    explicit RoomsOnDemand(const Scene& scene) : scene_(scene) {}

    const Scene& scene() const { return scene_; }
    const rays::RayCaster& caster();
    const std::vector<Room>& rooms();

  private:
    const Scene& scene_;
    std::optional<rays::RayCaster> caster_;
    std::optional<std::vector<Room>> rooms_;
};

/// The first room from below that contains the point; null where there is none.
const Room* room_at(std::span<const Room> rooms, const Vec3& point);
/// The room with most of an area's points; null where no room has one.
const Room* room_of(std::span<const Room> rooms, const Area& area);

/// Ends a band at the walls of a room: removes the points beyond them, and makes the raster smaller. It may
/// have no point afterwards.
void end_at_walls(const Room& room, const Scene& scene, const rays::RayCaster& caster, Area& band);

/// Makes the points of an area on the walls, the ceiling or the floor of a room. What lets light through, and
/// lamps, are not part of them. A fault where there are none, or too many points.
std::optional<Fault> place_in(const Room& room, const Scene& scene, const rays::RayCaster& caster,
                              Area& area);

}  // namespace stilb::sensors
