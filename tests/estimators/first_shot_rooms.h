// Rooms with small lights, prepared for first shot.
#pragma once

#include "estimators/patch_light/first_shot/first_shot.h"
#include "patches/visibility/opengl.h"
#include "support/scene_builder.h"

namespace stilb::estimators {

/// All that first shot needs of a scene.
struct PreparedScene {
    Scene scene;
    rays::RayCaster caster;
    transport::LightSampler sampler;
    patches::Patches patches;
    patches::PatchCaster patch_caster;

    PreparedScene(Scene made, double patch_size_m)
        : scene(std::move(made)),
          caster(scene),
          sampler(scene, caster),
          patches(patches::make_patches(scene, patch_size_m)),
          patch_caster(patches) {}

    FirstShotLights lights() const { return choose_first_shot_lights(scene, caster, patches.center); }
    FirstShot first_shot(const FirstShotOptions& options) const {
        return {scene, caster, sampler, patch_caster, options};
    }
    std::uint32_t sides() const { return static_cast<std::uint32_t>(2 * patches.count()); }
    double area_m2(std::uint32_t side) const { return patches.areas_m2[patches.patch_of(side)]; }
    Vec3 middle(std::uint32_t side) const { return patches.middle(patches.patch_of(side)); }
    ObjectId object_of(std::uint32_t side) const { return patches.object_of(patches.patch_of(side)); }
};

inline constexpr Box kCube{{0, 0, 0}, {4, 4, 4}};

inline Scene empty_cube(const Material& material) {
    Scene scene;
    add_object(scene, inward(kCube), material);
    return scene;
}

/// 10 klm at the centre.
inline Scene cube_with_bulb(const Material& material) {
    Scene scene = empty_cube(material);
    add_point_light(scene, {2, 2, 2}, Rgb::grey(1e4 / (4 * std::numbers::pi)));
    return scene;
}

}  // namespace stilb::estimators
