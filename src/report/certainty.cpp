// How sure a report is, in plain words.
#include <fmt/format.h>

#include <algorithm>

#include "io/results/results_text.h"
#include "report/results.h"

namespace stilb::report {
namespace {

/// Readings, and those of them that reach an error.
struct Count {
    std::size_t reached = 0, all = 0;
};

/// Ratings and derived values have no limit on their error.
Count count_readings(const RunResult& result, double error) {
    Count count;
    for (const SensorResult& sensor : result.sensors) {
        if (sensor.sensor.derived() || sensor.sensor.rates_glare()) continue;
        count.all += sensor.readings.size();
        const double dark = statistics::dark_level(std::span(&sensor.summary.mean, 1));
        count.reached += std::ranges::count_if(sensor.readings, [&](const Reading& reading) {
            return statistics::relative_half_width(reading.estimate, dark) <= error;
        });
    }
    return count;
}

constexpr std::string_view kMeaning =
    "The values are computed by random samples of light. Each has a 95 % interval, written ±: in 95 of 100 "
    "repetitions with other random numbers, such an interval contains the true value of the room as it is "
    "described here.";
constexpr std::string_view kLimits =
    "The intervals do not contain what differs between this description and the real room: reflectances, "
    "furniture, tolerances and ageing of luminaires.";

std::string reached_text(const RunResult& result, const RunOptions& options) {
    const std::string attained = io::percent(result.attained_error);
    if (!result.requested_error)
        return fmt::format(
            "No error was requested. 95 % of the readings of each sensor are within {} of their "
            "value.",
            attained);
    const double wanted = *result.requested_error;
    if (run::is_error_of_means(options)) {
        return fmt::format(
            "An error of {:g} % was requested for the mean and the minimum of each sensor; the largest is "
            "{}.",
            100 * wanted, attained);
    }
    const auto [reached, all] = count_readings(result, wanted);
    return fmt::format(
        "An error of {:g} % was requested for 95 % of the readings of each sensor: half of the interval's "
        "width, relative to the value, or to 1 % of the sensor's mean where the value is less. {} of {} "
        "readings reach it; 95 % are within {}.",
        100 * wanted, reached, all, attained);
}

std::string end_text(const RunResult& result) {
    return fmt::format("The calculation ended: {}{}.", io::ending(result.stop_reason, "samples"),
                       result.converged ? "" : ", before the requested error was reached");
}

std::string verdict_text(const RunResult& result) {
    const std::string verdicts = io::verdicts_text(result);
    if (verdicts.empty()) return "";
    return fmt::format(
        "Requirements: {}. A requirement passes or fails where the whole interval lies on one "
        "side of its limit, else it is not sure yet. It is not sure where something that the value leaves "
        "out "
        "could change the verdict.",
        verdicts);
}

}  // namespace

Html certainty(const RunResult& result, const RunOptions& options) {
    const std::string_view css_class = result.converged ? "" : "attention";
    Html html =
        element("p", kMeaning) + element("p", {{"class", std::string(css_class)}},
                                         text(reached_text(result, options) + " " + end_text(result)));
    if (const std::string verdicts = verdict_text(result); !verdicts.empty()) html += element("p", verdicts);
    return html + element("p", kLimits);
}

}  // namespace stilb::report
