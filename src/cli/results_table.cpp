
#include "cli/results_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "estimators/estimator_list.h"

namespace stilb::cli {

namespace {

/// The largest numbers of columns and rows of a grid whose values are printed one by one.
constexpr int kMostColumns = 20;
constexpr int kMostRows = 40;
/// The largest number of readings of a list that are printed one by one.
constexpr std::size_t kMostReadings = 40;

double half_width(const statistics::Estimate& e) { return (e.upper - e.lower) / 2; }

/// Two digits of the error, and at most six of the value.
int decimals_for(const statistics::Estimate& e) {
    const double error = half_width(e);
    if (!(error > 0) || !std::isfinite(error)) return std::abs(e.value) >= 1000 ? 1 : 2;
    return std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 6);
}

std::string unit_of(const Sensor& sensor) {
    return sensor.measures_luminance() ? "cd/m²" : std::string(sensor.quantity().unit);
}

/// The end of a line of sight; empty where it is not known.
std::string end_text(const SensorResult& result, std::size_t j) {
    if (result.sub_points.empty()) return "";
    const auto& hit = result.sub_points[j];
    return hit ? ", meets " + location_text(*hit) : ", leaves the scene";
}

/// With a space before the unit, if there is one.
std::string with_unit(const statistics::Estimate& estimate, const Sensor& sensor) {
    const std::string unit = unit_of(sensor);
    return with_error(estimate) + (unit.empty() || std::isnan(estimate.value) ? "" : " " + unit);
}

std::string reading_text(const SensorResult& result, const Sensor& sensor, std::size_t j) {
    const std::string value = with_unit(result.readings[j].estimate, sensor);
    if (const Derived* derived = sensor.derived())
        return fmt::format("{}   {}\n", value, derived->formula.text());
    const Location location = sensor.location(j);
    if (location.angles.empty())
        return fmt::format("{}   {}{}\n", value, location_text(location), end_text(result, j));
    return fmt::format("{}   {}\n", angles_text(location), value);
}

/// Decimals for all values of a grid: three digits of its largest value, but none beyond the first digit of
/// that value's error.
int grid_decimals(const statistics::Estimate& largest) {
    const auto decimals_after = [](double number, int digits) {
        return digits - 1 - static_cast<int>(std::floor(std::log10(number)));
    };
    if (!(largest.value > 0) || !std::isfinite(largest.value)) return 0;
    const int of_value = decimals_after(largest.value, 3);
    const double error = half_width(largest);
    const bool has_error = error > 0 && std::isfinite(error);
    return std::clamp(has_error ? std::min(of_value, decimals_after(error, 1)) : of_value, 0, 6);
}

std::string grid_values(const SensorResult& result, const std::array<int, 2>& count) {
    const auto columns = static_cast<std::size_t>(count[0]);
    const statistics::Estimate& largest = result.summary.maximum;
    const int decimals = grid_decimals(largest);
    const std::size_t width =
        std::max<std::size_t>(5, fmt::formatted_size("{:.{}f}", largest.value, decimals));
    std::string text;
    for (auto v = static_cast<std::size_t>(count[1]); v-- > 0;) {  // v points upwards, as on a plan
        text += "   ";
        for (std::size_t u = 0; u < columns; ++u) {
            const double value = result.readings[v * columns + u].estimate.value;
            text += fmt::format(" {:{}.{}f}", value, width, decimals);
        }
        text += '\n';
    }
    return text;
}

std::string raster_text(const Area& area) {
    return fmt::format(" {:.3g} m x {:.3g} m apart{}", area.cell_m[0], area.cell_m[1],
                       left_out_text(area.left_out));
}

std::string size_text(const Sensor& sensor) {
    if (const auto count = sensor.count()) return fmt::format("{} x {} grid", (*count)[0], (*count)[1]);
    std::string readings = fmt::format("{} {}", sensor.size(), sensors::readings_of_type(sensor.type()).many);
    if (const auto* area = std::get_if<Area>(&sensor.kind)) readings += raster_text(*area);
    const auto location = sensor.common_location();
    return location ? fmt::format("{} {}", readings, location_text(*location)) : readings;
}

/// Diversity is shown of areas, and where something is required of it.
bool is_shown(Statistic statistic, const Sensor& sensor) {
    if (statistic != Statistic::diversity) return !is_ratio(statistic) || sensor.has_ratios();
    return std::holds_alternative<Area>(sensor.kind) ||
           std::ranges::any_of(sensor.requirements, [](const Requirement& requirement) {
               return requirement.criterion->statistic == Statistic::diversity;
           });
}

std::string summary_text(const statistics::GridSummary& summary, const Sensor& sensor) {
    std::string text;
    for (std::size_t i = 0; i < kStatisticNames.size(); ++i) {
        const auto statistic = static_cast<Statistic>(i);
        if (!is_shown(statistic, sensor)) continue;
        const statistics::Estimate& value = summary[statistic];
        text += fmt::format("{} {} ", text.empty() ? "   " : "  ", name_of(statistic));
        text += is_ratio(statistic) ? with_error(value) : with_unit(value, sensor);
    }
    return text + '\n';
}

/// "required: mean at least 500 lx: pass; ..."; empty where nothing is required.
std::string requirements_text(const SensorResult& result) {
    std::string text;
    for (const auto& [requirement, verdict] : result.requirements) {
        const sensors::Criterion& criterion = *requirement.criterion;
        const std::string unit = is_ratio(criterion.statistic) ? "" : unit_of(result.sensor);
        text += fmt::format("{} {} {} {:g}{}{}: {}", text.empty() ? "    required:" : ";", criterion.key,
                            name_of(criterion.limit), requirement.limit, unit.empty() ? "" : " ", unit,
                            run::name_of(verdict));
    }
    return text.empty() ? text : text + '\n';
}

std::string sensor_table(const SensorResult& result) {
    const Sensor& sensor = result.sensor;
    const std::size_t readings = sensor.size();
    if (readings == 1 || sensor.derived())
        return fmt::format("{:12}  {}", sensor.name, reading_text(result, sensor, 0)) +
               requirements_text(result);
    std::string text = fmt::format("{:12}  {}", sensor.name, size_text(sensor));
    text += fmt::format("; 95 % of the readings within {}\n", percent(result.attained_error));
    text += summary_text(result.summary, sensor) + requirements_text(result);
    if (const auto count = sensor.count()) {
        const bool fits = (*count)[0] <= kMostColumns && (*count)[1] <= kMostRows;
        return fits ? text + grid_values(result, *count) : text;
    }
    if (readings > kMostReadings || std::holds_alternative<Area>(sensor.kind)) return text;
    for (std::size_t j = 0; j < readings; ++j) text += "    " + reading_text(result, sensor, j);
    return text;
}

std::string quantities_of(const std::vector<SensorResult>& sensors) {
    const auto has = [&](std::string_view unit) {
        return std::ranges::any_of(sensors, [&](const SensorResult& result) {
            return !result.sensor.derived() && result.sensor.quantity().unit == unit;
        });
    };
    if (std::ranges::all_of(sensors, [](const auto& result) { return result.sensor.rates_glare(); }))
        return "glare ratings";
    if (!has(sensors::kLuminance.unit)) return "illuminance";
    return has(sensors::kIlluminance.unit) ? "illuminance and luminance" : "luminance";
}

std::string title_of(const RunResult& result) {
    std::string title = quantities_of(result.sensors);
    if (result.maintenance)
        return fmt::format("Maintained {} ({})", title, maintenance_text(*result.maintenance));
    title[0] = static_cast<char>(std::toupper(title[0]));
    return title;
}

std::string ending_with_error(const RunResult& result, std::string_view samples) {
    const std::string ended = ending(result.stop_reason, samples);
    const std::string attained = percent(result.attained_error);
    if (result.stop_reason == StopReason::target_reached) return fmt::format("{} ({})", ended, attained);
    return fmt::format("{}; error {}", ended, attained);
}

/// "Requirements: 2 pass, 1 not sure yet"; empty where there are none.
std::string verdicts_text(const RunResult& result) {
    std::string text;
    for (const Verdict verdict : {Verdict::pass, Verdict::fail, Verdict::undecided}) {
        std::size_t count = 0;
        for (const SensorResult& sensor : result.sensors)
            count += std::ranges::count(sensor.requirements, verdict, &RatedRequirement::verdict);
        if (count > 0)
            text +=
                fmt::format("{} {} {}", text.empty() ? "Requirements:" : ",", count, run::name_of(verdict));
    }
    return text.empty() ? text : text + '\n';
}

/// Where power is known, or asked for by a task area.
std::string power_line(const RunResult& result) {
    std::vector<Sensor> sensors;
    for (const SensorResult& sensor : result.sensors) sensors.push_back(sensor.sensor);
    if (!result.power.power_w && !(sensors::task_area_m2(sensors) > 0)) return "";
    std::string text = "Installed power: " + power_text(result.power.power_w, result.power.unknown);
    if (const auto& density = result.power_density) {
        text += fmt::format("; {:.3g} W/m² of the task area ({:.4g} m²)", density->w_m2, density->area_m2);
        text += fmt::format(", {} W/m² per 100 lx", with_error(density->w_m2_per_100_lx));
    }
    return text + '\n';
}

}  // namespace

