#include "plot/grid_picture.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>

#include "stilb/error.h"

namespace stilb::plot {
namespace {

std::string subtitle_of(const io::MeasuredGrid& grid) {
    std::string text;
    const auto add = [&](const char* name, double value, int decimals, const std::string& unit) {
        if (std::isnan(value)) return;
        text += fmt::format("{}{} {}{}", text.empty() ? "" : "   ", name, number_text(value, decimals), unit);
    };
    const io::MeasuredSummary& summary = grid.summary;
    add("mean", summary.mean, three_digit_decimals(summary.mean), " " + grid.unit);
    add("minimum", summary.minimum, three_digit_decimals(summary.minimum), " " + grid.unit);
    add("uniformity", summary.uniformity, 2, "");
    return text;
}

std::string capitalized(std::string text) {
    if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text;
}

io::MeasuredGrid measured_grid(const SensorResult& result, const Grid& of) {
    const Sensor& sensor = result.sensor;
    const Quantity quantity = sensor.quantity();
    io::MeasuredGrid grid;
    grid.name = sensor.name;
    grid.quantity = quantity.name;
    grid.unit = quantity.unit;
    grid.count = of.count;
    // As in files, which have no more than the middles of the cells.
    const auto [nu, nv] = grid.count;
    const double cell_u_m = nu > 1 ? length(of.edge_u) / nu : 0;
    const double cell_v_m = nv > 1 ? length(of.edge_v) / nv : 0;
    grid.width_m = nu * (nu > 1 ? cell_u_m : cell_v_m);
    grid.height_m = nv * (nv > 1 ? cell_v_m : cell_u_m);
    for (const Reading& reading : result.readings) grid.values.push_back(reading.estimate.value);
    const statistics::GridSummary& summary = result.summary;
    grid.summary = {summary.mean.value, summary.minimum.value, summary.maximum.value,
                    summary.uniformity.value};
    return grid;
}

}  // namespace

FalseColour picture_of(const RunResult& result, const std::string& scene) {
    io::ResultsFile results{scene, {}};
    for (const SensorResult& sensor : result.sensors) {
        if (const auto* grid = std::get_if<Grid>(&sensor.sensor.kind))
            results.grids.push_back(measured_grid(sensor, *grid));
    }
    return picture_of(results);
}

FalseColour picture_of(const io::ResultsFile& results) {
    if (results.grids.empty()) {
        throw InputError(
            "no grid among the results (only grids can be drawn). Measure a sensor of type \"grid\".");
    }
    const io::MeasuredGrid& first = results.grids.front();
    FalseColour picture{capitalized(first.quantity) + ", " + results.scene, first.unit, {}};
    for (const io::MeasuredGrid& grid : results.grids) {
        if (grid.unit != first.unit) {
            throw InputError(
                fmt::format("'{}' is in {} and '{}' in {} (one scale cannot hold both). Choose sensors of "
                            "one quantity.",
                            first.name, first.unit, grid.name, grid.unit));
        }
        picture.panels.push_back({grid.name, subtitle_of(grid), grid.count[0], grid.count[1], grid.width_m,
                                  grid.height_m, grid.values});
    }
    return picture;
}

}  // namespace stilb::plot
