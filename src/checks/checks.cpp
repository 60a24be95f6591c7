#include "checks/checks.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace stilb::checks {

std::vector<std::string> scene_warnings(const Scene& scene, const rays::RayCaster& caster,
                                        const Enclosures& enclosures, std::span<const Sensor> all_sensors,
                                        std::vector<std::string> of_reader) {
    std::vector<Sensor> sensors;  // that light arrives at
    std::ranges::copy_if(all_sensors, std::back_inserter(sensors),
                         [](const Sensor& sensor) { return !sensor.derived(); });
    std::vector<std::string> warnings = std::move(of_reader);
    const auto add = [&](const std::vector<std::string>& more) {
        warnings.insert(warnings.end(), more.begin(), more.end());
    };
    Explained explained(scene, sensors);
    add(unit_warnings(scene));
    add(opening_warnings(scene));
    add(precision_warnings(caster, sensors));
    add(hole_warnings(scene, enclosures.components()));
    add(overlap_warnings(scene, caster, sensors));
    add(lamp_warnings(scene, caster, enclosures.components(), sensors));
    add(placement_warnings(scene, caster, enclosures, sensors, explained));
    add(facing_warnings(scene, caster, sensors, explained));
    add(reach_warnings(scene, caster, sensors, explained));
    add(unlit_warnings(scene, caster));
    add(absorption_warnings(scene, caster));
    return warnings;
}

}  // namespace stilb::checks
