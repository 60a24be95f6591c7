#include "files/results_csv.h"

#include <fmt/format.h>

#include <functional>

#include "base/error.h"
#include "files/table.h"

namespace stilb {
namespace {

using Value = std::function<double(const MeasuringPoint&, const Reading&)>;

void write_sensor(const SensorResult& result, const Sensor& sensor, const std::filesystem::path& path) {
    const std::pair<const char*, Value> contents[] = {
        {"x_m", [](const auto& p, const auto&) { return p.position.x; }},
        {"y_m", [](const auto& p, const auto&) { return p.position.y; }},
        {"z_m", [](const auto& p, const auto&) { return p.position.z; }},
        {"normal_x", [](const auto& p, const auto&) { return p.normal.x; }},
        {"normal_y", [](const auto& p, const auto&) { return p.normal.y; }},
        {"normal_z", [](const auto& p, const auto&) { return p.normal.z; }},
        {"illuminance_lx", [](const auto&, const auto& r) { return r.estimate.value; }},
        {"standard_error_lx", [](const auto&, const auto& r) { return r.estimate.standard_error; }},
        {"interval_low_lx", [](const auto&, const auto& r) { return r.estimate.lower; }},
        {"interval_high_lx", [](const auto&, const auto& r) { return r.estimate.upper; }},
        {"red_lx", [](const auto&, const auto& r) { return r.rgb[0]; }},
        {"green_lx", [](const auto&, const auto& r) { return r.rgb[1]; }},
        {"blue_lx", [](const auto&, const auto& r) { return r.rgb[2]; }},
    };
    std::vector<Column> columns;
    for (const auto& [name, value] : contents) {
        std::vector<double> cells;
        for (std::size_t j = 0; j < result.readings.size(); ++j) {
            cells.push_back(value(place_of(sensor.measurands[j]), result.readings[j]));
        }
        columns.push_back({name, std::move(cells)});
    }
    write_csv(columns, path);
}

}  // namespace

void write_results_csv(const RunResult& result, std::span<const Sensor> sensors,
                       const std::filesystem::path& directory) {
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (error)
        throw InputError(fmt::format("the folder cannot be made: {}", error.message()), {directory.string()});
    for (std::size_t s = 0; s < sensors.size(); ++s) {
        write_sensor(result.sensors[s], sensors[s], directory / (sensors[s].name + ".csv"));
    }
}

}  // namespace stilb
