#include "run/run.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <stdexcept>

#include "base/error.h"
#include "checks/placement.h"
#include "estimators/estimator_list.h"
#include "run/clock.h"
#include "run/remaining_time.h"
#include "run/threads.h"
#include "statistics/heavy_tail.h"
#include "statistics/stopping.h"
#include "transport/line_of_sight.h"

namespace stilb::run {
namespace {

constexpr double kConfidence = 0.95;
/// Rays of a batch over all replicates: about a second of work, so that an interruption is answered soon.
constexpr double kRaysPerRound = 3e7;
constexpr std::uint64_t kLongestBatch = 1 << 16;
/// Of a replicate: Sobol' indices have 32 bits.
constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 31;
/// Granules before the first look: an error that is estimated from fewer may be far too small.
constexpr std::uint64_t kLeastLook = 4;
/// Contributions that may fail to be finite before the run does.
constexpr double kInvalidRate = 1e-6;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
enum Purpose : std::uint64_t { kPreparation, kReplicates };

/// The replicates' sums, and how far they are.
class Campaign {
  public:
    Campaign(const estimators::Estimator& estimator, std::size_t readings, int replicates, std::uint64_t seed)
        : estimator_(estimator),
          sums_(static_cast<std::size_t>(replicates), estimators::ReadingSums(readings)) {
        for (std::size_t r = 0; r < sums_.size(); ++r) {
            keys_.push_back(math::RandomKey{seed}.derived(kReplicates).derived(r));
        }
        const double per_batch = kRaysPerRound / (replicates * estimator.rays_per_sample());
        std::uint64_t batch = estimator.batch_granularity();
        while (2 * batch <= kLongestBatch && static_cast<double>(2 * batch) <= per_batch) batch *= 2;
        batch_ = batch;
    }

    std::uint64_t batch_size() const { return batch_; }
    std::uint64_t samples() const { return samples_; }
    std::uint64_t paths() const { return samples_ * sums_.size(); }

    /// The same next samples of every replicate. Each replicate's sums are its task's own: nothing depends on
    /// threads.
    void advance(std::uint64_t count) {
        tbb::parallel_for(std::size_t{0}, sums_.size(), [&](std::size_t r) {
            estimator_.run_batch({keys_[r], samples_, count}, sums_[r]);
        });
        samples_ += count;
    }

    std::uint64_t rays() const {
        std::uint64_t rays = 0;
        for (const estimators::ReadingSums& s : sums_) rays += s.rays;
        return rays;
    }

    void require_valid() const {
        std::uint64_t invalid = 0;
        for (const estimators::ReadingSums& s : sums_) invalid += s.invalid;
        const double all = static_cast<double>(paths()) * static_cast<double>(sums_[0].sum.size());
        if (static_cast<double>(invalid) > kInvalidRate * all) {
            throw std::runtime_error(
                fmt::format("{} of {} contributions are not finite numbers: this is a defect of stilb, "
                            "please report the scene",
                            invalid, all));
        }
    }

    /// Replicates x readings (those of one sensor), luminance-weighted [lx].
    std::vector<double> replicate_means(std::size_t first, std::size_t count) const {
        std::vector<double> means;
        means.reserve(sums_.size() * count);
        const auto known = estimator_.known_part();
        for (const estimators::ReadingSums& s : sums_) {
            for (std::size_t j = first; j < first + count; ++j) {
                means.push_back(known[j].luminance() + s.sum[j].luminance() / static_cast<double>(samples_));
            }
        }
        return means;
    }

    Rgb rgb(std::size_t reading) const {
        Rgb sum;
        for (const estimators::ReadingSums& s : sums_) sum += s.sum[reading];
        return estimator_.known_part()[reading] + sum * (1 / static_cast<double>(paths()));
    }

    bool is_heavy_tailed(std::size_t reading) const {
        double largest = 0, sum = 0;
        for (const estimators::ReadingSums& s : sums_) {
            largest = std::max(largest, s.largest[reading]);
            sum += s.sum[reading].luminance();
        }
        return stilb::statistics::is_heavy_tailed(largest, sum, paths());
    }