std::string with_error(const statistics::Estimate& estimate) {
    // Ratings of glare where there may be no background.
    if (std::isfinite(estimate.lower) && !std::isfinite(estimate.upper)) {
        return std::isnan(estimate.value)
                   ? fmt::format("above {:.1f}", estimate.lower)
                   : fmt::format("{:.1f} (above {:.1f})", estimate.value, estimate.lower);
    }
    if (std::isnan(estimate.value)) return "-";
    const int decimals = decimals_for(estimate);
    return fmt::format("{:.{}f} ± {:.{}f}", estimate.value, decimals, half_width(estimate), decimals);
}

std::string to_table(const RunResult& result) {
    std::string text = title_of(result) + ", with 95 % intervals\n\n";
    for (const SensorResult& sensor : result.sensors) text += sensor_table(sensor);
    const std::string_view samples = estimators::find_estimator(result.method).samples;
    text += fmt::format("\n{}, {} {} in {:.2f} s: {}\n", result.method, result.samples, samples,
                        result.elapsed_s, ending_with_error(result, samples));
    text += verdicts_text(result) + power_line(result) + detail_text(result.levels_of_detail);
    return result.patches ? text + patch_text(*result.patches) : text;
}

std::string location_text(const Vec3& p) { return fmt::format("({:.5g}, {:.5g}, {:.5g})", p.x, p.y, p.z); }
std::string direction_text(const Vec3& d) { return fmt::format("({:.3g}, {:.3g}, {:.3g})", d.x, d.y, d.z); }

