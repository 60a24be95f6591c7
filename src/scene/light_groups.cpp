#include "scene/light_groups.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "stilb/error.h"

namespace stilb::scene {
namespace {

const std::string& group_of(const Light& light) { return light.group.empty() ? light.name : light.group; }

/// Without maintenance.
Rgb dimming(const Light& light, const LightScene& state) {
    Rgb factor = state.others;
    for (const std::string& name : {group_of(light), light.name}) {
        const auto given = std::ranges::find(state.factors, name, &LightFactor::name);
        if (given != state.factors.end()) factor = given->factor;
    }
    return factor;
}

double maintenance_ratio(const Light& light, const LightScene& state) {
    const bool is_lamp = location_of(light) != LightLocation::infinity;
    return state.maintenance && is_lamp ? *state.maintenance / light.maintenance : 1;
}

}  // namespace

LightGroups light_groups(const Scene& scene) {
    LightGroups groups;
    std::unordered_map<std::string_view, std::uint32_t> numbers;  // there may be 100,000 lights
    for (const Light& light : scene.lights) {
        const std::string& name = group_of(light);
        const auto [number, is_new] = numbers.emplace(name, static_cast<std::uint32_t>(groups.count()));
        groups.of_light.push_back(number->second);
        if (is_new) groups.names.push_back(name);
    }
    if (groups.count() <= kMostLightGroups) return groups;
    constexpr std::uint32_t last = kMostLightGroups - 1;
    groups.names.resize(last);
    groups.names.emplace_back(kOtherLights);
    for (std::uint32_t& group : groups.of_light) group = std::min(group, last);
    return groups;
}

std::vector<Rgb> factors_of_groups(std::span<const LightFactor> factors,
                                   std::span<const std::string> groups) {
    std::vector<Rgb> of_groups(groups.size(), Rgb::grey(1));
    for (const LightFactor& given : factors) {
        const auto found = std::ranges::find(groups, given.name);
        if (found == groups.end()) {
            throw InputError(fmt::format("there is no light or group of lights \"{}\". Allowed: {}.",
                                         given.name, fmt::join(groups, ", ")));
        }
        of_groups[static_cast<std::size_t>(found - groups.begin())] = given.factor;
    }
    return of_groups;
}

Scene relit(Scene scene, const LightGroups& groups, std::span<const Rgb> factors) {
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        scene.lights[i].source = lights::scaled(scene.lights[i].source, factors[groups.of_light[i]]);
    return scene;
}

std::vector<std::string> names_for_dimming(const Scene& scene) {
    std::vector<std::string> names;
    for (const Light& light : scene.lights) {
        for (const std::string& name : {light.name, group_of(light)}) {
            if (std::ranges::find(names, name) == names.end()) names.push_back(name);
        }
    }
    return names;
}

std::vector<Rgb> factors_of_lights(const LightScene& state, const Scene& scene) {
    const std::vector<std::string> names = names_for_dimming(scene);
    for (const LightFactor& given : state.factors) {
        if (std::ranges::find(names, given.name) != names.end()) continue;
        const std::string question =
            did_you_mean(given.name, std::vector<std::string_view>(names.begin(), names.end()));
        throw InputError(fmt::format("there is no light or group of lights \"{}\".{} Allowed: {}.",
                                     given.name, question, fmt::join(names, ", ")));
    }
    std::vector<Rgb> factors;
    for (const Light& light : scene.lights)
        factors.push_back(dimming(light, state) * maintenance_ratio(light, state));
    return factors;
}

Scene lit(Scene scene, const LightScene& state) {
    const std::vector<Rgb> factors = factors_of_lights(state, scene);
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        Light& light = scene.lights[i];
        light.source = lights::scaled(light.source, factors[i]);
        if (light.power_w) *light.power_w *= dimming(light, state).luminance();
    }
    return scene;
}

}  // namespace stilb::scene
