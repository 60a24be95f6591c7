#include "checks/checks.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace stilb::checks {

std::vector<Warning> scene_warnings(const Scene& scene, const rays::RayCaster& caster,
                                    const Enclosures& enclosures, std::span<const Sensor> all_sensors,
                                    std::vector<Warning> of_reader) {
    std::vector<Sensor> sensors;  // that light arrives at
    std::ranges::copy_if(all_sensors, std::back_inserter(sensors),
                         [](const Sensor& sensor) { return !sensor.derived(); });
    std::vector<Warning> warnings = std::move(of_reader);
    const auto add = [&](WarningKind kind, std::vector<std::string> more) {
        add_warnings(kind, std::move(more), warnings);
    };
    Explained explained(scene, sensors);
    const SceneFindings& findings = enclosures.findings();
    add(WarningKind::units, findings.units);
    add(WarningKind::openings, opening_warnings(scene));
    add(WarningKind::precision, precision_warnings(caster, sensors));
    add(WarningKind::holes, findings.holes);
    add(WarningKind::overlaps, overlap_warnings(scene, caster, findings.overlaps, sensors));
    add(WarningKind::lamps, lamp_warnings(scene, caster, findings.components, sensors));
    add(WarningKind::placement, placement_warnings(scene, caster, enclosures, sensors, explained));
    add(WarningKind::facing, facing_warnings(scene, caster, sensors, explained));
    add(WarningKind::reach, reach_warnings(scene, caster, sensors, explained));
    add(WarningKind::unlit, unlit_warnings(scene, caster));
    add(WarningKind::absorption, absorption_warnings(scene, caster));
    return warnings;
}

}  // namespace stilb::checks
