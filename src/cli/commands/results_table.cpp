#include "cli/commands/results_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "estimators/estimator_list.h"
#include "io/results/results_text.h"

namespace stilb::cli {

namespace {

/// The largest numbers of columns and rows of a grid whose values are printed one by one.
constexpr int kMostColumns = 20;
constexpr int kMostRows = 40;
/// The largest number of readings of a list that are printed one by one.
constexpr std::size_t kMostReadings = 40;

std::string reading_text(const SensorResult& result, const Sensor& sensor, std::size_t j) {
    const std::string value = io::with_unit(result.readings[j].estimate, sensor);
    if (const Derived* derived = sensor.derived())
        return fmt::format("{}   {}\n", value, derived->formula.text());
    const Location location = sensor.location(j);
    if (location.angles.empty())
        return fmt::format("{}   {}{}\n", value, io::location_text(location), io::line_end_text(result, j));
    return fmt::format("{}   {}\n", io::angles_text(location), value);
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
            text += fmt::format(" {:>{}}", io::fixed(value, decimals), width);
        }
        text += '\n';
    }
    return text;
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
        text += is_ratio(statistic) ? io::with_error(value) : io::with_unit(value, sensor);
    }
    return text + '\n';
}

/// "required: mean at least 500 lx: pass; ..."; empty where nothing is required.
std::string requirements_text(const SensorResult& result) {
    std::string text;
    for (const auto& [requirement, verdict, reason] : result.requirements) {
        text += fmt::format("{} {}: {}", text.empty() ? "    required:" : ";",
                            io::requirement_text(requirement, result.sensor), run::name_of(verdict));
        if (!reason.empty()) text += fmt::format(" ({})", reason);
    }
    return text.empty() ? text : text + '\n';
}

/// The lamps that a rating leaves out in a view or more, and why: "not counted: "a" and 2 more (outside of
/// the field of view)"; empty where there are none.
std::string glare_text(const SensorResult& result) {
    std::map<run::GlareStanding, std::set<std::string_view>> left_out;
    for (const run::GlareView& view : result.glare) {
        for (const run::GlareSource& source : view.sources) {
            if (!is_counted(source.standing)) left_out[source.standing].insert(source.light);
        }
    }
    std::string text;
    for (const auto& [standing, lights] : left_out) {
        const std::string more = lights.size() > 1 ? fmt::format(" and {} more", lights.size() - 1) : "";
        text += fmt::format("{} \"{}\"{} ({})", text.empty() ? "    not counted:" : ";", *lights.begin(),
                            more, text_of(standing));
    }
    return text.empty() ? text : text + '\n';
}

/// What each share gives, its mean where there are several readings: "    panel: 210.3 +- 0.4 lx (84 %),
/// ...".
std::string shares_text(const SensorResult& result) {
    std::string text;
    for (const run::Share& share : result.shares) {
        const double part = share.summary.mean.value / result.summary.mean.value;
        text += fmt::format("{} {} {}{}", text.empty() ? "    of this:" : ",", share.name,
                            io::with_unit(share.summary.mean, result.sensor),
                            std::isfinite(part) ? fmt::format(" ({})", io::percent(part)) : "");
    }
    return text.empty() ? text : text + '\n';
}

std::string sensor_table(const SensorResult& result) {
    const Sensor& sensor = result.sensor;
    const std::size_t readings = sensor.size();
    if (readings == 1 || sensor.derived())
        return fmt::format("{:12}  {}", sensor.name, reading_text(result, sensor, 0)) + shares_text(result) +
               glare_text(result) + requirements_text(result);
    std::string text = fmt::format("{:12}  {}", sensor.name, io::size_text(sensor));
    text += fmt::format("; 95 % of the readings within {}\n", io::percent(result.attained_error));
    text += summary_text(result.summary, sensor) + shares_text(result) + glare_text(result) +
            requirements_text(result);
    if (const auto count = sensor.count()) {
        const bool fits = (*count)[0] <= kMostColumns && (*count)[1] <= kMostRows;
        return fits ? text + grid_values(result, *count) : text;
    }
    if (readings > kMostReadings || std::holds_alternative<Area>(sensor.kind)) return text;
    for (std::size_t j = 0; j < readings; ++j) text += "    " + reading_text(result, sensor, j);
    return text;
}

