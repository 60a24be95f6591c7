// Groups of lights whose light is stored apart, so that it can be dimmed and coloured afterwards.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/rgb.h"
#include "scene/scene.h"

namespace stilb::scene {

/// Memory and time of solutions grow with the number of groups.
inline constexpr std::size_t kMostLightGroups = 32;
/// The group of all lights beyond that number.
inline constexpr std::string_view kOtherLights = "others";

struct LightGroups {
    std::vector<std::string> names;
    std::vector<std::uint32_t> of_light;  ///< as Scene::lights: the number of its group

    std::size_t count() const { return names.size(); }
};

/// Lights with the same `group` are one group; each other light is a group of its own name. Where there are
/// more than kMostLightGroups, the last one holds all further lights.
LightGroups light_groups(const Scene& scene);

/// A factor for the light of a light or of a group, band by band.
struct LightFactor {
    std::string name;
    Rgb factor = Rgb::grey(1);
};

/// The factor of each group; 1 where none is given. Names are those of groups, or of lights that are a group
/// of their own. Throws InputError where a name is neither, with the names that are allowed.
std::vector<Rgb> factors_of_groups(std::span<const LightFactor> factors, std::span<const std::string> groups);

/// The scene with the light of each group multiplied by its factor.
Scene relit(Scene scene, const LightGroups& groups, std::span<const Rgb> factors);

/// A state of the lamps in which the same scene is looked at, too.
struct LightScene {
    std::string name;
    std::vector<LightFactor>
        factors;                      ///< of lights or groups; that of a light comes before that of its group
    Rgb others = Rgb::grey(1);        ///< of lights without one
    std::optional<int> bounces = {};  ///< only light with so many reflections
    std::optional<double> maintenance = {};  ///< of all lamps, in place of their own
    /// Only these sensors are measured in it, and what is required of them counts for `--check`. Empty: all,
    /// and it does not count.
    std::vector<std::string> sensors = {};
};
/// Of all lights and groups, each once.
std::vector<std::string> names_for_dimming(const Scene& scene);
/// The factor of each of Scene::lights. Throws InputError where a name is that of no light and no group.
std::vector<Rgb> factors_of_lights(const LightScene& state, const Scene& scene);
/// The scene with its lamps in this state. Their power follows the luminance of their light, but not
/// maintenance.
Scene lit(Scene scene, const LightScene& state);

}  // namespace stilb::scene

namespace stilb {
using scene::LightFactor;
using scene::LightGroups;
using scene::LightScene;
}  // namespace stilb
