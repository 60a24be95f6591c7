// Rooms to look around in, for tests of item buffers.
#pragma once

#include "patches/visibility/item_buffer.h"
#include "support/scene_builder.h"

namespace stilb::patches {

inline const Box kRoom{{0, 0, 0}, {5, 4, 3}};

/// A room with a cabinet, a table top that is seen from both sides, and a ball.
inline Scene furnished_room() {
    Scene scene;
    add_object(scene, inward(kRoom), diffuse(0.5));
    add_object(scene, Box{{0.5, 0.4, 0}, {1.4, 1.1, 1.8}}, diffuse(0.5));
    add_object(scene, Rectangle{{2, 1.5, 0.75}, {1.6, 0, 0}, {0, 0.8, 0}}, diffuse(0.5));
    add_object(scene, Sphere{{3.1, 3.2, 0.5}, 0.45}, diffuse(0.5));
    add_object(scene, Disk{{4.2, 1, 1.4}, normalized(Vec3{1, 1, 0.5}), 0.5}, diffuse(0.5));
    return scene;
}

/// The same with the cabinet off the floor: no two surfaces lie in each other.
inline Scene room_without_overlaps() {
    Scene scene = furnished_room();
    scene.objects[1].shape = Box{{0.5, 0.4, 0.1}, {1.4, 1.1, 1.8}};
    return scene;
}

inline Scene empty_room() {
    Scene scene;
    add_object(scene, inward(kRoom), diffuse(0.5));
    return scene;
}

/// Turned by no particular angle.
inline Viewpoint point_in_room() {
    return {{2.3, 1.9, 1.6}, Frame::around(normalized(Vec3{0.3, -0.5, 0.8}))};
}

}  // namespace stilb::patches
