// Solutions without light, for the data of walks.
#pragma once

#include "rays/ray_caster.h"
#include "support/scene_builder.h"
#include "walk/data/walk_data.h"
#include "walk/display/display_mesh.h"

namespace stilb::walk {

inline constexpr Box kRoom{{0, 0, 0}, {4, 3, 2.5}}, kBox{{1.2, 1, 0}, {1.9, 1.6, 0.8}};
inline constexpr Sphere kBall{{2.9, 1.9, 0.35}, 0.35};

/// A box and a ball in a room, by a bulb and a panel.
inline Scene furnished_room() {
    Scene scene;
    add_walls(scene, kRoom,
              {diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5), diffuse(0.5)});
    add_object(scene, kBox, diffuse(0.3));
    add_object(scene, kBall, diffuse(0.3));
    add_point_light(scene, {0.8, 0.7, 2.1}, Rgb::grey(150));
    add_area_light(scene, Rectangle{{2.6, 1.2, 2.45}, {0, 0.4, 0}, {0.5, 0, 0}}, Rgb::grey(2500),
                   diffuse(0.5));
    return scene;
}

/// A scene with a display mesh, as if no reflected light had been computed.
struct DisplayedScene {
    Scene scene;
    rays::RayCaster caster;
    patches::Patches patches;
    DisplayMesh mesh;

    DisplayedScene(Scene made, double patch_size_m, const DisplayOptions& options = {})
        : scene(std::move(made)),
          caster(scene),
          patches(patches::make_patches(scene, patch_size_m)),
          mesh(make_display_mesh(scene, caster, patches, std::vector<bool>(2 * patches.count()), options)) {}
};

}  // namespace stilb::walk
