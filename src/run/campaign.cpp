#include "run/campaign.h"

#include <algorithm>

#include "base/parallel.h"
#include "stilb/error.h"

namespace stilb::run {
namespace {

/// Rays of a batch over all replicates: about a second of work, so that the time limit is kept.
constexpr double kRaysPerRound = 3e7;
constexpr std::uint64_t kLongestBatch = 1 << 16;
/// Samples of a replicate: Sobol' indices have 32 bits.
constexpr std::uint64_t kMostSamples = std::uint64_t{1} << 31;
/// Replicates that a result needs.
constexpr std::size_t kLeastReplicates = 8;

}  // namespace

Campaign::Campaign(const estimators::Estimator& estimator, std::span<const Sensor> sensors,
                   std::size_t readings, math::RandomKey key, const RunOptions& options,
                   std::uint64_t least_samples)
    : estimator_(estimator),
      sensors_(sensors),
      granularity_(estimator.batch_granularity()),
      expected_largest_(estimator.expected_largest()) {
    const auto count = static_cast<std::size_t>(options.replicates);
    replicates_.reserve(count);
    for (std::size_t r = 0; r < count; ++r) {
        replicates_.emplace_back(key.derived(r), readings);
    }
    first_check_ = std::max(estimator.first_check(), samples_for(least_samples));
    const double per_batch = kRaysPerRound / (options.replicates * estimator.rays_per_sample());
    while (2 * batch_ <= kLongestBatch && static_cast<double>(2 * batch_) <= per_batch) batch_ *= 2;
    batch_ = std::max(batch_ / granularity_, std::uint64_t{1}) * granularity_;
}

std::uint64_t Campaign::samples_in_all() const {
    std::uint64_t all = 0;
    for (const Replicate& replicate : replicates_) all += replicate.samples;
    return all;
}

std::uint64_t Campaign::samples_for(std::uint64_t paths) const {
    const auto divided_up = [](std::uint64_t x, std::uint64_t y) { return (x + y - 1) / y; };
    const std::uint64_t each = divided_up(paths, replicates_.size());
    return std::min(divided_up(each, granularity_) * granularity_, kMostSamples);
}

std::uint64_t Campaign::most_samples() const { return kMostSamples; }

bool Campaign::has_result() const {
    const auto begun = std::ranges::count_if(replicates_, &Replicate::samples);
    return static_cast<std::size_t>(begun) >= std::min(kLeastReplicates, replicates_.size());
}

void Campaign::Replicate::add(std::uint64_t count, const estimators::Estimator& estimator) {
    estimators::ReadingSums batch(sums.sum.size());
    estimator.run_batch({key, samples, count}, batch);
    sums += batch;
    samples += count;
}

void Campaign::advance(std::uint64_t count) {
    try {
        parallel_for(replicates_.size(), [&](std::size_t r) { replicates_[r].add(count, estimator_); });
    } catch (const Cancelled&) {
        if (has_result()) std::erase_if(replicates_, [](const Replicate& r) { return r.samples == 0; });
        throw;
    }
    samples_ += count;
}

double Campaign::attained_error() const {
    double worst = 0;
    std::size_t first = 0;
    for (const Sensor& sensor : sensors_) {
        const Estimates all = estimates(first, sensor.size(), statistics::kStoppedConfidence);
        worst = std::max(worst, statistics::attained_error(all.readings));
        first += sensor.size();
    }
    return worst;
}

bool Campaign::is_beyond_reach(double error) const {
    std::size_t first = 0;
    for (const Sensor& sensor : sensors_) {
        const auto bias = estimates(first, sensor.size(), statistics::kStoppedConfidence).bias;
        if (bias && bias->relative_at_least > error) return true;
        first += sensor.size();
    }
    return false;
}

std::uint64_t Campaign::rays() const {
    std::uint64_t rays = 0;
    for (const Replicate& replicate : replicates_) rays += replicate.sums.rays;
    return rays;
}

void Campaign::require_valid() const {
    std::uint64_t invalid = 0;
    for (const Replicate& replicate : replicates_) invalid += replicate.sums.invalid;
    const double all =
        static_cast<double>(samples_in_all()) * static_cast<double>(replicates_[0].sums.sum.size());
    require_mostly_finite(invalid, all);
}

Campaign::Estimates Campaign::estimates(std::size_t first, std::size_t count, double confidence) const {
    Estimates all;
    all.replicate_means = replicate_means(first, count);
    all.largest = largest(first, count);
    for (std::size_t j = 0; j < count; ++j) {
        statistics::LargestContributions known = all.largest[j];
        if (!expected_largest_.empty()) known.overall = std::max(known.overall, expected_largest_[first + j]);
        all.rare_light.push_back(statistics::rare_light(known, samples_in_all()));
    }
    all.readings = statistics::estimate_readings({all.replicate_means, count}, confidence, all.rare_light);
    const std::vector<double> differences = lacking(first, count);
    if (differences.empty()) return all;
    std::vector<double> values;
    for (const statistics::Estimate& estimate : all.readings) values.push_back(estimate.value);
    all.bias = statistics::bias_bounds({differences, count}, values);
    for (std::size_t j = 0; j < count; ++j)
        all.readings[j] = statistics::widened(all.readings[j], all.bias->of_readings[j]);
    return all;
}

std::vector<double> Campaign::replicate_means(std::size_t first, std::size_t count) const {
    std::vector<double> means(replicates_.size() * count);
    const auto known = estimator_.known_part();
    parallel_for(replicates_.size(), [&](std::size_t r) {
        for (std::size_t j = 0; j < count; ++j) {
            means[r * count + j] = known[first + j].luminance() + replicates_[r].mean(first + j).luminance();
        }
    });
    return means;
}

std::vector<double> Campaign::lacking(std::size_t first, std::size_t count) const {
    const auto is_compared = [](const Replicate& replicate) { return replicate.sums.comparisons > 0; };
    if (!std::ranges::all_of(replicates_, is_compared)) return {};
    std::vector<double> differences(replicates_.size() * count);
    parallel_for(replicates_.size(), [&](std::size_t r) {
        const estimators::ReadingSums& sums = replicates_[r].sums;
        for (std::size_t j = 0; j < count; ++j) {
            differences[r * count + j] =
                sums.lacking[first + j].luminance() / static_cast<double>(sums.comparisons);
        }
    });
    return differences;
}

std::vector<Rgb> Campaign::rgb(std::size_t first, std::size_t count) const {
    std::vector<Rgb> all(count);
    const auto known = estimator_.known_part();
    parallel_for_parts(count, [&](std::size_t begin, std::size_t end) {
        for (const Replicate& replicate : replicates_) {
            for (std::size_t j = begin; j < end; ++j) all[j] += replicate.mean(first + j);
        }
        for (std::size_t j = begin; j < end; ++j)
            all[j] = known[first + j] + all[j] * (1 / static_cast<double>(replicates_.size()));
    });
    return all;
}

std::vector<statistics::LargestContributions> Campaign::largest(std::size_t first, std::size_t count) const {
    std::vector<statistics::LargestContributions> all(count);
    const std::size_t width = replicates_.size();
    parallel_for_parts(count, [&](std::size_t begin, std::size_t end) {
        // Replicate by replicate, in the order of the memory.
        std::vector<double> of_replicates((end - begin) * width);
        for (std::size_t r = 0; r < width; ++r) {
            const double* own = &replicates_[r].sums.largest[first];
            for (std::size_t j = begin; j < end; ++j) of_replicates[(j - begin) * width + r] = own[j];
        }
        for (std::size_t j = begin; j < end; ++j)
            all[j] = statistics::largest_contributions({&of_replicates[(j - begin) * width], width});
    });
    return all;
}

}  // namespace stilb::run