  private:
    const estimators::Estimator& estimator_;
    std::vector<math::RandomKey> keys_;
    std::vector<estimators::ReadingSums> sums_;
    std::uint64_t batch_ = 1;
    std::uint64_t samples_ = 0;
};

void require_measurable(std::span<const Sensor> sensors, const estimators::EstimatorEntry& method) {
    for (const Sensor& sensor : sensors) {
        if (sensor.measures_luminance() && !method.measures_luminance()) {
            throw InputError(fmt::format("sensor \"{}\": method {} measures illuminance only. Luminance: {}.",
                                         sensor.name, method.name,
                                         fmt::join(estimators::luminance_methods(), ", ")));
        }
    }
}

/// A goniometer that stands on nothing has nothing to measure.
void require_surfaces(std::span<const Sensor> sensors, const rays::RayCaster& caster) {
    for (const Sensor& sensor : sensors) {
        for (const Measurand& measurand : sensor.measurands()) {
            const auto* ray = std::get_if<EmergentRay>(&measurand);
            if (!ray || transport::first_surface(measurand, caster)) continue;
            const Vec3& p = ray->position;
            throw InputError(fmt::format(
                "sensor \"{}\": its point ({}, {}, {}) lies on no surface. A goniometer needs a point on a "
                "surface, and a normal that points away from it.",
                sensor.name, p.x, p.y, p.z));
        }
    }
}

double attained_error(const Campaign& campaign, std::span<const Sensor> sensors) {
    double worst = 0;
    std::size_t first = 0;
    for (const Sensor& sensor : sensors) {
        const std::size_t count = sensor.size();
        const std::vector<double> means = campaign.replicate_means(first, count);
        worst = std::max(worst, stilb::statistics::attained_error(statistics::estimate_readings(
                                    {means, count}, statistics::kStoppedConfidence)));
        first += count;
    }
    return worst;
}

/// With the default of a run that was asked for nothing in particular; a method without chance does what
/// there is to do, once.
RunOptions with_target(RunOptions options, const estimators::EstimatorEntry& method) {
    if (method.is_deterministic) {
        options.error = options.time_s = std::nullopt;
        options.paths.reset();
        options.replicates = 1;
    } else if (!options.error && !options.time_s && !options.paths) {
        options.error = 0.01;
        options.time_s = 60;
    }
    return options;
}

/// Samples until a stop rule says so; keeps attained_error and stop_reason of the result.
class Schedule {
  public:
    Schedule(const RunOptions& options, const estimators::Estimator& estimator, const Clock& clock,
             const std::atomic<bool>* interrupt)
        : options_(options),
          clock_(clock),
          interrupt_(interrupt),
          granularity_(estimator.batch_granularity()) {
        if (!options.paths) return;
        const auto divided_up = [](std::uint64_t a, std::uint64_t b) { return (a + b - 1) / b; };
        const std::uint64_t each = divided_up(*options.paths, static_cast<std::uint64_t>(options.replicates));
        last_sample_ = std::min(divided_up(each, granularity_) * granularity_, kMostSamples);
    }

    void proceed(Campaign& campaign, std::span<const Sensor> sensors, ProgressSink* progress,
                 RunResult& result) {
        for (;;) {
            const std::uint64_t checkpoint =
                std::min(last_sample_, statistics::next_look(campaign.samples(), kLeastLook * granularity_));
            while (campaign.samples() < checkpoint) {
                const std::uint64_t next = std::min(campaign.batch_size(), checkpoint - campaign.samples());
                if (const auto reason = early_stop(campaign, next)) {
                    result.stop_reason = *reason;
                    result.attained_error = attained_error(campaign, sensors);
                    return;
                }
                campaign.advance(next);
            }
            result.attained_error = attained_error(campaign, sensors);
            if (progress) progress->report(progress_of(campaign, result.attained_error));
            const bool reached = options_.error && result.attained_error <= *options_.error;
            if (reached || campaign.samples() == last_sample_) {
                result.stop_reason = reached ? StopReason::target_reached : StopReason::paths_done;
                return;
            }
        }
    }

  private:
    /// A first round is always made: there is no result without one.
    std::optional<StopReason> early_stop(const Campaign& campaign, std::uint64_t next) const {
        if (campaign.samples() == 0) return std::nullopt;
        if (interrupt_ && *interrupt_) return StopReason::interrupted;
        if (!options_.time_s) return std::nullopt;
        const double per_sample_s = clock_.elapsed_s() / static_cast<double>(campaign.samples());
        const double after_next_s = clock_.elapsed_s() + per_sample_s * static_cast<double>(next);
        return after_next_s > *options_.time_s ? std::optional{StopReason::time_over} : std::nullopt;
    }

    ProgressSink::Progress progress_of(const Campaign& campaign, double attained) const {
        const double elapsed_s = clock_.elapsed_s();
        const double done = static_cast<double>(campaign.samples()) / static_cast<double>(last_sample_);
        return {elapsed_s, remaining_time_s(options_, elapsed_s, attained, done), attained, campaign.paths()};
    }

