#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "base/parallel.h"
#include "estimators/estimator_list.h"
#include "run/level_of_detail.h"
#include "run/run.h"
#include "run/schedule.h"
#include "statistics/interval.h"
#include "statistics/rare.h"
#include "stilb/error.h"
#include "transport/line_of_sight.h"
#include "transport/sharp_light.h"

namespace stilb::run {
namespace {

constexpr double kConfidence = 0.95;
/// Rays of a batch over all replicates: about a second of work, so that an interruption is answered quickly.
constexpr double kRaysPerRound = 3e7;
constexpr std::uint64_t kLongestBatch = 1 << 16;
/// Samples of a replicate: Sobol' indices have 32 bits.
constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 31;
/// Replicates that a result needs, where time does not suffice for all.
constexpr std::size_t kLeastReplicates = 8;
/// Samples that a run makes for the sake of sharp light before its first error estimate: some seconds of
/// work.
constexpr std::uint64_t kMostAwaited = 1 << 20;
enum ReadingPurpose : std::uint64_t { kReadingPreparation, kReadingReplicates };

/// The sums of all replicates, and their progress.
class Campaign final : public Work {
  public:
    /// `least_samples`: of all replicates, before the first error estimate.
    Campaign(const estimators::Estimator& estimator, std::span<const Sensor> sensors, std::size_t readings,
             const RunOptions& options, std::uint64_t least_samples)
        : estimator_(estimator), sensors_(sensors), granularity_(estimator.batch_granularity()) {
        const auto count = static_cast<std::size_t>(options.replicates);
        replicates_.reserve(count);
        for (std::size_t r = 0; r < count; ++r) {
            replicates_.emplace_back(math::RandomKey{options.seed}.derived(kReadingReplicates).derived(r),
                                     readings);
        }
        first_check_ = std::max(estimator.first_check(), samples_for(least_samples));
        const double per_batch = kRaysPerRound / (options.replicates * estimator.rays_per_sample());
        while (2 * batch_ <= kLongestBatch && static_cast<double>(2 * batch_) <= per_batch) batch_ *= 2;
        batch_ = std::max(batch_ / granularity_, std::uint64_t{1}) * granularity_;
    }

    std::uint64_t samples() const override { return samples_; }
    std::uint64_t samples_in_all() const override {
        std::uint64_t all = 0;
        for (const Replicate& replicate : replicates_) all += replicate.samples;
        return all;
    }
    std::uint64_t samples_for(std::uint64_t paths) const override {
        const auto divided_up = [](std::uint64_t x, std::uint64_t y) { return (x + y - 1) / y; };
        const std::uint64_t each = divided_up(paths, replicates_.size());
        return std::min(divided_up(each, granularity_) * granularity_, kMostSamples);
    }
    std::uint64_t most_samples() const override { return kMostSamples; }
    std::uint64_t next_check() const override { return statistics::next_check(samples_, first_check_); }
    std::uint64_t most_at_once() const override { return batch_; }
    bool has_result() const override {
        const auto begun = std::ranges::count_if(replicates_, &Replicate::samples);
        return static_cast<std::size_t>(begun) >= std::min(kLeastReplicates, replicates_.size());
    }

    /// The same next samples of every replicate. Each replicate's sums belong to one task: nothing depends on
    /// threads. Where the run is ended, unfinished batches are left out. Replicates of different length have
    /// the same expectation, and their spread still gives the error of their mean.
    void advance(std::uint64_t count) override {
        try {
            parallel_for(replicates_.size(), [&](std::size_t r) { replicates_[r].add(count, estimator_); });
        } catch (const Cancelled&) {
            if (has_result()) std::erase_if(replicates_, [](const Replicate& r) { return r.samples == 0; });
            throw;
        }
        samples_ += count;
    }

    std::size_t replicates() const { return replicates_.size(); }

    /// The error of the worst sensor.
    double attained_error() const override {
        double worst = 0;
        std::size_t first = 0;
        for (const Sensor& sensor : sensors_) {
            const std::size_t count = sensor.size();
            const std::vector<double> means = replicate_means(first, count);
            const std::vector<double> rare = rare_light(first, count);
            worst = std::max(worst, statistics::attained_error(statistics::estimate_readings(
                                        {means, count}, statistics::kStoppedConfidence, rare)));
            first += count;
        }
        return worst;
    }

    std::uint64_t rays() const {
        std::uint64_t rays = 0;
        for (const Replicate& replicate : replicates_) rays += replicate.sums.rays;
        return rays;
    }

    void require_valid() const {
        std::uint64_t invalid = 0;
        for (const Replicate& replicate : replicates_) invalid += replicate.sums.invalid;
        const double all =
            static_cast<double>(samples_in_all()) * static_cast<double>(replicates_[0].sums.sum.size());
        require_mostly_finite(invalid, all);
    }

    /// Replicates x readings of one sensor, luminance-weighted [lx].
    std::vector<double> replicate_means(std::size_t first, std::size_t count) const {
        std::vector<double> means;
        means.reserve(replicates_.size() * count);
        const auto known = estimator_.known_part();
        for (const Replicate& replicate : replicates_) {
            for (std::size_t j = first; j < first + count; ++j) {
                means.push_back(known[j].luminance() + replicate.mean(j).luminance());
            }
        }
        return means;
    }

    Rgb rgb(std::size_t reading) const {
        Rgb sum;
        for (const Replicate& replicate : replicates_) sum += replicate.mean(reading);
        return estimator_.known_part()[reading] + sum * (1 / static_cast<double>(replicates_.size()));
    }

