#include "files/results_json.h"

#include <nlohmann/json.hpp>

namespace stilb {
namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Vec3& v) { return {v.x, v.y, v.z}; }
Json interval_json(const Estimate& e) { return {e.lower, e.upper}; }

Json reading_json(const Reading& reading, const Measurand& measurand) {
    return {{"position", vector_json(position_of(measurand))},
            {"normal", vector_json(place_of(measurand).normal)},
            {"value", reading.estimate.value},
            {"standard_error", reading.estimate.standard_error},
            {"interval", interval_json(reading.estimate)},
            {"rgb", reading.rgb.band}};
}

Json summary_json(const GridSummary& summary) {
    return {{"mean", summary.mean.value},
            {"minimum", summary.minimum.value},
            {"maximum", summary.maximum.value},
            {"uniformity", summary.uniformity.value},
            {"mean_interval", interval_json(summary.mean)},
            {"minimum_interval", interval_json(summary.minimum)},
            {"maximum_interval", interval_json(summary.maximum)},
            {"uniformity_interval", interval_json(summary.uniformity)}};
}

Json sensor_json(const SensorResult& result, const Sensor& sensor) {
    const bool is_grid = sensor.type == SensorType::grid;
    Json json{
        {"name", sensor.name}, {"type", name_of(sensor.type)}, {"quantity", "illuminance"}, {"unit", "lx"}};
    if (is_grid) json["count"] = sensor.grid.count;
    json["attained_error"] = result.attained_error;
    Json values = Json::array();
    for (std::size_t j = 0; j < result.readings.size(); ++j) {
        values.push_back(reading_json(result.readings[j], sensor.measurands[j]));
    }
    json["values"] = std::move(values);
    json["summary"] = summary_json(result.summary);
    return json;
}

const char* text_of(StopReason reason) {
    switch (reason) {
        case StopReason::target_reached:
            return "target reached";
        case StopReason::paths_done:
            return "paths done";
        case StopReason::time_over:
            return "time over";
        case StopReason::interrupted:
            return "interrupted";
    }
    return "";
}

}  // namespace

std::string to_json(const RunResult& result, std::span<const Sensor> sensors, const std::string& scene) {
    Json json{{"stilb", STILB_VERSION},
              {"scene", scene},
              {"method", result.method},
              {"seed", result.seed},
              {"elapsed_s", result.elapsed_s},
              {"paths", result.paths},
              {"replicates", result.replicates},
              {"rays", result.rays},
              {"converged", result.converged},
              {"stopped", text_of(result.stop_reason)},
              {"attained_error", result.attained_error},
              {"warnings", result.warnings}};
    Json list = Json::array();
    for (std::size_t s = 0; s < sensors.size(); ++s)
        list.push_back(sensor_json(result.sensors[s], sensors[s]));
    json["sensors"] = std::move(list);
    return json.dump(1) + "\n";
}

}  // namespace stilb
