// The room of [LocalEstimation], figure 5, with the head that stands in it there. The paper tells neither the
// head's size nor its place: both are chosen.
#pragma once

#include <array>
#include <vector>

#include "scene/scene.h"
#include "sensors/sensor.h"

namespace stilb::papers {

/// Puts a mesh, y up and its face along z as most files have it, into the room: upright, with the face to
/// the wall behind the camera, and the longest edge of its box 1.2 m whatever its size was.
Mesh placed_in_room(Mesh head);

/// The head is the last object, of grey clay. It touches nothing.
Scene room_with(Shape head);
/// The room's own camera.
Sensor view_of_room(const std::array<int, 2>& resolution);
/// The head alone, three quarter from the front.
Sensor view_of_head(const std::array<int, 2>& resolution);

/// A point of the head that the middle of a pixel shows.
struct HeadPoint {
    std::size_t pixel = 0;
    Vec3 position;
    Vec3 smooth_normal;  ///< unit: the vertices' normals, which are weighted by area, between them
};
/// Of a room with a mesh whose fronts are outside.
std::vector<HeadPoint> visible_points(const Scene& room_with_mesh, const Camera& camera);

}  // namespace stilb::papers
