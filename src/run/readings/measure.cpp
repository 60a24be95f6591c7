#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "estimators/estimator_list.h"
#include "run/glare/glare.h"
#include "run/glare/glare_picture.h"
#include "run/level_of_detail.h"
#include "run/readings/campaign.h"
#include "run/readings/division.h"
#include "run/readings/possible_light.h"
#include "run/readings/power_density.h"
#include "run/readings/sensor_estimates.h"
#include "run/run.h"
#include "run/streams.h"
#include "stilb/error.h"
#include "transport/line_of_sight.h"
#include "transport/receiver.h"
#include "transport/sharp_light.h"

namespace stilb::run {
namespace {

constexpr double kConfidence = 0.95;
/// Samples that a run makes for the sake of sharp light before its first error estimate: some seconds of
/// work.
constexpr std::uint64_t kMostAwaited = 1 << 20;

void require_measurable(std::span<const Sensor> sensors, const estimators::EstimatorEntry& method) {
    for (const Sensor& sensor : sensors) {
        if (sensor.measures_luminance() && !method.measures_luminance) {
            throw InputError(fmt::format("sensor \"{}\": method {} measures illuminance only. Luminance: {}.",
                                         sensor.name, method.name,
                                         fmt::join(estimators::luminance_methods(), ", ")));
        }
    }
}

void require_readings(std::span<const Sensor> sensors) {
    if (std::ranges::all_of(sensors, [](const Sensor& sensor) { return sensor.size() == 0; }))
        throw InputError("no sensor to measure: the scene needs one under [sensors]");
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

/// The options with defaults for a run without targets: requirements are one.
RunOptions with_reading_target(RunOptions options, std::span<const Sensor> sensors) {
    if (!options.error && !options.time_s && !options.paths) {
        if (!sensors::has_requirements(sensors)) options.error = 0.01;
        options.time_s = 60;
    }
    return options;
}

/// The sensors with the units of derived values, whose formulas must fit.
std::vector<Sensor> with_units(std::vector<Sensor> sensors) {
    for (Sensor& sensor : sensors) {
        auto* const derived = std::get_if<Derived>(&sensor.kind);
        if (!derived) continue;
        try {
            *derived = sensors::resolved(*derived, sensors);
        } catch (const InputError& error) {
            throw InputError(fmt::format("sensor \"{}\": {}", sensor.name, error.what()));
        }
    }
    return sensors;
}

bool has_colour(const Sensor& sensor) { return !sensor.derived() && !sensor.rates_glare(); }
Rgb unknown_colour() { return Rgb::grey(std::numeric_limits<double>::quiet_NaN()); }

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

/// Sensors, each with the share of its readings of which a warning speaks.
class ConcernedSensors {
  public:
    void add(const Sensor& sensor, std::size_t readings) {
        names_.push_back(fmt::format("\"{}\"", sensor.name));
        shares_.push_back(sensor.size() == 1 ? ""
                                             : fmt::format("{} of {} readings", readings, sensor.size()));
    }

    /// One sentence, if there are any: `sensor "desk": BEGINNING at 3 of 12 readings. END`, or
    /// `sensors "desk" (3 of 12 readings), "wall": BEGINNING. END`.
    void warn(std::string_view beginning, std::string_view end, std::vector<Warning>& warnings) const {
        if (names_.empty()) return;
        const auto add = [&](std::string sentence) {
            warnings.emplace_back(WarningKind::rare_light, std::move(sentence));
        };
        if (names_.size() == 1) {
            const std::string at = shares_[0].empty() ? "" : " at " + shares_[0];
            return add(fmt::format("sensor {}: {}{}. {}", names_[0], beginning, at, end));
        }
        std::string list;
        for (std::size_t i = 0; i < names_.size(); ++i) {
            list += (i == 0 ? "" : ", ") + names_[i];
            if (!shares_[i].empty()) list += " (" + shares_[i] + ")";
        }
        add(fmt::format("sensors {}: {}. {}", list, beginning, end));
    }

  private:
    std::vector<std::string> names_, shares_;
};

/// Sensors with readings whose light was found by few samples, or by none.
struct RareLight {
    ConcernedSensors dark, uncertain;

    void add(const Campaign::Estimates& estimates, const Sensor& sensor) {
        std::size_t dark_readings = 0, uncertain_readings = 0;
        for (std::size_t j = 0; j < sensor.size(); ++j) {
            const bool is_dark = estimates.readings[j].value == 0;
            dark_readings += is_dark;
            uncertain_readings +=
                !is_dark &&
                rests_on_few_samples(estimates.readings[j], estimates.largest[j], estimates.samples[j]);
        }
        if (dark_readings > 0) dark.add(sensor, dark_readings);
        // As for the limit on the error, the worst readings of a large sensor do not count.
        const double tolerated = (1 - statistics::kReadingShare) * static_cast<double>(sensor.size());
        if (static_cast<double>(uncertain_readings) > tolerated) uncertain.add(sensor, uncertain_readings);
    }

    void warn(std::uint64_t samples, std::vector<Warning>& warnings) const {
        dark.warn(fmt::format("{} samples found no light", samples),
                  "If light gets there, the run needs more paths or more time to find it.", warnings);
        uncertain.warn("a few rare light paths make up much of the light, or of its error",
                       "More of them may be missing, so that the interval is too narrow: give the run more "
                       "paths or more time.",
                       warnings);
    }
};

/// `first`: of the sensor's readings.
SensorResult sensor_result(const Campaign& campaign, const Sensor& sensor, SensorEstimates&& estimates,
                           std::size_t first, std::span<const std::optional<Vec3>> sight_ends,
                           ChannelWeights weights) {
    const std::size_t count = sensor.size();
    Campaign::Estimates& own = estimates.readings;
    SensorResult result;
    result.sensor = sensor;
    result.summary = estimates.summary;
    result.replicate_means = std::move(own.replicate_means);
    const std::vector<Rgb> rgb = has_colour(sensor) ? campaign.rgb(first, count, weights)
                                                    : std::vector(own.readings.size(), unknown_colour());
    for (std::size_t j = 0; j < rgb.size(); ++j) result.readings.push_back({own.readings[j], rgb[j]});
    if (own.bias) {
        result.patch_error = own.bias->relative;
        for (std::size_t j = 0; j < count; ++j) result.readings[j].patch_error = own.bias->of_readings[j];
    }
    if (std::holds_alternative<Luminance>(sensor.kind)) {
        const auto ends = sight_ends.subspan(first, count);
        result.sub_points.assign(ends.begin(), ends.end());
    }
    return result;
}

/// A run that stopped by its own estimates stopped sooner where the errors happened to be too small, or where
/// values happened to be far from what is required (docs/statistics.md).
double confidence_of(const RunOptions& options, StopReason reason) {
    if (reason == StopReason::requirements_decided) return statistics::kDecidedConfidence;
    return options.error ? statistics::kStoppedConfidence : kConfidence;
}

std::vector<RatedRequirement> rated(std::span<const Requirement> requirements, std::size_t sensor,
                                    const SensorEstimates& estimates, const GlareViews& glare,
                                    const Scene& scene) {
    std::vector<RatedRequirement> all = rate(requirements, estimates);
    for (RatedRequirement& rated : all) {
        if (rated.verdict == Verdict::unsure) rated.reason = glare.reason_of_doubt(sensor, estimates, scene);
    }
    return all;
}

/// Sets the results of all sensors and the power density, and adds the warnings of all sensors. `scene`,
/// `glare` and `weights` are those of a state of the lamps.
void set_results(const Campaign& campaign, const Scene& scene, std::span<const Sensor> sensors,
                 const GlareViews& glare, const RunOptions& options,
                 std::span<const std::optional<Vec3>> sight_ends, ChannelWeights weights, RunResult& result) {
    const bool has_looked = sensors::has_requirements(sensors) && ends_when_decided(options);
    const double confidence = result.confidence = confidence_of(options, result.stop_reason);
    std::vector<SensorEstimates> estimates = estimate_all(campaign, sensors, confidence, weights);
    std::vector<double> attained;
    std::vector<std::vector<GlareView>> views;
    RareLight rare_light;
    for (std::size_t s = 0; s < sensors.size(); ++s) {
        views.push_back(glare.described_views(s, estimates[s], scene));
        attained.push_back(statistics::attained_error(estimates[s].readings.readings));
        rare_light.add(estimates[s].readings, sensors[s]);
    }
    // Without lights all is dark; the scene reader warns of it.
    if (!scene.lights.empty()) rare_light.warn(campaign.samples_in_all(), result.warnings);
    result.power_density = power_density(result.power, sensors, estimates, confidence);
    add_warnings(WarningKind::glare, glare.warnings(scene, sensors, estimates), result.warnings);
    glare.rate(estimates, confidence);
    std::vector<SensorEstimates> deciding;
    if (has_looked) {
        deciding = estimate_all(campaign, sensors, statistics::kVerdictConfidence, weights);
        glare.rate(deciding, statistics::kVerdictConfidence);
    }
    std::vector<std::vector<RatedRequirement>> verdicts;
    for (std::size_t s = 0; s < sensors.size(); ++s)
        verdicts.push_back(
            rated(sensors[s].requirements, s, has_looked ? deciding[s] : estimates[s], glare, scene));
    std::size_t first = 0;
    for (std::size_t s = 0; s < sensors.size(); ++s) {
        const Sensor& sensor = sensors[s];
        SensorResult& own = result.sensors.emplace_back(
            sensor_result(campaign, sensor, std::move(estimates[s]), first, sight_ends, weights));
        own.attained_error = attained[s];
        own.glare = std::move(views[s]);
        own.requirements = std::move(verdicts[s]);
        first += sensor.size();
    }
}

/// Adds to the sensors what the parts of the light give: of illuminances and luminances, not of ratings.
void add_shares(const Campaign& campaign, const LightDivision& division, double confidence,
                RunResult& result) {
    for (const LightDivision::Part& part : division.shares()) {
        std::size_t first = 0;
        for (SensorResult& sensor : result.sensors) {
            const std::size_t size = sensor.sensor.size();
            if (size > 0 && !sensor.sensor.rates_glare()) {
                Campaign::Estimates own = campaign.estimates(sensor.sensor, first, confidence, part.weights);
                const statistics::GridSummary summary = summary_of(own, confidence);
                sensor.shares.push_back(
                    {part.name, std::move(own.readings), summary, std::move(own.replicate_means)});
            }
            first += size;
        }
    }
}

/// The measurands of all sensors, with the weights for a run that stops when each sensor as a whole is exact
/// enough.
struct Wanted {
    explicit Wanted(std::span<const Sensor> sensors) {
        std::size_t readings = 0;
        for (const Sensor& sensor : sensors) readings += sensor.size();
        measurands.reserve(readings);
        for (std::uint32_t s = 0; s < sensors.size(); ++s) {
            const Sensor& sensor = sensors[s];
            std::ranges::copy(sensor.measurands(), std::back_inserter(measurands));
            weights.insert(weights.end(), sensor.size(), 1 / static_cast<double>(sensor.size()));
            sensor_of.insert(sensor_of.end(), sensor.size(), s);
        }
    }

    std::vector<Measurand> measurands;
    std::vector<double> weights;
    std::vector<std::uint32_t> sensor_of;  ///< by measurand
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

/// Throws InputError where light must be kept apart, and the method does not.
void require_channels(const LightDivision& division, const estimators::EstimatorEntry& method,
                      const RunOptions& options) {
    const auto first_shot = options.patches.first_shot.variant.value_or(estimators::FirstShotVariant::none);
    if (!division.channels() || (!method.lights_patches && first_shot == estimators::FirstShotVariant::none))
        return;
    throw InputError(
        fmt::format("{}: method {} with its patches keeps the light of lamps and of bounces together. "
                    "Methods that keep it apart: path "
                    "without first shot, light-paths, guided, and auto, which chooses one of them.",
                    division.shares().empty() ? "[scenes]" : "by", method.name));
}

/// Sets the results of a run in a state of the lamps: sensors, glare, their warnings and power.
void set_results_in(const LightDivision::State& state, const Campaign& campaign, const Scene& scene,
                    std::span<const Sensor> sensors, const RunOptions& options,
                    const estimators::Estimator& estimator, Session& session, RunResult& result) {
    const Scene lit = scene::lit(scene, state.light_scene);
    result.power = scene::installed_power(lit);
    result.rooms = power_of_rooms(lit, session.caster());
    const int most = session.problem().max_reflections, bounces = state.light_scene.bounces.value_or(most);
    const std::uint64_t seed = campaign.plan().seed;
    const GlareViews glare(sensors, {lit, session.caster(), std::min(bounces, most), seed, session.monitor()},
                           campaign.plan().replicates, key_of_seed(seed).derived(RunStream::glare));
    set_results(campaign, lit, sensors, glare, options, estimator.sight_ends(), state.weights, result);
    result.attained_error = 0;
    for (const SensorResult& sensor : result.sensors)
        result.attained_error = std::max(result.attained_error, sensor.attained_error);
    const std::vector<std::string>& chosen = state.light_scene.sensors;
    if (chosen.empty()) return;
    std::erase_if(result.sensors, [&](const SensorResult& sensor) {
        return std::ranges::find(chosen, sensor.sensor.name) == chosen.end();
    });
}

/// The results in all light scenes. Their warnings are those of the run, except for glare.
void add_light_scenes(const LightDivision& division, const Campaign& campaign, const Scene& scene,
                      std::span<const Sensor> sensors, const RunOptions& options,
                      const estimators::Estimator& estimator, Session& session, RunResult& result) {
    for (const LightDivision::State& state : division.states()) {
        RunResult& own = result.light_scenes.emplace_back();
        own.scene_name = state.light_scene.name;
        own.stop_reason = result.stop_reason;
        session.on_threads(
            [&] { set_results_in(state, campaign, scene, sensors, options, estimator, session, own); });
        for (const Warning& warning : std::exchange(own.warnings, {})) {
            if (warning.kind != WarningKind::glare ||
                std::ranges::find(result.warnings, warning) != result.warnings.end())
                continue;
            result.warnings.emplace_back(WarningKind::glare,
                                         fmt::format("light scene \"{}\": {}", own.scene_name, warning.text));
        }
    }
}

/// Begins a run, or continues one that has a plan. A part of a run has no results.
RunResult run_readings(const PreparedScene& prepared, std::span<const Sensor> given_sensors,
                       const RunOptions& asked_options, ProgressSink* progress,
                       const std::atomic<bool>* interrupt, RunState& state, RunPart part,
                       Samples samples = Samples::as_asked, const LightScene* dimmed = nullptr) {
    const Scene& scene = prepared.scene();
    if (has_levels_of_detail(scene)) {
        DetailedScene detailed = with_levels_of_detail(scene, given_sensors);
        RunResult result = run_readings(detailed.scene, given_sensors, asked_options, progress, interrupt,
                                        state, part, samples, dimmed);
        result.levels_of_detail = std::move(detailed.levels);
        return result;
    }
    const bool begins = state.plan.technique.empty();
    require_readings(given_sensors);
    require_valid(asked_options);
    if (samples == Samples::as_asked && !state.more_seeds.empty())
        throw std::invalid_argument("the sums are of several seeds, and cannot be continued");
    const estimators::EstimatorEntry& method =
        estimators::find_estimator(begins ? asked_options.method : state.plan.technique);
    RunOptions options = with_reading_target(asked_options, given_sensors);
    if (!begins) options.seed = state.plan.seed;
    if (samples == Samples::no_more) options.paths = 0;  // there are as many
    require_measurable(given_sensors, method);
    const LightDivision division(scene, options);
    require_channels(division, method, options);

    Session session(prepared, given_sensors, asked_options, options, progress, interrupt);
    require_surfaces(given_sensors, session.caster());
    const std::vector<Sensor> sensors = with_units(session.without_hidden_points(given_sensors));
    const Wanted wanted(sensors);
    std::vector<Warning> of_scene = session.scene_warnings(sensors);
    estimators::Problem problem = session.problem();
    problem.measurands = wanted.measurands;
    problem.weights = wanted.weights;
    problem.sensors = wanted.sensor_of;
    problem.error = options.error.value_or(problem.error);
    problem.channels = division.channels();
    std::unique_ptr<estimators::Estimator> estimator;
    session.on_threads([&] { estimator = method.make(problem); });
    // Patches store the light of highlights: each sample then contains it.
    const transport::SharpLight sharp = method.lights_patches
                                            ? transport::SharpLight{}
                                            : transport::find_sharp_light(scene, session.caster());
    if (begins) state = {RunPlan::of(sensors, options, method.lights_patches), {}};
    std::optional<GlareViews> glare;
    session.on_threads([&] {
        const PictureSetting setting{scene, session.caster(), problem.max_reflections, options.seed,
                                     session.monitor()};
        const math::RandomKey key = key_of_seed(options.seed).derived(RunStream::glare);
        glare.emplace(sensors, setting, state.plan.replicates, key);
    });
    const PossibleLight possible(scene, session.caster(), problem.max_reflections, *estimator);
    const auto campaign_of = [&](RunState& sums, RunPart strands) {
        return std::make_unique<Campaign>(*estimator, sensors, *glare, possible, wanted.measurands.size(),
                                          division, sums, options, std::min(sharp.samples, kMostAwaited),
                                          strands);
    };
    if (part.of > 1 && !state.plan.is_complete()) {
        RunState first{state.plan, {}};
        session.on_threads([&] { campaign_of(first, {})->complete_plan(options.paths.value()); });
        state.plan = std::move(first.plan);
    }
    const std::unique_ptr<Campaign> owned = campaign_of(state, part);
    Campaign& campaign = *owned;
    RunResult result;
    session.on_threads([&] { session.run(campaign, result); });
    campaign.require_valid();

    session.describe(*estimator, result);
    result.replicates = static_cast<int>(campaign.replicates());
    result.rays = campaign.rays();
    std::ranges::move(of_scene, std::back_inserter(result.warnings));
    result.power = scene::installed_power(scene);
    result.rooms = power_of_rooms(scene, session.caster());
    const bool is_whole = part.of == 1;
    if (is_whole && dimmed) {
        const LightDivision::State lamps = division.state_of(*dimmed, scene);
        session.on_threads(
            [&] { set_results_in(lamps, campaign, scene, sensors, options, *estimator, session, result); });
    } else if (is_whole) {
        set_results(campaign, scene, sensors, *glare, options, estimator->sight_ends(), {}, result);
        add_shares(campaign, division, confidence_of(options, result.stop_reason), result);
        add_light_scenes(division, campaign, scene, sensors, options, *estimator, session, result);
    }
    add_warnings(WarningKind::rare_light, sharp_light_warnings(sharp, result.samples, scene),
                 result.warnings);
    add_warnings(WarningKind::patches, patch_error_warnings(result), result.warnings);
    session.finish(result);
    if (!state.more_seeds.empty()) result.seeds = state.seeds();
    result.scene_name = scene.name;
    return result;
}

}  // namespace

RunResult measure(const PreparedScene& scene, std::span<const Sensor> sensors, const RunOptions& options,
                  ProgressSink* progress, const std::atomic<bool>* interrupt, RunState* state) {
    RunState own;
    return run_readings(scene, sensors, options, progress, interrupt, state ? *state : own, {});
}

RunResult result_of(const PreparedScene& scene, std::span<const Sensor> sensors, const RunOptions& options,
                    RunState& state, const LightScene* dimmed, ProgressSink* progress,
                    const std::atomic<bool>* interrupt) {
    RunOptions without_limit = options;
    without_limit.time_s.reset();
    return run_readings(scene, sensors, without_limit, progress, interrupt, state, {}, Samples::no_more,
                        dimmed);
}

RunSummary measure_part(const PreparedScene& scene, std::span<const Sensor> sensors,
                        const RunOptions& options, RunPart part, RunState& state, ProgressSink* progress,
                        const std::atomic<bool>* interrupt) {
    require_part(options, part);
    return run_readings(scene, sensors, options, progress, interrupt, state, part);
}

}  // namespace stilb::run
