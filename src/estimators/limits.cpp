#include "estimators/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "materials/black.h"
#include "materials/diffuse.h"
#include "stilb/error.h"
#include "transport/receiver.h"
#include "transport/weights.h"

namespace stilb::estimators {
namespace {

std::vector<std::string> specular_warnings(const Scene& scene, std::string_view what) {
    if (!has_light_for_light_paths_only(scene)) return {};
    return {
        fmt::format("{}: that light is missing. Area lights and luminous spheres "
                    "have no such limit.",
                    what)};
}

}  // namespace

bool has_specular_surfaces(const Scene& scene) {
    return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
        return std::ranges::any_of(materials_of(scene, object),
                                   [&](MaterialId id) { return is_specular(scene.material(id)); });
    });
}

bool has_light_for_light_paths_only(const Scene& scene) {
    return has_specular_surfaces(scene) && std::ranges::any_of(scene.lights, [](const Light& light) {
               return location_of(light) == LightLocation::point;
           });
}

std::vector<std::string> path_warnings(const Scene& scene) {
    return specular_warnings(scene,
                             "path tracing cannot find light that leaves a point or photometry light and is "
                             "reflected by a mirror or pane or meets solid glass before anything else");
}

std::vector<std::string> solution_warnings(const Scene& scene) {
    return specular_warnings(
        scene,
        "a solution lacks light that leaves a point or photometry light and is reflected "
        "by a mirror or pane or meets solid glass before anything else");
}

std::vector<std::string> patch_warnings(const Scene& scene, std::string_view method) {
    if (!has_specular_surfaces(scene)) return {};
    return {
        fmt::format("method {}: mirrors and glass act only on the lines of sight of sensors: light "
                    "that they cast on other surfaces is missing.",
                    method)};
}

void require_diffuse(const Scene& scene, std::string_view method) {
    for (const Object& object : scene.objects) {
        for (const MaterialId id : materials_of(scene, object)) {
            const NamedMaterial& used = scene.materials[index_of(id)];
            if (used.material.is<Diffuse>() || used.material.is<Black>()) {
                continue;
            }
            throw InputError(fmt::format(
                "object \"{}\": its material \"{}\" is neither diffuse nor black, but method {} computes one "
                "luminance for all directions of a surface. Use method auto or ray-bundle.",
                object.name, used.name, method));
        }
    }
}

const Scene& require_reflection_only(const Scene& scene) {
    for (const Object& object : scene.objects) {
        for (const MaterialId id : materials_of(scene, object)) {
            const NamedMaterial& used = scene.materials[index_of(id)];
            if (!is_composed(used.material)) continue;
            throw InputError(fmt::format(
                "object \"{}\": its material \"{}\" is {} and lets light through, but methods with patches "
                "keep "
                "only the light that surfaces reflect. Use method auto, path or local, without first shot.",
                object.name, used.name, type_name(used.material)));
        }
    }
    return scene;
}

void require_first_shot_of_points(const Scene& scene, FirstShotVariant variant, std::string_view method) {
    if (variant != FirstShotVariant::none) return;
    for (const Light& light : scene.lights) {
        if (location_of(light) != LightLocation::point) continue;
        throw InputError(fmt::format(
            "method {} needs a first shot here: light \"{}\" is not a surface, and would light nothing "
            "without one. Use first shot \"incoming\".",
            method, light.name));
    }
}

void require_no_light_from_outside(const Scene& scene, std::string_view method) {
    for (const Light& light : scene.lights) {
        if (location_of(light) != LightLocation::infinity) continue;
        throw InputError(fmt::format(
            "light \"{}\" surrounds the scene, but method {} transports light between surfaces only. Use "
            "method auto, local, double-local, path, ray-bundle or particles.",
            light.name, method));
    }
}

void require_all_reflections(int max_reflections, std::string_view method) {
    if (max_reflections == transport::kUnlimited) return;
    throw InputError(
        fmt::format("method {} does not support a limit on reflections (bounces): it computes all of them "
                    "together.",
                    method));
}

std::uint64_t paths_at_once(const Scene& scene, std::uint64_t wanted) {
    constexpr double most_vertices = 1 << 21;  // some 300 MB
    double survival = 0;
    for (const auto& named : scene.materials) {
        if (!is_specular(named.material))
            survival = std::max(
                survival, transport::survival_probability(Rgb::grey(1), reflectance_bound(named.material)));
    }
    const double most = std::max(1., most_vertices * (1 - survival));
    return static_cast<double>(wanted) > most ? static_cast<std::uint64_t>(most) : wanted;
}

std::vector<std::string> local_warnings(const Scene& scene) {
    return specular_warnings(scene,
                             "local estimation cannot find light that leaves a point or photometry light, is "
                             "reflected by a mirror "
                             "or pane or meets solid glass first, and reaches the point (for luminance: the "
                             "surface that is seen) "
                             "by a mirror or glass last");
}

}  // namespace stilb::estimators
