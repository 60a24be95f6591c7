#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "base/parallel.h"
#include "checks/checks.h"
#include "estimators/estimator_list.h"
#include "run/level_of_detail.h"
#include "run/run.h"
#include "run/schedule.h"
#include "statistics/interval.h"
#include "stilb/error.h"
#include "transport/line_of_sight.h"

namespace stilb::run {
namespace {

constexpr double kConfidence = 0.95;
/// Rays of a batch over all replicates: about a second of work, so that an interruption is answered quickly.
constexpr double kRaysPerRound = 3e7;
constexpr std::uint64_t kLongestBatch = 1 << 16;
/// Samples of a replicate: Sobol' indices have 32 bits.
constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 31;
/// Granules before the first error estimate: an estimate from fewer may be far too small.
constexpr std::uint64_t kLeastCheck = 4;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
enum ReadingPurpose : std::uint64_t { kReadingPreparation, kReadingReplicates };

/// The sums of all replicates, and their progress.
class Campaign final : public Work {
  public:
    Campaign(const estimators::Estimator& estimator, std::span<const Sensor> sensors, std::size_t readings,
             int replicates, std::uint64_t seed)
        : estimator_(estimator),
          sensors_(sensors),
          granularity_(estimator.batch_granularity()),
          sums_(static_cast<std::size_t>(replicates), estimators::ReadingSums(readings)) {
        for (std::size_t r = 0; r < sums_.size(); ++r) {
            keys_.push_back(math::RandomKey{seed}.derived(kReadingReplicates).derived(r));
        }
        const double per_batch = kRaysPerRound / (replicates * estimator.rays_per_sample());
        std::uint64_t batch = granularity_;
        while (2 * batch <= kLongestBatch && static_cast<double>(2 * batch) <= per_batch) batch *= 2;
        batch_ = batch;
    }

    std::uint64_t samples() const override { return samples_; }
    std::uint64_t samples_in_all() const override { return samples_ * sums_.size(); }
    std::uint64_t samples_for(std::uint64_t paths) const override {
        const auto divided_up = [](std::uint64_t x, std::uint64_t y) { return (x + y - 1) / y; };
        const std::uint64_t each = divided_up(paths, sums_.size());
        return std::min(divided_up(each, granularity_) * granularity_, kMostSamples);
    }
    std::uint64_t most_samples() const override { return kMostSamples; }
    std::uint64_t next_check() const override {
        return statistics::next_check(samples_, kLeastCheck * granularity_);
    }
    std::uint64_t most_at_once() const override { return batch_; }

    /// The same next samples of every replicate. Each replicate's sums belong to one task: nothing depends on
    /// threads.
    /// threads.
    bool advance(std::uint64_t count, const std::atomic<bool>*) override {
        parallel_for(sums_.size(), [&](std::size_t r) {
            estimator_.run_batch({keys_[r], samples_, count}, sums_[r]);
        });
        samples_ += count;
        return true;
    }

    /// The error of the worst sensor.
    double attained_error() const override {
        double worst = 0;
        std::size_t first = 0;
        for (const Sensor& sensor : sensors_) {
            const std::size_t count = sensor.size();
            const std::vector<double> means = replicate_means(first, count);
            worst = std::max(worst, statistics::attained_error(statistics::estimate_readings(
                                        {means, count}, statistics::kStoppedConfidence)));
            first += count;
        }
        return worst;
    }

    std::uint64_t rays() const {
        std::uint64_t rays = 0;
        for (const estimators::ReadingSums& s : sums_) rays += s.rays;
        return rays;
    }

    void require_valid() const {
        std::uint64_t invalid = 0;
        for (const estimators::ReadingSums& s : sums_) invalid += s.invalid;
        const double all = static_cast<double>(samples_in_all()) * static_cast<double>(sums_[0].sum.size());
        require_mostly_finite(invalid, all);
    }

    /// Replicates x readings of one sensor, luminance-weighted [lx].
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
        return estimator_.known_part()[reading] + sum * (1 / static_cast<double>(samples_in_all()));
    }

    bool is_heavy_tailed(std::size_t reading) const {
        double largest = 0, sum = 0;
        for (const estimators::ReadingSums& s : sums_) {
            largest = std::max(largest, s.largest[reading]);
            sum += s.sum[reading].luminance();
        }
        return stilb::statistics::is_heavy_tailed(largest, sum, samples_in_all());
    }

