// The data of a walk: the scene once, its light as often as it is refined, and both in one page.
//
// docs/walk.md describes the two containers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/monitor.h"
#include "estimators/patch_light/solution/patch_solution.h"
#include "rays/ray_caster.h"
#include "scene/scene.h"
#include "sensors/sensor.h"
#include "walk/page.h"

namespace stilb::walk {

/// What a page says of its scene.
struct WalkScene {
    std::string name;
    std::string file;             ///< without its folder
    std::vector<Sensor> sensors;  ///< cameras and others: places to jump to
};

/// The state of the light at a time.
struct LightState {
    int version = 1;
    std::uint64_t steps = 0;
    double error = 0;  ///< as RunSummary::attained_error
    double elapsed_s = 0;
    bool done = false;
};

/// The container "scene". The solution needs no light yet. Throws InputError where there
/// are too many patches, Cancelled as the monitor says.
std::string scene_data(const Scene& scene, const rays::RayCaster& caster,
                       const estimators::PatchSolution& solution, const WalkScene& walk,
                       const Monitor& monitor = Monitor::none());

/// The container "light".
std::string light_data(const estimators::PatchSolution& solution, const LightState& state);

/// A page that needs no server and no network: script, style and both containers, compressed, are part of the
/// HTML.
std::string self_contained_page(std::string_view scene, std::string_view light, const PageFiles& files);

}  // namespace stilb::walk
