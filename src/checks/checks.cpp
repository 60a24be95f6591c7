#include "checks/checks.h"

#include <fmt/format.h>

#include <utility>

namespace stilb::checks {

std::vector<std::string> scene_warnings(const Scene& scene, const rays::RayCaster& caster,
                                        const Enclosures& enclosures, std::span<const Sensor> sensors,
                                        std::vector<std::string> of_reader) {
    std::vector<std::string> warnings = std::move(of_reader);
    const auto add = [&](const std::vector<std::string>& more) {
        warnings.insert(warnings.end(), more.begin(), more.end());
    };
    add(hole_warnings(scene, enclosures.components()));
    add(overlap_warnings(scene, caster, enclosures));
    add(placement_warnings(scene, caster, sensors));
    for (const ObjectId object : unlit_objects(scene, caster)) {
        warnings.push_back(fmt::format("object \"{}\": no light reaches it.", scene.object(object).name));
    }
    return warnings;
}

}  // namespace stilb::checks
