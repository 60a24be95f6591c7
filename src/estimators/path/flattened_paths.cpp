#include "estimators/path/flattened_paths.h"

#include <fmt/format.h>

#include <algorithm>

#include "estimators/limits.h"

namespace stilb::estimators {
namespace {

std::unique_ptr<const FirstShotPatches> patches_for(const Scene& scene, const rays::RayCaster& caster,
                                                    const PatchOptions& options, const Monitor& monitor) {
    if (options.first_shot.variant.value_or(FirstShotVariant::none) == FirstShotVariant::none) return nullptr;
    return std::make_unique<FirstShotPatches>(scene, caster, options, monitor);
}

std::vector<bool> replaced(const FirstShotPatches* patches) {
    std::vector<bool> lights;
    if (!patches) return lights;
    for (const FirstShotLight& light : patches->first_shot.lights()) lights.push_back(light.is_replaced);
    return lights;
}

bool has_panes(const Scene& scene) {
    return std::ranges::any_of(scene.materials,
                               [](const NamedMaterial& named) { return passes_straight(named.material); });
}

}  // namespace

FlattenedPaths::FlattenedPaths(const Scene& all, const rays::RayCaster& caster, const PatchOptions& options,
                               const Monitor& monitor)
    : scene(all),
      patches(patches_for(scene, caster, options, monitor)),
      lights(scene, caster, replaced(patches.get())),
      tracer(scene, caster, lights, patches.get()) {}

std::vector<std::string> FlattenedPaths::warnings() const {
    std::vector<std::string> warnings = path_warnings(scene);
    if (!patches) return warnings;
    const FirstShotVariant variant = patches->first_shot.variant();
    warnings.push_back(fmt::format(
        "path tracing with first shot ({}) is biased by patches of {:.2g} m; the stated errors do not "
        "include this bias: halve the size of the patches to see how large it is.",
        name_of(variant), patches->size_m));
    if (variant != FirstShotVariant::on_the_fly && has_panes(scene)) {
        warnings.push_back(fmt::format(
            "first shot ({}) ends at panes: light of small lights that passes one before anything else is "
            "missing. Use first shot \"on-the-fly\".",
            name_of(variant)));
    }
    return warnings;
}

std::optional<PatchReport> FlattenedPaths::report() const {
    return patches ? std::optional{patches->report()} : std::nullopt;
}

}  // namespace stilb::estimators
