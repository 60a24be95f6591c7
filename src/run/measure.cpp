#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "estimators/estimator_list.h"
#include "run/campaign.h"
#include "run/level_of_detail.h"
#include "run/run.h"
#include "stilb/error.h"
#include "transport/line_of_sight.h"
#include "transport/sharp_light.h"

namespace stilb::run {
namespace {

constexpr double kConfidence = 0.95;
/// Samples that a run makes for the sake of sharp light before its first error estimate: some seconds of
/// work.
constexpr std::uint64_t kMostAwaited = 1 << 20;
enum ReadingPurpose : std::uint64_t { kReadingPreparation, kReadingReplicates };

void require_measurable(std::span<const Sensor> sensors, const estimators::EstimatorEntry& method) {
    for (const Sensor& sensor : sensors) {
        if (sensor.measures_luminance() && !method.measures_luminance) {
            throw InputError(fmt::format("sensor \"{}\": method {} measures illuminance only. Luminance: {}.",
                                         sensor.name, method.name,
                                         fmt::join(estimators::luminance_methods(), ", ")));
        }
    }
}

/// Refuses goniometers that are on no surface.
void require_surfaces(std::span<const Sensor> sensors, const rays::RayCaster& caster) {
    for (const Sensor& sensor : sensors) {
        for (const Measurand& measurand : sensor.measurands()) {
            const auto* ray = std::get_if<EmergentRay>(&measurand);
            if (!ray || transport::first_surface(measurand, caster)) continue;
            const Vec3& p = ray->position;
            throw InputError(fmt::format(
                "sensor \"{}\": its point ({}, {}, {}) is not on a surface. A goniometer needs a point on a "
                "surface, and a normal that points away from it.",
                sensor.name, p.x, p.y, p.z));
        }
    }
}

/// The options with defaults for a run without targets.
RunOptions with_reading_target(RunOptions options) {
    if (!options.error && !options.time_s && !options.paths) {
        options.error = 0.01;
        options.time_s = 60;
    }
    return options;
}

/// Widens the summary by the patches' error.
void include_patch_error(const statistics::BiasBounds& bias, SensorResult& result) {
    result.patch_error = bias.relative;
    for (std::size_t j = 0; j < result.readings.size(); ++j)
        result.readings[j].patch_error = bias.of_readings[j];
    const auto [least, most] = std::ranges::minmax_element(
        result.readings, {}, [](const Reading& reading) { return reading.estimate.value; });
    statistics::GridSummary& summary = result.summary;
    // That of the minimum and that of the mean, in units of the mean.
    const double of_quotient = *least->patch_error + summary.uniformity.value * bias.of_mean;
    summary.uniformity = widened(summary.uniformity, of_quotient / summary.mean.value);
    summary.mean = widened(summary.mean, bias.of_mean);
    summary.minimum = widened(summary.minimum, *least->patch_error);
    summary.maximum = widened(summary.maximum, *most->patch_error);
}

/// Warns where the error of the patches is much of the whole.
std::vector<std::string> patch_error_warnings(const RunResult& result) {
    constexpr double much = 0.5;
    std::vector<std::string> warnings;
    for (const SensorResult& sensor : result.sensors) {
        if (!sensor.patch_error || *sensor.patch_error <= much * sensor.attained_error) continue;
        warnings.push_back(fmt::format(
            "sensor \"{}\": path tracing from some of its points differs by up to {:.2g} % from the "
            "light of the patches of {:.2g} m. The intervals include this error. Choose smaller "
            "patches, or method auto, which needs none.",
            sensor.sensor.name, 100 * *sensor.patch_error, result.patches->size_m));
    }
    return warnings;
}

/// " at 3 of 12 readings", where there are several.
std::string at_readings(std::size_t count, const Sensor& sensor) {
    const std::size_t all = sensor.size();
    return all == 1 ? "" : fmt::format(" at {} of {} readings", count, all);
}

/// Warns of readings whose light was found by few samples, or by none.
std::vector<std::string> rarity_warnings(const Campaign::Estimates& estimates, std::uint64_t samples,
                                         const Sensor& sensor) {
    std::size_t dark = 0, uncertain = 0;
    for (std::size_t j = 0; j < sensor.size(); ++j) {
        const bool is_dark = estimates.readings[j].value == 0;
        dark += is_dark;
        uncertain += !is_dark &&
                     rests_on_few_samples(estimates.readings[j], estimates.largest[j], estimates.samples[j]);
    }
    std::vector<std::string> warnings;
    if (dark > 0) {
        warnings.push_back(
            fmt::format("sensor \"{}\": {} samples found no light{}. If light gets there, the run needs more "
                        "paths or more time to find it.",
                        sensor.name, samples, at_readings(dark, sensor)));
    }
    // As for the limit on the error, the worst readings of a large sensor do not count.
    const double tolerated = (1 - statistics::kReadingShare) * static_cast<double>(sensor.size());
    if (static_cast<double>(uncertain) > tolerated) {
        warnings.push_back(
            fmt::format("sensor \"{}\": a few rare light paths make up much of the light, or of its error{}. "
                        "More of them may be missing, so that the interval is too narrow: give the run more "
                        "paths or more time.",
                        sensor.name, at_readings(uncertain, sensor)));
    }
    return warnings;
}

/// `first`: of the sensor's readings.
SensorResult sensor_result(const Campaign& campaign, const Sensor& sensor, std::size_t first,
                           std::span<const std::optional<Vec3>> sight_ends, double confidence,
                           std::vector<std::string>& warnings) {
    const std::size_t count = sensor.size();
    SensorResult result;
    result.sensor = sensor;
    Campaign::Estimates estimates = campaign.estimates(sensor, first, confidence);
    std::ranges::move(rarity_warnings(estimates, campaign.samples_in_all(), sensor),
                      std::back_inserter(warnings));
    result.summary = statistics::summarize_grid({estimates.replicate_means, count, estimates.columns},
                                                confidence, estimates.rare_light);
    result.replicate_means = std::move(estimates.replicate_means);
    result.attained_error = statistics::attained_error(estimates.readings);
    const std::vector<Rgb> rgb = campaign.rgb(first, count);
    for (std::size_t j = 0; j < count; ++j) result.readings.push_back({estimates.readings[j], rgb[j]});
    if (estimates.bias) include_patch_error(*estimates.bias, result);
    if (std::holds_alternative<Luminance>(sensor.kind)) {
        const auto ends = sight_ends.subspan(first, count);
        result.sub_points.assign(ends.begin(), ends.end());
    }
    return result;
}

/// The measurands of all sensors, with the weights for a run that stops when each sensor as a whole is exact
/// enough.
struct Wanted {
    explicit Wanted(std::span<const Sensor> sensors) {
        for (const Sensor& sensor : sensors) {
            std::ranges::copy(sensor.measurands(), std::back_inserter(measurands));
            weights.insert(weights.end(), sensor.size(), 1 / static_cast<double>(sensor.size()));
        }
        if (measurands.empty()) {
            throw InputError("no sensor to measure: the scene needs one under [sensors]");
        }
    }

