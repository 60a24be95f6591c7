// Solutions without light, for the data of walks.
#pragma once

#include "rays/ray_caster.h"
#include "support/scene_builder.h"
#include "walk/display_mesh.h"
#include "walk/walk_data.h"

namespace stilb::walk {

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
