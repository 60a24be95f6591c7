#include "plot/grid_picture.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>

#include "base/error.h"

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

}  // namespace

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
                fmt::format("'{}' is in {} and '{}' in {} (one scale cannot hold both). Choose with "
                            "--sensor.",
                            first.name, first.unit, grid.name, grid.unit));
        }
        picture.panels.push_back({grid.name, subtitle_of(grid), grid.count[0], grid.count[1], grid.width_m,
                                  grid.height_m, grid.values});
    }
    return picture;
}

}  // namespace stilb::plot