    const RunOptions& options_;
    const Clock& clock_;
    const std::atomic<bool>* interrupt_;
    std::uint64_t granularity_;
    std::uint64_t last_sample_ = kMostSamples;
};

SensorResult sensor_result(const Campaign& campaign, const Sensor& sensor, std::size_t first,
                           double confidence) {
    const std::size_t count = sensor.size();
    const std::vector<double> means = campaign.replicate_means(first, count);
    const statistics::ReplicateTable table{means, count};
    std::vector<statistics::Estimate> estimates;
    SensorResult result;
    if (table.replicates() > 1) {
        estimates = estimate_readings(table, confidence);
        result.summary = summarize_grid(table, confidence);
        result.attained_error = attained_error(estimates);
    } else {
        std::ranges::transform(means, std::back_inserter(estimates), statistics::without_error);
        result.summary = statistics::summarize_without_errors(means);
        result.attained_error = kUnknown;
    }
    for (std::size_t j = 0; j < count; ++j)
        result.readings.push_back({estimates[j], campaign.rgb(first + j)});
    return result;
}

std::vector<std::optional<Vec3>> sub_points(const Sensor& sensor, const Scene& scene,
                                            const rays::RayCaster& caster) {
    std::vector<std::optional<Vec3>> points;
    if (!std::holds_alternative<Luminance>(sensor.kind)) return points;
    const transport::LightSampler lights(scene, caster);
    for (const Measurand& measurand : sensor.measurands()) {
        const transport::VisibleSurfaces sight =
            look(measurand, scene, caster, lights, transport::kUnlimited);
        points.push_back(sight.sub_points.empty() ? std::nullopt
                                                  : std::optional{sight.sub_points.front().surface.position});
    }
    return points;
}

std::vector<std::string> heavy_tail_warnings(const Campaign& campaign, std::span<const Sensor> sensors) {
    std::vector<std::string> warnings;
    std::size_t first = 0;
    for (const Sensor& sensor : sensors) {
        std::size_t heavy = 0;
        for (std::size_t j = 0; j < sensor.size(); ++j) heavy += campaign.is_heavy_tailed(first + j);
        if (heavy > 0) {
            warnings.push_back(fmt::format(
                "sensor \"{}\": in {} of {} readings a single contribution is more than {:.2g} % of the sum; "
                "the variance "
                "is probably infinite there (a corner) and the interval may not hold. Use --method auto.",
                sensor.name, heavy, sensor.size(), 100 * statistics::heavy_tail_share(campaign.paths())));
        }
        first += sensor.size();
    }
    return warnings;
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
    std::vector<Measurand> measurands;
    std::vector<double> weights;  // a run stops when each sensor as a whole is exact enough
    for (const Sensor& sensor : sensors) {
        std::ranges::copy(sensor.measurands(), std::back_inserter(measurands));
        weights.insert(weights.end(), sensor.size(), 1 / static_cast<double>(sensor.size()));
    }
    if (measurands.empty()) {
        throw InputError("no sensor to measure: the scene needs one under [sensors]");
    }
    require_valid(asked_options);
    const estimators::EstimatorEntry& method = estimators::find_estimator(asked_options.method);
    const RunOptions options = with_target(asked_options, method);
    require_measurable(sensors, method);

    const Clock clock;
    const rays::RayCaster caster(scene);
    require_surfaces(sensors, caster);
    Threads threads(options.threads);
    const auto estimator = threads.arena.execute([&] {
        return method.make({scene, caster, measurands, options.bounces.value_or(transport::kUnlimited),
                            math::RandomKey{options.seed}.derived(kPreparation), weights, options.patches});
    });
    Campaign campaign(*estimator, measurands.size(), options.replicates, options.seed);
    RunResult result;
    result.method = options.method;
    result.seed = options.seed;
    result.replicates = options.replicates;
    threads.arena.execute([&] {
        if (method.is_deterministic) {
            campaign.advance(1);
            result.stop_reason = StopReason::solved;
            result.attained_error = kUnknown;
        } else {
            Schedule(options, *estimator, clock, interrupt).proceed(campaign, sensors, progress, result);
        }
    });
    campaign.require_valid();

    result.converged = result.stop_reason != StopReason::interrupted &&
                       (!options.error || result.attained_error <= *options.error);
    result.paths = method.is_deterministic ? 0 : campaign.paths();
    result.rays = campaign.rays();
    // A run that stopped by its own error stops sooner where that happens to be too small
    // (docs/statistics.md).
    const double confidence = options.error ? statistics::kStoppedConfidence : kConfidence;
    std::size_t first = 0;
    for (const Sensor& sensor : sensors) {
        result.sensors.push_back(sensor_result(campaign, sensor, first, confidence));
        result.sensors.back().sub_points = sub_points(sensor, scene, caster);
        first += sensor.size();
    }
    result.patches = estimator->patch_report();
    result.warnings = estimator->warnings();
    if (method.is_deterministic && (asked_options.error || asked_options.time_s || asked_options.paths)) {
        result.warnings.push_back(
            fmt::format("method {} knows no statistical error and ends by itself: error, time and paths are "
                        "not looked at.",
                        method.name));
    }
    for (auto& warning : checks::placement_warnings(scene, caster, sensors))
        result.warnings.push_back(std::move(warning));
    if (method.has_heavy_tails) {
        for (auto& warning : heavy_tail_warnings(campaign, sensors))
            result.warnings.push_back(std::move(warning));
    }
    result.elapsed_s = clock.elapsed_s();
    return result;
}

}  // namespace stilb::run
