#include "cli/results_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stilb {
namespace {

/// Columns and rows up to which a grid's values are printed one by one.
constexpr int kMostColumns = 20;
constexpr int kMostRows = 40;
/// Points of a list that are printed one by one.
constexpr std::size_t kMostPoints = 40;

double half_width(const Estimate& e) { return (e.upper - e.lower) / 2; }

/// Two digits of the error, at most six of the value.
int decimals_for(const Estimate& e) {
    const double error = half_width(e);
    if (!(error > 0) || !std::isfinite(error)) return std::abs(e.value) >= 1000 ? 1 : 2;
    return std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 6);
}

std::string place(const MeasuringPoint& point) {
    const auto [p, n] = point;
    return fmt::format("at ({:.5g}, {:.5g}, {:.5g}) facing ({:.3g}, {:.3g}, {:.3g})", p.x, p.y, p.z, n.x, n.y,
                       n.z);
}

std::string grid_values(const SensorResult& result, const std::array<int, 2>& count) {
    const auto columns = static_cast<std::size_t>(count[0]);
    std::string text;
    for (auto v = static_cast<std::size_t>(count[1]); v-- > 0;) {  // as on a plan: v upwards
        text += "   ";
        for (std::size_t u = 0; u < columns; ++u) {
            text += fmt::format(" {:5.0f}", result.readings[v * columns + u].estimate.value);
        }
        text += '\n';
    }
    return text;
}

std::string sensor_table(const SensorResult& result, const Sensor& sensor) {
    if (sensor.measurands.size() == 1) {
        return fmt::format("{:12}  {} lx   {}\n", sensor.name, with_error(result.readings[0].estimate),
                           place(place_of(sensor.measurands[0])));
    }
    const bool is_grid = sensor.type == SensorType::grid;
    const auto& count = sensor.grid.count;
    const std::string size = is_grid ? fmt::format("{} x {} grid", count[0], count[1])
                                     : fmt::format("{} points", sensor.measurands.size());
    const GridSummary& s = result.summary;
    std::string text = fmt::format(
        "{:12}  {}; 95 % of the readings within {:.2g} %\n"
        "    mean {} lx   minimum {} lx   maximum {} lx   uniformity {}\n",
        sensor.name, size, 100 * result.attained_error, with_error(s.mean), with_error(s.minimum),
        with_error(s.maximum), std::isnan(s.uniformity.value) ? "-" : with_error(s.uniformity));
    if (is_grid && count[0] <= kMostColumns && count[1] <= kMostRows)
        return text + grid_values(result, count);
    if (!is_grid && sensor.measurands.size() <= kMostPoints) {
        for (std::size_t j = 0; j < sensor.measurands.size(); ++j) {
            text += fmt::format("    {} lx   {}\n", with_error(result.readings[j].estimate),
                                place(place_of(sensor.measurands[j])));
        }
    }
    return text;
}

std::string ending(const RunResult& result) {
    const std::string attained = fmt::format("{:.2g} %", 100 * result.attained_error);
    switch (result.stop_reason) {
        case StopReason::target_reached:
            return fmt::format("the error asked for is reached ({})", attained);
        case StopReason::paths_done:
            return fmt::format("all paths done; error {}", attained);
        case StopReason::time_over:
            return fmt::format("the time is over; error {}", attained);
        case StopReason::interrupted:
            return fmt::format("interrupted; error {}", attained);
    }
    return "";
}

}  // namespace

std::string with_error(const Estimate& estimate) {
    const int decimals = decimals_for(estimate);
    return fmt::format("{:.{}f} ± {:.{}f}", estimate.value, decimals, half_width(estimate), decimals);
}

std::string to_table(const RunResult& result, std::span<const Sensor> sensors) {
    std::string text = "Illuminance, with 95 % intervals\n\n";
    for (std::size_t s = 0; s < sensors.size(); ++s) text += sensor_table(result.sensors[s], sensors[s]);
    return text + fmt::format("\n{}, {} paths in {:.2f} s: {}\n", result.method, result.paths,
                              result.elapsed_s, ending(result));
}

}  // namespace stilb
