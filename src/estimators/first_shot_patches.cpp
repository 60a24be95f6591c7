#include "estimators/first_shot_patches.h"

namespace stilb {
namespace {

FirstShotOptions first_shot_options(const PatchOptions& asked, const Patches& patches) {
    FirstShotOptions options = asked.first_shot;
    options.shooting.resolution = asked.resolution.value_or(first_shot_resolution(patches.count()));
    return options;
}

}  // namespace

FirstShotPatches::FirstShotPatches(const Scene& all, const RayCaster& rays, const PatchOptions& asked)
    : scene(all),
      caster(rays),
      options(asked),
      lights(scene, caster),
      size_m(options.patch_m.value_or(patch_size_m(scene))),
      patches(make_patches(scene, size_m)),
      patch_caster(patches),
      first_shot(scene, caster, lights, patch_caster, first_shot_options(options, patches)) {}

PatchReport FirstShotPatches::report() const {
    const auto decided = first_shot.lights();
    return {
        patches.count(),       size_m,
        first_shot.variant(),  first_shot.resolution(),
        first_shot.missed(),   static_cast<double>(first_shot.bytes()) / static_cast<double>(patches.count()),
        first_shot.set_up_s(), {decided.begin(), decided.end()}};
}

}  // namespace stilb