    std::vector<Measurand> measurands;
    std::vector<double> weights;
};

/// Warns where the run has too few samples for the highlights of small lamps.
std::vector<std::string> sharp_light_warnings(const transport::SharpLight& sharp, std::uint64_t samples,
                                              const Scene& scene) {
    if (samples >= sharp.samples) return {};
    return {fmt::format(
        "object \"{}\" reflects or refracts small lamps sharply, and few samples find such light. The "
        "intervals may be too narrow with fewer than {:.2g} paths; this run had {}.",
        scene.object(sharp.object).name, static_cast<double>(sharp.samples), samples)};
}

}  // namespace

RunResult measure(const Scene& scene, std::span<const Sensor> sensors, const RunOptions& asked_options,
                  ProgressSink* progress, const std::atomic<bool>* interrupt) {
    if (has_levels_of_detail(scene)) {
        DetailedScene detailed = with_levels_of_detail(scene, sensors);
        RunResult result = measure(detailed.scene, sensors, asked_options, progress, interrupt);
        result.levels_of_detail = std::move(detailed.levels);
        return result;
    }
    const Wanted wanted(sensors);
    require_valid(asked_options);
    const estimators::EstimatorEntry& method = estimators::find_estimator(asked_options.method);
    const RunOptions options = with_reading_target(asked_options);
    require_measurable(sensors, method);

    Session session(scene, asked_options, options, progress, interrupt);
    require_surfaces(sensors, session.caster());
    std::vector<std::string> of_scene = session.scene_warnings(sensors);
    estimators::Problem problem = session.problem(math::RandomKey{options.seed}.derived(kReadingPreparation));
    problem.measurands = wanted.measurands;
    problem.weights = wanted.weights;
    std::unique_ptr<estimators::Estimator> estimator;
    session.on_threads([&] { estimator = method.make(problem); });
    // Patches store the light of highlights: each sample then contains it.
    const transport::SharpLight sharp = method.lights_patches
                                            ? transport::SharpLight{}
                                            : transport::find_sharp_light(scene, session.caster());
    Campaign campaign(*estimator, sensors, wanted.measurands.size(),
                      math::RandomKey{options.seed}.derived(kReadingReplicates),
                      ReplicatePlan::of(sensors, options, method.lights_patches),
                      std::min(sharp.samples, kMostAwaited));
    RunResult result;
    session.on_threads([&] { session.run(campaign, result); });
    campaign.require_valid();

    session.describe(*estimator, result);
    result.replicates = static_cast<int>(campaign.replicates());
    result.rays = campaign.rays();
    // A run that stopped by its own error estimate stops sooner where the estimate happens to be too small
    // (docs/statistics.md).
    const double confidence = options.error ? statistics::kStoppedConfidence : kConfidence;
    const auto warn = [&](std::vector<std::string> more) {
        std::ranges::move(more, std::back_inserter(result.warnings));
    };
    warn(std::move(of_scene));
    std::size_t first = 0;
    for (const Sensor& sensor : sensors) {
        result.sensors.push_back(
            sensor_result(campaign, sensor, first, estimator->sight_ends(), confidence, result.warnings));
        first += sensor.size();
    }
    warn(sharp_light_warnings(sharp, result.samples, scene));
    warn(patch_error_warnings(result));
    session.finish(result);
    result.scene_name = scene.name;
    return result;
}

}  // namespace stilb::run
