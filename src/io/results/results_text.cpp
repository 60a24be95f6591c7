#include "io/results/results_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stilb::io {
namespace {

/// Decimals for so many digits of a number that is not 0.
int decimals_after(double number, int digits) {
    return digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(number))));
}

/// Two digits of the error, but at most six decimals, or four digits of the value; of exact values three
/// digits at least.
int decimals_for(const statistics::Estimate& e) {
    const double error = half_width(e);
    if (error > 0 && std::isfinite(error)) {
        const int most = e.value == 0 ? 6 : std::max(6, decimals_after(e.value, 4));
        return std::clamp(decimals_after(error, 2), 0, most);
    }
    const int usual = std::abs(e.value) >= 1000 ? 1 : 2;
    return e.value == 0 ? usual : std::max(usual, decimals_after(e.value, 3));
}

std::string raster_text(const Area& area) {
    return fmt::format(" {:.3g} m x {:.3g} m apart{}", area.cell_m[0], area.cell_m[1],
                       left_out_text(area.left_out));
}

}  // namespace

std::string unit_of(const Sensor& sensor) {
    return sensor.measures_luminance() ? "cd/m²" : std::string(sensor.quantity().unit);
}

std::string with_error(const statistics::Estimate& estimate) {
    // Ratings of glare where there may be no background.
    if (std::isfinite(estimate.lower) && !std::isfinite(estimate.upper)) {
        return std::isnan(estimate.value)
                   ? fmt::format("above {:.1f}", estimate.lower)
                   : fmt::format("{:.1f} (above {:.1f})", estimate.value, estimate.lower);
    }
    if (std::isnan(estimate.value)) return "-";
    constexpr double tiny = 1e-4;  // of which six decimals say little
    const double largest = std::max(std::abs(estimate.value), half_width(estimate));
    if (largest > 0 && largest < tiny)
        return fmt::format("{:.3g} ± {:.2g}", estimate.value, half_width(estimate));
    const int decimals = decimals_for(estimate);
    const double error = half_width(estimate);
    // Only an exact value has no error.
    const bool vanishes = error > 0 && error < 0.5 * std::pow(10, -decimals);
    return fixed(estimate.value, decimals) + " ± " +
           (vanishes ? fmt::format("{:.1g}", error) : fmt::format("{:.{}f}", error, decimals));
}

std::string fixed(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    const bool is_minus_zero = text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos;
    return is_minus_zero ? text.substr(1) : text;
}

std::string with_unit(const statistics::Estimate& estimate, const Sensor& sensor) {
    const std::string unit = unit_of(sensor);
    return with_error(estimate) + (unit.empty() || std::isnan(estimate.value) ? "" : " " + unit);
}

std::string requirement_text(const Requirement& requirement, const Sensor& sensor) {
    const sensors::Criterion& criterion = *requirement.criterion;
    const std::string unit = is_ratio(criterion.statistic) ? "" : unit_of(sensor);
    return fmt::format("{} {} {:g}{}{}", criterion.key, name_of(criterion.limit), requirement.limit,
                       unit.empty() ? "" : " ", unit);
}

std::string verdicts_text(const RunResult& result) {
    std::string text;
    for (const Verdict verdict : {Verdict::pass, Verdict::fail, Verdict::undecided, Verdict::unsure}) {
        std::ptrdiff_t count = 0;
        for (const SensorResult& sensor : result.sensors)
            count += std::ranges::count(sensor.requirements, verdict, &RatedRequirement::verdict);
        if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, run::name_of(verdict));
    }
    return text;
}

std::string location_text(const Vec3& p) {
    // At map coordinates, five digits would be kilometres.
    const auto text = [](double x) {
        return std::abs(x) < 1e5 ? fmt::format("{:.5g}", x) : fmt::format("{:.2f}", x);
    };
    return fmt::format("({}, {}, {})", text(p.x), text(p.y), text(p.z));
}
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

std::string line_end_text(const SensorResult& result, std::size_t j) {
    if (result.sub_points.empty()) return "";
    const auto& hit = result.sub_points[j];
    return hit ? ", meets " + location_text(*hit) : ", leaves the scene";
}

std::string size_text(const Sensor& sensor) {
    if (const auto count = sensor.count()) return fmt::format("{} x {} grid", (*count)[0], (*count)[1]);
    std::string readings = fmt::format("{} {}", sensor.size(), sensors::readings_of_type(sensor.type()).many);
    if (const auto* area = std::get_if<Area>(&sensor.kind)) readings += raster_text(*area);
    const auto location = sensor.common_location();
    return location ? fmt::format("{} {}", readings, location_text(*location)) : readings;
}

std::string maintenance_text(const std::array<double, 2>& factors) {
    const auto [lowest, highest] = factors;
    return lowest == highest ? fmt::format("maintenance factor {:g}", lowest)
                             : fmt::format("maintenance factors {:g} to {:g}", lowest, highest);
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

std::string method_text(const RunSummary& run) {
    return run.technique == run.method ? run.method : fmt::format("{} ({})", run.method, run.technique);
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

std::string room_power_text(std::span<const run::RoomPower> rooms) {
    constexpr std::size_t most_rooms = 4;
    if (rooms.size() == 1)
        return fmt::format("; {:.3g} W/m² of the room's floor ({:.4g} m²)", rooms[0].w_m2(),
                           rooms[0].floor_m2);
    std::string text;
    for (const run::RoomPower& room : rooms.first(std::min(rooms.size(), most_rooms))) {
        text += fmt::format("{} {:.3g} W/m² ({:.4g} m²)", text.empty() ? "; of the floors of rooms" : ",",
                            room.w_m2(), room.floor_m2);
    }
    return rooms.size() > most_rooms ? fmt::format("{} and {} more", text, rooms.size() - most_rooms) : text;
}

std::string installed_power_text(const RunResult& result) {
    std::vector<Sensor> sensors;
    for (const SensorResult& sensor : result.sensors) sensors.push_back(sensor.sensor);
    if (!result.power.power_w && !(sensors::task_area_m2(sensors) > 0)) return "";
    std::string text = power_text(result.power.power_w, result.power.unknown) + room_power_text(result.rooms);
    if (const auto& density = result.power_density) {
        text += fmt::format("; {:.3g} W/m² of the task area ({:.4g} m²)", density->w_m2, density->area_m2);
        text += fmt::format(", {} W/m² per 100 lx", with_error(density->w_m2_per_100_lx));
    }
    return text;
}

}  // namespace stilb::io
