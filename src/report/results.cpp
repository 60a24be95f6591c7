#include "report/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/results/results_text.h"

namespace stilb::report {
namespace {

using enum Table::Column;

/// Lists of at most so many readings are among the single values.
constexpr std::size_t kMostListed = 40;
/// Sensors of more readings are not listed one by one.
constexpr std::size_t kMostReadings = 100'000;

std::string_view css_class_of(Verdict verdict) {
    return verdict == Verdict::pass ? "pass" : verdict == Verdict::fail ? "fail" : "unsure";
}

Html chip(Verdict verdict) {
    return element("span", {{"class", fmt::format("chip {}", css_class_of(verdict))}},
                   text(run::name_of(verdict)));
}

std::string estimate_text(const statistics::Estimate& estimate) {
    return std::isnan(estimate.value) ? "–" : io::with_error(estimate);
}

/// The decimals of an estimate as text.
std::size_t decimals_of(const statistics::Estimate& estimate) {
    const std::string words = estimate_text(estimate);
    const std::string value = words.substr(0, words.find(' '));
    const std::size_t point = value.find('.');
    return point == std::string::npos ? 0 : value.size() - point - 1;
}

std::string interval_text(const statistics::Estimate& estimate) {
    if (std::isnan(estimate.value)) return "–";
    return fmt::format("{0:.{2}f} to {1:.{2}f}", estimate.lower, estimate.upper, decimals_of(estimate));
}

std::string quantity_text(const Sensor& sensor) {
    const std::string unit = io::unit_of(sensor);
    return unit.empty() ? std::string(sensor.quantity().name)
                        : fmt::format("{} [{}]", sensor.quantity().name, unit);
}

bool has_single_values(const Sensor& sensor) {
    const bool is_raster =
        std::holds_alternative<Grid>(sensor.kind) || std::holds_alternative<Area>(sensor.kind);
    return !is_raster && sensor.size() <= kMostListed;
}

std::string place_text(const SensorResult& result, std::size_t j) {
    const Sensor& sensor = result.sensor;
    if (const Derived* derived = sensor.derived()) return derived->formula.text();
    const Location location = sensor.location(j);
    if (!location.angles.empty()) return io::angles_text(location);
    return io::location_text(location) + io::line_end_text(result, j);
}

std::string numbered(const SensorResult& result, std::size_t j) {
    return result.readings.size() == 1 ? result.sensor.name : fmt::format("{} {}", result.sensor.name, j + 1);
}

std::string readings_text(const SensorResult& result) {
    return fmt::format("{} {}", result.readings.size(), sensors::readings_of_type(result.sensor.type()).many);
}

Html statistics_table(const RunResult& result) {
    Table table({{"Sensor"},
                 {"Readings"},
                 {"Quantity"},
                 {"Mean", numbers},
                 {"Minimum", numbers},
                 {"Maximum", numbers},
                 {"Uniformity", numbers},
                 {"Diversity", numbers}});
    for (const SensorResult& sensor : result.sensors) {
        if (sensor.readings.size() <= 1) continue;
        std::vector<Html> cells{name_text(sensor.sensor.name), text(readings_text(sensor)),
                                text(quantity_text(sensor.sensor))};
        for (std::size_t i = 0; i < kStatisticNames.size(); ++i) {
            const auto statistic = static_cast<Statistic>(i);
            const bool is_defined = !is_ratio(statistic) || sensor.sensor.has_ratios();
            cells.push_back(text(is_defined ? estimate_text(sensor.summary[statistic]) : "–"));
        }
        table.add(cells);
    }
    if (table.is_empty()) return {};
    return table.html() +
           element("p", {{"class", "note"}},
                   text("Uniformity is minimum / mean (U0), diversity minimum / maximum (Ud)."));
}

Html values_table(const RunResult& result) {
    Table table({{"Sensor"}, {"Quantity"}, {"Value", numbers}, {"Where"}});
    for (const SensorResult& sensor : result.sensors) {
        if (!has_single_values(sensor.sensor)) continue;
        for (std::size_t j = 0; j < sensor.readings.size(); ++j) {
            table.add({name_text(numbered(sensor, j)), text(quantity_text(sensor.sensor)),
                       text(estimate_text(sensor.readings[j].estimate)), text(place_text(sensor, j))});
        }
    }
    return table.is_empty() ? Html{} : element("h3", "Single values") + table.html();
}

std::string remark_on(const run::GlareSource& source) {
    const std::string_view text = text_of(source.standing);
    return is_counted(source.standing) ? std::string(text) : fmt::format("{}: not counted", text);
}

/// The luminance with which a view's sources are compared.
std::string level_text(const run::GlareView& view) {
    return view.threshold_cd_m2
               ? fmt::format("; threshold of glare {:.3g} cd/m²", *view.threshold_cd_m2)
               : fmt::format("; background luminance {:.3g} cd/m²", view.background_cd_m2.value_or(0));
}

Html sources_table(const run::GlareView& view) {
    Table table({{"Luminaire"},
                 {"Luminance [cd/m²]", numbers},
                 {"Solid angle [sr]", numbers},
                 {"Position index", numbers},
                 {"Share of the glare", numbers}});
    const auto glare_of = [](const run::GlareSource& source) {
        return is_counted(source.standing)
                   ? source.luminance_cd_m2 * source.luminance_cd_m2 * source.solid_angle_sr /
                         (source.position_index * source.position_index)
                   : 0;
    };
    double all = 0;
    for (const run::GlareSource& source : view.sources) all += glare_of(source);
    for (const run::GlareSource& source : view.sources) {
        table.add({name_text(source.light) + element("small", remark_on(source)),
                   text(fmt::format("{:.0f}", source.luminance_cd_m2)),
                   text(fmt::format("{:.2g}", source.solid_angle_sr)),
                   text(fmt::format("{:.2f}", source.position_index)),
                   text(all > 0 ? io::percent(glare_of(source) / all) : "–")});
    }
    return table.is_empty() ? element("p", "The eye sees no luminaire.") : table.html();
}

/// The directions of readings in results; the points of rasters all have the same.
std::size_t count_directions(const Sensor& sensor, const Location& location) {
    const bool is_raster =
        std::holds_alternative<Grid>(sensor.kind) || std::holds_alternative<Area>(sensor.kind);
    return is_raster ? 0 : location.directions.size();
}

std::vector<Table::Heading> reading_headings(const Sensor& sensor) {
    std::vector<Table::Heading> headings{
        {"", numbers}, {"x [m]", numbers}, {"y [m]", numbers}, {"z [m]", numbers}};
    const Location location = sensor.location(0);
    for (std::size_t d = 0; d < count_directions(sensor, location); ++d)
        headings.push_back({std::string(location.directions[d].name), numbers});
    for (const Location::Angle& angle : location.angles)
        headings.push_back({fmt::format("{} [°]", angle.name), numbers});
    const std::string unit = io::unit_of(sensor);
    headings.push_back({unit.empty() ? "Value" : fmt::format("Value [{}]", unit), numbers});
    headings.push_back({"Standard error", numbers});
    headings.push_back({"95 % interval", numbers});
    return headings;
}

std::vector<Html> reading_cells(const SensorResult& result, std::size_t j) {
    const Location location = result.sensor.location(j);
    const statistics::Estimate& estimate = result.readings[j].estimate;
    std::vector<Html> cells{text(fmt::format("{}", j + 1))};
    for (std::size_t axis = 0; axis < 3; ++axis)
        cells.push_back(text(fmt::format("{:.3f}", location.position[axis])));
    for (std::size_t d = 0; d < count_directions(result.sensor, location); ++d)
        cells.push_back(text(io::direction_text(location.directions[d].value)));
    for (const Location::Angle& angle : location.angles)
        cells.push_back(text(fmt::format("{:g}", angle.value_deg)));
    cells.push_back(text(estimate_text(estimate)));
    cells.push_back(text(std::isnan(estimate.standard_error)
                             ? "–"
                             : fmt::format("{:.{}f}", estimate.standard_error, decimals_of(estimate))));
    cells.push_back(text(interval_text(estimate)));
    return cells;
}

Html readings_table(const SensorResult& result) {
    Table table(reading_headings(result.sensor), "readings");
    for (std::size_t j = 0; j < result.readings.size(); ++j) table.add(reading_cells(result, j));
    return table.html();
}

}  // namespace

Html requirements(const RunResult& result) {
    Table table({{"Sensor"}, {"Requirement"}, {"Value", numbers}, {"Verdict"}});
    for (const SensorResult& sensor : result.sensors) {
        for (const auto& [requirement, verdict, reason] : sensor.requirements) {
            const Statistic statistic = requirement.criterion->statistic;
            const statistics::Estimate& value = sensor.summary[statistic];
            table.add(
                {name_text(sensor.sensor.name), text(io::requirement_text(requirement, sensor.sensor)),
                 text(std::isnan(value.value) || is_ratio(statistic) ? estimate_text(value)
                                                                     : io::with_unit(value, sensor.sensor)),
                 chip(verdict) + element("small", reason)});
        }
    }
    return table.is_empty() ? Html{} : table.html();
}

Html measured_values(const RunResult& result) { return statistics_table(result) + values_table(result); }

Html shares(const RunResult& result) {
    Table table({{"Sensor"}, {"Of"}, {"Mean", Table::Column::numbers}, {"Share", Table::Column::numbers}});
    for (const SensorResult& sensor : result.sensors) {
        for (const run::Share& share : sensor.shares) {
            const double part = share.summary.mean.value / sensor.summary.mean.value;
            table.add({text(sensor.sensor.name), text(share.name),
                       text(io::with_unit(share.summary.mean, sensor.sensor)),
                       text(std::isfinite(part) ? io::percent(part) : "–")});
        }
    }
    return table.is_empty() ? Html{} : table.html();
}

Html light_scene(const RunResult& lit) {
    Html html;
    if (const std::string power = io::installed_power_text(lit); !power.empty())
        html += element("p", fmt::format("Power: {}", power));
    return html + requirements(lit) + measured_values(lit) + glare(lit);
}

Html glare(const RunResult& result) {
    Html html;
    for (const SensorResult& sensor : result.sensors) {
        for (std::size_t j = 0; j < sensor.glare.size(); ++j) {
            html += element("h3", fmt::format("{}: {} {}", numbered(sensor, j), sensor.sensor.quantity().name,
                                              estimate_text(sensor.readings[j].estimate))) +
                    element("p", place_text(sensor, j) + level_text(sensor.glare[j])) +
                    sources_table(sensor.glare[j]);
        }
    }
    if (html.is_empty()) return html;
    return html +
           element("p", {{"class", "note"}},
                   text("The luminances and solid angles are those of the parts of luminaires that the eye "
                        "sees, the position index is Guth's. The Unified Glare Rating (UGR) of CIE 117 "
                        "was made for sources of 0.0003 to 0.1 sr in the field of its table of position "
                        "indices: up to three times their distance ahead beside the line of sight, and "
                        "twice above or below it. The Daylight Glare Probability (DGP) also counts bright "
                        "places beside luminaires."));
}

Html all_readings(const RunResult& result) {
    Html html;
    for (const SensorResult& sensor : result.sensors) {
        if (sensor.sensor.derived()) continue;
        html += element("h3", fmt::format("{}: {}", sensor.sensor.name, quantity_text(sensor.sensor)));
        html +=
            sensor.readings.size() <= kMostReadings
                ? readings_table(sensor)
                : element("p", fmt::format("{} readings, which are too many to be listed here: stilb measure "
                                           "with -o FILE or --csv DIR writes all of them.",
                                           sensor.readings.size()));
    }
    return html;
}

}  // namespace stilb::report