/// The sensors in a state of the lamps, its requirements and power.
std::string light_scene_table(const RunResult& lit) {
    std::string text = fmt::format("\nLight scene {}\n", lit.scene_name);
    for (const SensorResult& sensor : lit.sensors) text += sensor_table(sensor);
    if (const std::string verdicts = io::verdicts_text(lit); !verdicts.empty())
        text += fmt::format("    Requirements: {}\n", verdicts);
    if (const std::string power = io::installed_power_text(lit); !power.empty())
        text += fmt::format("    Power: {}\n", power);
    return text;
}

std::string quantities_of(const std::vector<SensorResult>& sensors) {
    const auto has = [&](std::string_view unit) {
        return std::ranges::any_of(sensors, [&](const SensorResult& result) {
            return !result.sensor.derived() && result.sensor.quantity().unit == unit;
        });
    };
    std::vector<std::string_view> names;
    if (has(sensors::kIlluminance.unit)) names.push_back("illuminance");
    if (has(sensors::kLuminance.unit)) names.push_back("luminance");
    if (std::ranges::any_of(sensors, [](const auto& result) { return result.sensor.rates_glare(); }))
        names.push_back("glare ratings");
    if (names.empty()) return "derived values";
    std::string text(names.front());
    for (std::size_t i = 1; i < names.size(); ++i)
        text += fmt::format("{}{}", i + 1 < names.size() ? ", " : " and ", names[i]);
    return text;
}

std::string title_of(const RunResult& result) {
    std::string title = quantities_of(result.sensors);
    if (result.maintenance)
        return fmt::format("Maintained {} ({})", title, io::maintenance_text(*result.maintenance));
    title[0] = static_cast<char>(std::toupper(title[0]));
    return title;
}

std::string ending_with_error(const RunResult& result, std::string_view samples) {
    const std::string ended = io::ending(result.stop_reason, samples);
    const std::string attained = io::percent(result.attained_error);
    if (result.stop_reason == StopReason::target_reached) return fmt::format("{} ({})", ended, attained);
    return fmt::format("{}; error {}", ended, attained);
}

}  // namespace

std::string to_table(const RunResult& result) {
    std::string text = title_of(result) + ", with 95 % intervals\n\n";
    for (const SensorResult& sensor : result.sensors) text += sensor_table(sensor);
    for (const RunResult& lit : result.light_scenes) text += light_scene_table(lit);
    text += '\n' + end_of_table(result) + io::detail_text(result.levels_of_detail);
    return result.patches ? text + io::patch_text(*result.patches) : text;
}

std::string end_of_table(const RunResult& result) {
    const std::string_view samples = estimators::find_estimator(result.technique).samples;
    std::string text = fmt::format("{}, {} {} in {:.2f} s: {}\n", io::method_text(result), result.samples,
                                   samples, result.elapsed_s, ending_with_error(result, samples));
    if (const std::string verdicts = io::verdicts_text(result); !verdicts.empty())
        text += fmt::format("Requirements: {}\n", verdicts);
    if (const std::string power = io::installed_power_text(result); !power.empty())
        text += fmt::format("Installed power: {}\n", power);
    return text;
}

std::string maintenance_line(const RunSummary& result) {
    return result.maintenance ? fmt::format("maintained: {}\n", io::maintenance_text(*result.maintenance))
                              : "";
}

std::string shortfall_text(const RunSummary& result, std::string_view output) {
    std::string text;
    if (result.converged) return text;
    if (result.requested_error && !(result.attained_error <= *result.requested_error)) {
        text = fmt::format("The requested error of {:g} % is not reached: the error is {}.",
                           100 * *result.requested_error, io::percent(result.attained_error));
    }
    if (!output.empty()) text += fmt::format("{}{} has the result so far.", text.empty() ? "" : " ", output);
    return text.empty() ? text : text + '\n';
}

}  // namespace stilb::cli
