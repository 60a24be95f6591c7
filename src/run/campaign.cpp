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
    : estimator_(estimator), sensors_(sensors), granularity_(estimator.batch_granularity()) {
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
    const std::vector<double> means = replicate_means(first, count);
    Estimates all{statistics::estimate_readings({means, count}, confidence, rare_light(first, count)), {}};
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

std::vector<double> Campaign::lacking(std::size_t first, std::size_t count) const {
    std::vector<double> differences;
    for (const Replicate& replicate : replicates_) {
        const estimators::ReadingSums& sums = replicate.sums;
        if (sums.comparisons == 0) return {};
        for (std::size_t j = first; j < first + count; ++j)
            differences.push_back(sums.lacking[j].luminance() / static_cast<double>(sums.comparisons));
    }
    return differences;
}

std::vector<double> Campaign::rare_light(std::size_t first, std::size_t count) const {
    std::vector<double> rare(count);
    for (std::size_t j = 0; j < count; ++j)
        rare[j] = statistics::rare_light(largest(first + j), samples_in_all());
    return rare;
}

Rgb Campaign::rgb(std::size_t reading) const {
    Rgb sum;
    for (const Replicate& replicate : replicates_) sum += replicate.mean(reading);
    return estimator_.known_part()[reading] + sum * (1 / static_cast<double>(replicates_.size()));
}

statistics::LargestContributions Campaign::largest(std::size_t reading) const {
    std::vector<double> of_replicates;
    of_replicates.reserve(replicates_.size());
    for (const Replicate& replicate : replicates_) of_replicates.push_back(replicate.sums.largest[reading]);
    return statistics::largest_contributions(of_replicates);
}

}  // namespace stilb::run