std::string location_text(const Location& location) {
    std::string text = fmt::format("{} {}", location.preposition, location_text(location.position));
    for (const Location::Direction& direction : location.directions) {
        if (!direction.preposition.empty())
            text += fmt::format(" {} {}", direction.preposition, direction_text(direction.value));
    }
    return text;
}

std::string angles_text(const Location& location) {
    std::string text;
    for (const Location::Angle& angle : location.angles)
        text += fmt::format("{}{} {:5.5g}°", text.empty() ? "" : "  ", angle.name, angle.value_deg);
    return text;
}

std::string maintenance_text(const std::array<double, 2>& factors) {
    const auto [lowest, highest] = factors;
    return lowest == highest ? fmt::format("maintenance factor {:g}", lowest)
                             : fmt::format("maintenance factors {:g} to {:g}", lowest, highest);
}

std::string maintenance_line(const RunSummary& result) {
    return result.maintenance ? fmt::format("maintained: {}\n", maintenance_text(*result.maintenance)) : "";
}

std::string power_text(std::optional<double> installed_w, std::span<const std::string> unknown) {
    if (!installed_w) return "not known: no lamp and no luminaire file states it";
    if (unknown.empty()) return fmt::format("{:.4g} W", *installed_w);
    constexpr std::size_t most_names = 3;
    const auto named = unknown.first(std::min(unknown.size(), most_names));
    const std::string more =
        unknown.size() > most_names ? fmt::format(" and {} more", unknown.size() - most_names) : "";
    return fmt::format("{:.4g} W, without lamps of unknown power: {}{}", *installed_w, fmt::join(named, ", "),
                       more);
}