  private:
    const estimators::Estimator& estimator_;
    std::span<const Sensor> sensors_;
    std::uint64_t granularity_;
    std::vector<math::RandomKey> keys_;
    std::vector<estimators::ReadingSums> sums_;
    std::uint64_t batch_ = 1;
    std::uint64_t samples_ = 0;
};

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

/// The options with defaults for a run without targets. A deterministic method computes its result
/// once.
RunOptions with_reading_target(RunOptions options, const estimators::EstimatorEntry& method) {
    if (method.is_deterministic) {
        options.error.reset();
        options.paths.reset();
        options.replicates = 1;
    } else if (!options.error && !options.time_s && !options.paths) {
        options.error = 0.01;
        options.time_s = 60;
    }
    return options;
}

SensorResult sensor_result(const Campaign& campaign, const Sensor& sensor, std::size_t first,
                           std::span<const std::optional<Vec3>> sight_ends, double confidence) {
    const std::size_t count = sensor.size();
    SensorResult result;
    result.sensor = sensor;
    result.replicate_means = campaign.replicate_means(first, count);
    const statistics::ReplicateTable table{result.replicate_means, count};
    std::vector<statistics::Estimate> estimates;
    if (table.replicates() > 1) {
        estimates = estimate_readings(table, confidence);
        result.summary = summarize_grid(table, confidence);
        result.attained_error = statistics::attained_error(estimates);
    } else {
        std::ranges::transform(result.replicate_means, std::back_inserter(estimates),
                               statistics::without_error);
        result.summary = statistics::summarize_without_errors(result.replicate_means);
        result.attained_error = kUnknown;
    }
    for (std::size_t j = 0; j < count; ++j)
        result.readings.push_back({estimates[j], campaign.rgb(first + j)});
    if (std::holds_alternative<Luminance>(sensor.kind)) {
        const auto ends = sight_ends.subspan(first, count);
        result.sub_points.assign(ends.begin(), ends.end());
    }
    return result;
}

std::vector<std::string> heavy_tail_warnings(const Campaign& campaign, std::span<const Sensor> sensors) {
    std::vector<std::string> warnings;
    std::size_t first = 0;
    for (const Sensor& sensor : sensors) {
        std::size_t heavy = 0;
        for (std::size_t j = 0; j < sensor.size(); ++j) heavy += campaign.is_heavy_tailed(first + j);
        if (heavy > 0) {
            warnings.push_back(fmt::format(
                "sensor \"{}\": in {} of {} readings a single contribution exceeds {:.2g} % of the sum; "
                "the variance is probably infinite there (a corner) and the interval unreliable. Use "
                "method auto.",
                sensor.name, heavy, sensor.size(),
                100 * statistics::heavy_tail_share(campaign.samples_in_all())));
        }
        first += sensor.size();
    }
    return warnings;
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

void add_warnings(const Campaign& campaign, std::span<const Sensor> sensors, const Scene& scene,
                  const rays::RayCaster& caster, const estimators::EstimatorEntry& method,
                  const RunOptions& asked, std::vector<std::string>& warnings) {
    const auto append = [&](std::vector<std::string> more) {
        std::ranges::move(more, std::back_inserter(warnings));
    };
    if (method.is_deterministic && (asked.error || asked.paths)) {
        warnings.push_back(fmt::format(
            "method {} is deterministic and ends by itself: limits on error and paths have no effect.",
            method.name));
    }
    append(checks::placement_warnings(scene, caster, sensors));
    if (method.has_heavy_tails) append(heavy_tail_warnings(campaign, sensors));
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
    const RunOptions options = with_reading_target(asked_options, method);
    require_measurable(sensors, method);

    Session session(scene, asked_options, options, progress, interrupt);
    require_surfaces(sensors, session.caster());
    estimators::Problem problem = session.problem(math::RandomKey{options.seed}.derived(kReadingPreparation));
    problem.measurands = wanted.measurands;
    problem.weights = wanted.weights;
    std::unique_ptr<estimators::Estimator> estimator;
    session.on_threads([&] { estimator = method.make(problem); });
    Campaign campaign(*estimator, sensors, wanted.measurands.size(), options.replicates, options.seed);
    RunResult result;
    session.on_threads([&] {
        if (!method.is_deterministic) return session.run(campaign, result);
        campaign.advance(1, nullptr);
        result.stop_reason = StopReason::solved;
        result.attained_error = kUnknown;
    });
    campaign.require_valid();

    session.describe(*estimator, result);
    result.replicates = options.replicates;
    result.rays = campaign.rays();
    // A run that stopped by its own error estimate stops sooner where the estimate happens to be too small
    // (docs/statistics.md).
    const double confidence = options.error ? statistics::kStoppedConfidence : kConfidence;
    std::size_t first = 0;
    for (const Sensor& sensor : sensors) {
        result.sensors.push_back(sensor_result(campaign, sensor, first, estimator->sight_ends(), confidence));
        first += sensor.size();
    }
    add_warnings(campaign, sensors, scene, session.caster(), method, asked_options, result.warnings);
    session.finish(result);
    return result;
}

}  // namespace stilb::run
