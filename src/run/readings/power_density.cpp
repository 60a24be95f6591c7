#include "run/readings/power_density.h"

#include <algorithm>
#include <limits>

#include "sensors/areas/rooms.h"
#include "statistics/combination.h"

namespace stilb::run {

std::optional<PowerDensity> power_density(const scene::InstalledPower& power, std::span<const Sensor> sensors,
                                          std::span<const SensorEstimates> estimates, double confidence) {
    const double area_m2 = sensors::task_area_m2(sensors);
    if (!power.power_w || !(area_m2 > 0)) return std::nullopt;
    std::vector<statistics::Quantity> means;
    std::vector<double> areas_m2;
    double incident_lm = 0;
    for (std::size_t s = 0; s < sensors.size(); ++s) {
        const double own_m2 = sensors::task_area_m2({&sensors[s], 1});
        if (!(own_m2 > 0)) continue;
        const SensorEstimates& from = estimates[s];
        means.push_back(
            {from.summary.mean,
             statistics::residuals_of({from.readings.replicate_means, sensors[s].size()}, Statistic::mean)});
        areas_m2.push_back(own_m2);
        incident_lm += own_m2 * from.summary.mean.value;
    }
    // P / A over E / 100 lx, where A E is the sum of the areas' fluxes.
    const double value = 100 * *power.power_w / incident_lm;
    std::vector<double> slopes;
    for (const double own_m2 : areas_m2) slopes.push_back(-value * own_m2 / incident_lm);
    PowerDensity density{area_m2, *power.power_w / area_m2, {}};
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    density.w_m2_per_100_lx = incident_lm > 0 ? statistics::combine(value, slopes, means, confidence).estimate
                                              : statistics::Estimate{none, none, none, none};
    return density;
}

std::vector<RoomPower> power_of_rooms(const Scene& scene, const rays::RayCaster& caster) {
    // Recessed lamps are a little above the ceiling.
    constexpr double kRecess_m = 0.2;
    if (!scene::installed_power(scene).power_w) return {};
    const std::vector<sensors::Room> rooms = sensors::find_rooms(scene, caster);
    std::vector<RoomPower> all(rooms.size());
    for (const Light& light : scene.lights) {
        const auto place = scene::place_of(scene, light);
        if (!place) continue;
        const sensors::Room* room = room_at(rooms, *place);
        if (!room) room = room_at(rooms, *place - Vec3{0, 0, kRecess_m});
        if (!room) continue;
        RoomPower& own = all[static_cast<std::size_t>(room - rooms.data())];
        own.power_w += light.power_w.value_or(0);
        own.unknown += light.power_w ? 0 : 1;
    }
    for (std::size_t i = 0; i < rooms.size(); ++i) {
        all[i].extent = rooms[i].extent();
        all[i].floor_m2 = rooms[i].area_m2();
    }
    std::erase_if(all, [](const RoomPower& room) { return !(room.power_w > 0); });
    return all;
}

}  // namespace stilb::run