std::string left_out_text(std::size_t points) {
    if (points == 0) return "";
    return fmt::format(" ({} hidden {} left out)", points, points == 1 ? "one" : "ones");
}

std::string detail_text(std::span<const run::LevelOfDetail> levels) {
    std::string text;
    for (const run::LevelOfDetail& level : levels) {
        if (level.degree == level.full_degree) {
            text += fmt::format(
                "{}: all {} degrees; with fewer the surface would deviate by more than {:.2g} mm\n",
                level.object, level.full_degree, 1e3 * level.allowed_m);
        } else {
            text += fmt::format(
                "{}: degree {} of {}, within {:.2g} mm of the full series ({:.2g} mm allowed)\n",
                level.object, level.degree, level.full_degree, 1e3 * level.error_m, 1e3 * level.allowed_m);
        }
    }
    return text;
}

std::string ending(StopReason reason, std::string_view all) {
    switch (reason) {
        case StopReason::target_reached:
            return "the requested error is reached";
        case StopReason::requirements_decided:
            return "all requirements are decided";
        case StopReason::paths_done:
            return fmt::format("all {} done", all);
        case StopReason::time_over:
            return "time limit reached";
        case StopReason::interrupted:
            return "interrupted";
        case StopReason::patches_too_coarse:
            break;
    }
    return "the patches are too coarse for the requested error";
}

std::string percent(double share) {
    const double in_percent = 100 * share;
    return std::abs(in_percent) < 99.5 ? fmt::format("{:.2g} %", in_percent)
                                       : fmt::format("{:.0f} %", in_percent);
}

std::string shortfall_text(const RunSummary& result, std::string_view output) {
    std::string text;
    if (result.converged) return text;
    if (result.requested_error && !(result.attained_error <= *result.requested_error)) {
        text = fmt::format("The requested error of {:g} % is not reached: the error is {}.",
                           100 * *result.requested_error, percent(result.attained_error));
    }
    if (!output.empty()) text += fmt::format("{}{} has the result so far.", text.empty() ? "" : " ", output);
    return text.empty() ? text : text + '\n';
}

namespace {

/// The largest number of lights that are listed as not replaced.
constexpr std::size_t kMostNames = 3;

std::string first_shot_text(const estimators::PatchReport& report) {
    if (report.first_shot == estimators::FirstShotVariant::none) return "no first shot";
    const auto replaced = std::ranges::count_if(report.lights, &estimators::FirstShotLight::is_replaced);
    const std::string resolution =
        report.resolution ? fmt::format(", resolution {}", *report.resolution) : "";
    return fmt::format("first shot ({}{}) for {} of {} lights, {:.2g} s, {:.0f} bytes per patch",
                       name_of(report.first_shot), resolution, replaced, report.lights.size(),
                       report.set_up_s, report.bytes_per_patch);
}

std::string left_lights(const estimators::PatchReport& report) {
    if (report.first_shot == estimators::FirstShotVariant::none) return "";
    std::string text;
    std::size_t left = 0;
    for (const estimators::FirstShotLight& light : report.lights) {
        if (light.is_replaced || ++left > kMostNames) continue;
        text += fmt::format("{}{} ({})", left > 1 ? ", " : "lights not replaced: ", light.name, light.why);
    }
    if (left > kMostNames) text += fmt::format(" and {} more", left - kMostNames);
    return text.empty() ? text : text + '\n';
}

}  // namespace

std::string patch_text(const estimators::PatchReport& report) {
    return fmt::format("{} patches of {:.2g} m; {}\n", report.count, report.size_m, first_shot_text(report)) +
           left_lights(report);
}

}  // namespace stilb::cli
