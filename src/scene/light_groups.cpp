#include "scene/light_groups.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "stilb/error.h"

namespace stilb::scene {
namespace {

const std::string& group_of(const Light& light) { return light.group.empty() ? light.name : light.group; }

}  // namespace

LightGroups light_groups(const Scene& scene) {
    LightGroups groups;
    for (const Light& light : scene.lights) {
        const std::string& name = group_of(light);
        const auto known = std::ranges::find(groups.names, name);
        groups.of_light.push_back(static_cast<std::uint32_t>(known - groups.names.begin()));
        if (known == groups.names.end()) groups.names.push_back(name);
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

}  // namespace stilb::scene
