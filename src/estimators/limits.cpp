#include "estimators/limits.h"

#include <fmt/format.h>

#include <algorithm>

namespace stilb {

bool has_specular_surfaces(const Scene& scene) {
    return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
        return std::any_of(object.materials.begin(), object.materials.end(),
                           [&](MaterialId id) { return is_specular(scene.material(id)); });
    });
}

std::vector<std::string> specular_warnings(const Scene& scene, std::string_view what) {
    const bool point_like = std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
        return !std::holds_alternative<AreaLight>(light.source);
    });
    if (!point_like || !has_specular_surfaces(scene)) return {};
    return {
        fmt::format("{}: that light is missing from the readings. Area lights and spheres of a size that "
                    "can be seen have no such limit.",
                    what)};
}

}  // namespace stilb
