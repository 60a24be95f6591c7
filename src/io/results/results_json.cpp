#include "io/results/results_json.h"

#include "io/results/places.h"

namespace stilb::io {
namespace {

using Json = nlohmann::ordered_json;

Json interval_json(const statistics::Estimate& e) { return {e.lower, e.upper}; }

Json reading_json(const SensorResult& result, const Sensor& sensor, std::size_t j) {
    const Place place = sensor.place(j);
    Json json = place_json(place);
    if (sensor.measures_luminance()) {
        const auto hit = sub_point(result, sensor, j);
        json["hit"] = hit ? vector_json(*hit) : Json();
    }
    for (const Place::Angle& angle : place.angles) json[std::string(angle.name)] = angle.value_deg;
    const Reading& reading = result.readings[j];
    json["value"] = reading.estimate.value;
    json["standard_error"] = reading.estimate.standard_error;
    json["interval"] = interval_json(reading.estimate);
    json["rgb"] = reading.rgb.band;
    return json;
}

/// Uniformity is a property of an illuminated area: luminances in several directions have none.
Json summary_json(const statistics::GridSummary& summary, bool has_uniformity) {
    Json json{
        {"mean", summary.mean.value}, {"minimum", summary.minimum.value}, {"maximum", summary.maximum.value}};
    if (has_uniformity) json["uniformity"] = summary.uniformity.value;
    json["mean_interval"] = interval_json(summary.mean);
    json["minimum_interval"] = interval_json(summary.minimum);
    json["maximum_interval"] = interval_json(summary.maximum);
    if (has_uniformity) json["uniformity_interval"] = interval_json(summary.uniformity);
    return json;
}

Json sensor_json(const SensorResult& result, const Sensor& sensor) {
    const Quantity quantity = sensor.quantity();
    Json json{
        {"name", sensor.name}, {"type", sensor.type()}, {"quantity", quantity.name}, {"unit", quantity.unit}};
    if (const auto count = sensor.count()) json["count"] = *count;
    json["attained_error"] = result.attained_error;
    Json values = Json::array();
    for (std::size_t j = 0; j < result.readings.size(); ++j)
        values.push_back(reading_json(result, sensor, j));
    json["values"] = std::move(values);
    json["summary"] = summary_json(result.summary, !sensor.measures_luminance());
    return json;
}

Json light_json(const estimators::FirstShotLight& light) {
    return {{"name", light.name},
            {"replaced", light.is_replaced},
            {"samples", light.samples},
            {"reason", light.why}};
}

Json patches_json(const estimators::PatchReport& report) {
    Json lights = Json::array();
    for (const estimators::FirstShotLight& light : report.lights) lights.push_back(light_json(light));
    return {{"count", report.count},
            {"size_m", report.size_m},
            {"first_shot",
             {{"variant", name_of(report.first_shot)},
              {"resolution", report.resolution ? Json(*report.resolution) : Json()},
              {"missed", report.missed},
              {"bytes_per_patch", report.bytes_per_patch},
              {"lights", std::move(lights)}}}};
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
        case StopReason::solved:
            return "solved";
    }
    return "";
}

}  // namespace

std::string to_json(const RunResult& result, const std::string& scene) {
    Json json{{"stilb", STILB_VERSION},
              {"scene", scene},
              {"method", result.method},
              {"seed", result.seed},
              {"elapsed_s", result.elapsed_s},
              {"paths", result.samples},
              {"replicates", result.replicates},
              {"rays", result.rays},
              {"converged", result.converged},
              {"stopped", text_of(result.stop_reason)},
              {"attained_error", result.attained_error},
              {"warnings", result.warnings}};
    if (result.patches) {
        json["first_shot_set_up_s"] = result.patches->set_up_s;
        json["patches"] = patches_json(*result.patches);
    }
    for (const run::LevelOfDetail& level : result.levels_of_detail) {
        json["levels_of_detail"].push_back({{"object", level.object},
                                            {"degree", level.degree},
                                            {"full_degree", level.full_degree},
                                            {"error_m", level.error_m},
                                            {"allowed_m", level.allowed_m}});
    }
    Json list = Json::array();
    for (const SensorResult& sensor : result.sensors) list.push_back(sensor_json(sensor, sensor.sensor));
    json["sensors"] = std::move(list);
    return json.dump(1) + "\n";
}

}  // namespace stilb::io
