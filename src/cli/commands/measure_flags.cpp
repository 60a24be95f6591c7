#include "cli/commands/measure_flags.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/scene_argument.h"
#include "io/text/text.h"
#include "rays/ray_caster.h"
#include "sensors/areas/working_planes.h"
#include "stilb/error.h"

namespace stilb::cli {
namespace {

/// Seconds a reading that statistics and files take after the last sample. Two threads were measured.
constexpr double kFinishing_s = 3e-6;

/// The working planes that --grid describes.
struct GridRequest {
    sensors::WorkingPlaneOptions planes;
    std::optional<double> spacing_m;
};

double length_of(std::string_view key, std::string_view text, double least) {
    const auto number = io::parse_number(text);
    if (number && *number >= least && *number <= 1e6) return *number;
    throw InputError(fmt::format(
        "--grid: {}={} is no length in metres. Example: z=0.8,spacing=auto,margin=0.5.", key, text));
}

GridRequest grid_request(std::string_view text) {
    GridRequest request;
    while (!text.empty()) {
        const std::string_view part = text.substr(0, text.find(','));
        text.remove_prefix(std::min(text.size(), part.size() + 1));
        const std::size_t sign = std::min(part.find('='), part.size());
        const std::string_view key = part.substr(0, sign),
                               value = part.substr(std::min(sign + 1, part.size()));
        if (key == "z") {
            request.planes.height_m = length_of(key, value, 0);
        } else if (key == "margin") {
            request.planes.margin_m = length_of(key, value, 0);
        } else if (key == "spacing") {
            if (value != "auto") request.spacing_m = length_of(key, value, 1e-3);
        } else {
            throw InputError(
                fmt::format("--grid: there is no \"{}\". Allowed: z (height above the floor), spacing (or "
                            "auto) and margin "
                            "(distance from walls), such as z=0.8,spacing=auto,margin=0.5.",
                            part));
        }
    }
    return request;
}

}  // namespace

void MeasureFlags::add_planes(io::SceneFile& file, const std::string& path,
                              std::vector<std::string>& added) const {
    if (!grid) return;
    const GridRequest request = grid_request(*grid);
    const auto planes = working_planes(file.scene, rays::RayCaster(file.scene), request.planes);
    const auto on_planes = sensors_on(planes, "plane", request.spacing_m);
    if (on_planes.empty()) throw InputError("--grid: " + sensors::no_plane_message(request.planes), {path});
    for (const Sensor& sensor : on_planes) {
        if (sensors::find_sensor(file.sensors, sensor.name)) {
            throw InputError(
                fmt::format("--grid: the scene has a sensor \"{}\" already. Give that another name.",
                            sensor.name),
                {path});
        }
        added.push_back(sensor.name);
        file.sensors.push_back(sensor);
    }
}

void MeasureFlags::add_to(Command& command) {
    command.add("--sensor", sensors, "Measure only this sensor (may be repeated)")
        .value_name("NAME")
        .repeatable();
    command
        .add("--grid", grid,
             "Measure a working plane over the floor of each room, at this height above it, with this "
             "distance from walls: z=0.75,spacing=auto,margin=0.5, or parts of it. The sensor is called "
             "plane; those of several rooms plane_1, plane_2 and so on")
        .value_name("KEY=VALUE,...");
    command.add(
        "--check", checks,
        "Exit with code 1 where a requirement of a sensor (require = ...) is not met, with code 3 where "
        "it is not sure, else with 0");
    add_overrides(command, overrides);
    run.add_to(command);
}

RunOptions MeasureFlags::options_for(std::span<const Sensor> measured, const RunOptions& of_file,
                                     const std::string& scene) const {
    if (checks && !sensors::has_requirements(measured)) {
        throw InputError(
            "--check: no measured sensor has a key \"require\", such as require = { mean = 500 }.", {scene});
    }
    std::size_t readings = 0;
    for (const Sensor& sensor : measured) readings += sensor.size();
    return with_reserve(run.over(of_file), kFinishing_s * static_cast<double>(readings));
}

int MeasureFlags::exit_code_of(const RunResult& result, const RunOptions& options) const {
    if (!checks) return result.converged ? kExitDone : kExitStoppedEarly;
    std::vector<Verdict> verdicts{run::verdict_of(result).value_or(Verdict::undecided)};
    for (std::size_t s = 0; s < result.light_scenes.size(); ++s) {
        if (options.light_scenes[s].sensors.empty()) continue;
        if (const auto own = run::verdict_of(result.light_scenes[s])) verdicts.push_back(*own);
    }
    if (std::ranges::find(verdicts, Verdict::fail) != verdicts.end()) return kExitCheckFailed;
    const bool pass = std::ranges::all_of(verdicts, [](Verdict verdict) { return verdict == Verdict::pass; });
    return pass ? kExitDone : kExitStoppedEarly;
}

}  // namespace stilb::cli