    statistics::LargestContributions largest(std::size_t reading) const {
        std::vector<double> of_replicates;
        of_replicates.reserve(replicates_.size());
        for (const Replicate& replicate : replicates_)
            of_replicates.push_back(replicate.sums.largest[reading]);
        return statistics::largest_contributions(of_replicates);
    }

    /// Light that the readings of one sensor may lack [lx].
    std::vector<double> rare_light(std::size_t first, std::size_t count) const {
        std::vector<double> rare(count);
        for (std::size_t j = 0; j < count; ++j)
            rare[j] = statistics::rare_light(largest(first + j), samples_in_all());
        return rare;
    }

  private:
    struct Replicate {
        Replicate(math::RandomKey own_key, std::size_t readings) : key(own_key), sums(readings) {}

        void add(std::uint64_t count, const estimators::Estimator& estimator) {
            estimators::ReadingSums batch(sums.sum.size());
            estimator.run_batch({key, samples, count}, batch);
            sums += batch;
            samples += count;
        }
        Rgb mean(std::size_t reading) const { return sums.sum[reading] * (1 / static_cast<double>(samples)); }

        math::RandomKey key;
        estimators::ReadingSums sums;
        std::uint64_t samples = 0;
    };

    const estimators::Estimator& estimator_;
    std::span<const Sensor> sensors_;
    std::uint64_t granularity_;
    std::vector<Replicate> replicates_;
    std::uint64_t first_check_ = 1;
    std::uint64_t batch_ = 1;
    std::uint64_t samples_ = 0;  ///< of each replicate
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

/// The options with defaults for a run without targets.
RunOptions with_reading_target(RunOptions options) {
    if (!options.error && !options.time_s && !options.paths) {
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
    const std::vector<double> rare = campaign.rare_light(first, count);
    const std::vector<statistics::Estimate> estimates = estimate_readings(table, confidence, rare);
    result.summary = summarize_grid(table, confidence, rare);
    result.attained_error = statistics::attained_error(estimates);
    for (std::size_t j = 0; j < count; ++j)
        result.readings.push_back({estimates[j], campaign.rgb(first + j)});
    if (std::holds_alternative<Luminance>(sensor.kind)) {
        const auto ends = sight_ends.subspan(first, count);
        result.sub_points.assign(ends.begin(), ends.end());
    }
    return result;
}

/// " at 3 of 12 readings", where there are several.
std::string at_readings(std::size_t count, const SensorResult& sensor) {
    const std::size_t all = sensor.readings.size();
    return all == 1 ? "" : fmt::format(" at {} of {} readings", count, all);
}

/// Warns of readings whose light was found by few samples, or by none.
std::vector<std::string> rarity_warnings(const Campaign& campaign, std::span<const SensorResult> sensors) {
    std::vector<std::string> warnings;
    const std::uint64_t samples = campaign.samples_in_all();
    std::size_t first = 0;
    for (const SensorResult& sensor : sensors) {
        std::size_t dark = 0, uncertain = 0;
        for (std::size_t j = 0; j < sensor.readings.size(); ++j) {
            const statistics::Estimate& estimate = sensor.readings[j].estimate;
            const bool is_dark = estimate.value == 0;
            dark += is_dark;
            uncertain += !is_dark && rests_on_few_samples(estimate, campaign.largest(first + j), samples);
        }
        // As for the limit on the error, the worst readings of a large sensor do not count.
        const double tolerated =
            (1 - statistics::kReadingShare) * static_cast<double>(sensor.readings.size());
        if (dark > 0) {
            warnings.push_back(
                fmt::format("sensor \"{}\": {} samples found no light{}. If light gets there, the run needs "
                            "more paths or more "
                            "time to find it.",
                            sensor.sensor.name, samples, at_readings(dark, sensor)));
        }
        if (static_cast<double>(uncertain) > tolerated) {
            warnings.push_back(fmt::format(
                "sensor \"{}\": a few rare light paths make up much of the light, or of its error{}. More of "
                "them "
                "may be missing, so that the interval is too narrow: give the run more paths or more time.",
                sensor.sensor.name, at_readings(uncertain, sensor)));
        }
        first += sensor.readings.size();
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

/// Warns where the run has too few samples for the highlights of small lamps.
std::vector<std::string> sharp_light_warnings(const transport::SharpLight& sharp, std::uint64_t samples,
                                              const Scene& scene) {
    if (samples >= sharp.samples) return {};
    return {fmt::format(
        "object \"{}\" reflects or refracts small lamps sharply, and few samples find such light. The "
        "intervals may be too narrow with fewer than {:.2g} paths; this run had {}.",
        scene.object(sharp.object).name, static_cast<double>(sharp.samples), samples)};
}

void add_warnings(const Campaign& campaign, const Scene& scene, std::vector<std::string> of_scene,
                  const transport::SharpLight& sharp, RunResult& result) {
    const auto append = [&](std::vector<std::string> more) {
        std::ranges::move(more, std::back_inserter(result.warnings));
    };
    append(std::move(of_scene));
    append(rarity_warnings(campaign, result.sensors));
    append(sharp_light_warnings(sharp, result.samples, scene));
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
    Campaign campaign(*estimator, sensors, wanted.measurands.size(), options,
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
    std::size_t first = 0;
    for (const Sensor& sensor : sensors) {
        result.sensors.push_back(sensor_result(campaign, sensor, first, estimator->sight_ends(), confidence));
        first += sensor.size();
    }
    add_warnings(campaign, scene, std::move(of_scene), sharp, result);
    session.finish(result);
    return result;
}

}  // namespace stilb::run
