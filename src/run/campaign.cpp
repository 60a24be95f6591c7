#include "run/campaign.h"

#include <algorithm>

#include "base/parallel.h"
#include "run/glare/glare.h"
#include "run/paces.h"
#include "run/sensor_estimates.h"
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
/// Replicates of large grids alone, and the least number of readings of such a grid.
constexpr std::size_t kFewReplicates = 8, kLargeGrid = 64;
/// Samples of a replicate from which its packets' paces follow.
constexpr std::uint64_t kSamplesBeforePaces = 16;
constexpr double kReadingReserve = 2;  ///< paces.h
/// Light that the set-up has met is not expected any more at readings where so many samples find none: the
/// set-up has at most 1024 rays.
constexpr std::uint64_t kSamplesToRuleOut = 1 << 16;
/// Tasks that can run at the same time: strands of all replicates.
constexpr std::size_t kStrands = 32;
/// Readings times strands: with more of them, sums take gigabytes and much of the time.
constexpr std::size_t kMostSums = std::size_t{1} << 22;
/// The memory of a reading beside its sums: what is measured, its receiver and its result.
constexpr std::size_t kBytesOfReading = 950;

std::size_t strands_of_replicate(std::size_t replicates, std::size_t readings) {
    const std::size_t wanted = std::max<std::size_t>(1, kStrands / replicates);
    return std::clamp<std::size_t>(kMostSums / (readings * replicates), 1, wanted);
}

}  // namespace

ReplicatePlan ReplicatePlan::of(std::span<const Sensor> sensors, const RunOptions& options,
                                bool lights_patches) {
    const bool are_large_grids = !lights_patches && std::ranges::all_of(sensors, [](const Sensor& sensor) {
        return sensor.size() == 0 || (sensor.count() && sensor.size() >= kLargeGrid);
    });
    ReplicatePlan plan;
    plan.target = options.target;
    if (are_large_grids) {
        plan.replicates = kFewReplicates;
        plan.pools_errors = true;
        plan.has_paces = options.target == Target::readings;
    }
    if (options.replicates) plan.replicates = static_cast<std::size_t>(*options.replicates);
    return plan;
}

std::size_t memory_of_readings_bytes(std::span<const Sensor> sensors, const RunOptions& options) {
    std::size_t readings = 0;
    for (const Sensor& sensor : sensors) readings += sensor.size();
    if (readings == 0) return 0;
    const std::size_t replicates = ReplicatePlan::of(sensors, options, false).replicates;
    constexpr std::size_t bytes_of_sum = sizeof(Rgb) + sizeof(double) + sizeof(float);  // ReadingSums
    return readings *
           (kBytesOfReading + bytes_of_sum * replicates * strands_of_replicate(replicates, readings));
}

Campaign::Campaign(const estimators::Estimator& estimator, std::span<const Sensor> sensors,
                   const GlareViews& glare, const PossibleLight& possible, std::size_t readings,
                   math::RandomKey key, const ReplicatePlan& plan, std::uint64_t least_samples)
    : estimator_(estimator),
      sensors_(sensors),
      glare_(glare),
      possible_(possible),
      expected_largest_(estimator.expected_largest()),
      pools_errors_(plan.pools_errors),
      has_paces_(plan.has_paces),
      target_(plan.target),
      packets_(estimator.packets()) {
    if (packets_.empty()) {
        has_paces_ = false;
        packets_.resize(readings);
    }
    const std::size_t packets = *std::ranges::max_element(packets_) + std::size_t{1};
    const std::size_t strands = strands_of_replicate(plan.replicates, readings);
    unit_ = strands * estimator.batch_granularity();
    for (std::size_t r = 0; r < plan.replicates; ++r)
        replicates_.push_back({key.derived(r), std::vector<Strand>(strands, Strand(readings, packets)), {}});
    first_check_ = in_units(std::max(estimator.first_check(), samples_for(least_samples)));
    const double per_batch =
        kRaysPerRound / (static_cast<double>(plan.replicates) * estimator.rays_per_sample());
    while (2 * batch_ <= kLongestBatch && static_cast<double>(2 * batch_) <= per_batch) batch_ *= 2;
    batch_ = std::max(batch_ / unit_, std::uint64_t{1}) * unit_;
}

std::uint64_t Campaign::in_units(std::uint64_t samples) const {
    return (samples + unit_ - 1) / unit_ * unit_;
}

std::uint64_t Campaign::samples_in_all() const {
    std::uint64_t all = 0;
    for (const Replicate& replicate : replicates_) all += replicate.samples();
    return all;
}

std::uint64_t Campaign::samples_for(std::uint64_t paths) const {
    const std::uint64_t each = (paths + replicates_.size() - 1) / replicates_.size();
    return std::min(in_units(each), kMostSamples);
}

std::uint64_t Campaign::most_samples() const { return kMostSamples; }

bool Campaign::has_result() const {
    const auto begun = std::ranges::count_if(replicates_, &Replicate::samples);
    return static_cast<std::size_t>(begun) >= std::min(kLeastReplicates, replicates_.size());
}

void Campaign::Strand::add(const estimators::Batch& batch, const estimators::Estimator& estimator) {
    estimators::ReadingSums more(sums.sum.size());
    estimator.run_batch(batch, more);
    sums += more;
    samples += batch.count;
    for (std::size_t packet = 0; packet < taken.size(); ++packet)
        taken[packet] += batch.of_packet(packet).count;
}

std::uint64_t Campaign::Replicate::samples() const {
    std::uint64_t all = 0;
    for (const Strand& strand : strands) all += strand.samples;
    return all;
}

std::uint64_t Campaign::Replicate::taken(std::size_t packet) const {
    std::uint64_t all = 0;
    for (const Strand& strand : strands) all += strand.taken[packet];
    return all;
}

std::uint64_t Campaign::Replicate::comparisons() const {
    std::uint64_t all = 0;
    for (const Strand& strand : strands) all += strand.sums.comparisons;
    return all;
}

Rgb Campaign::Replicate::sum(std::size_t reading) const {
    Rgb all;
    for (const Strand& strand : strands) all += strand.sums.sum[reading];
    return all;
}

void Campaign::advance(std::uint64_t count) {
    const std::size_t strands = replicates_[0].strands.size();
    const std::uint64_t each = count / strands;
    if (has_paces_ && replicates_[0].paces.empty() && samples_ >= kSamplesBeforePaces) set_paces();
    try {
        parallel_for(replicates_.size() * strands, [&](std::size_t task) {
            Replicate& replicate = replicates_[task / strands];
            const std::size_t s = task % strands;
            replicate.strands[s].add({{replicate.key}, samples_ + s * each, each, replicate.paces}, estimator_);
        });
    } catch (const Cancelled&) {
        if (has_result()) std::erase_if(replicates_, [](const Replicate& r) { return r.samples() == 0; });
        throw;
    }
    samples_ += count;
}

void Campaign::set_paces() {
    std::vector<std::size_t> readings;
    for (const Sensor& sensor : sensors_) readings.push_back(sensor.size());
    const std::vector<double> means = replicate_means(0, packets_.size());
    for (std::size_t r = 0; r < replicates_.size(); ++r)
        replicates_[r].paces =
            paces_of(r, {means, packets_.size()}, packets_, readings, samples_, kReadingReserve);
}

double Campaign::attained_error() const {
    if (target_ == Target::mean)
        return attained_error_of_means(sensors_,
                                       estimate_all(*this, sensors_, statistics::kStoppedConfidence));
    double worst = 0;
    std::size_t first = 0;
    for (const Sensor& sensor : sensors_) {
        if (sensor.size() == 0) continue;
        const Estimates all = estimates(sensor, first, statistics::kStoppedConfidence);
        worst = std::max(worst, statistics::attained_error(all.readings));
        first += sensor.size();
    }
    return worst;
}

bool Campaign::is_decided() const {
    if (!sensors::has_requirements(sensors_)) return false;
    std::vector<SensorEstimates> all = estimate_all(*this, sensors_, statistics::kVerdictConfidence);
    glare_.rate(all, statistics::kVerdictConfidence);
    for (std::size_t s = 0; s < all.size(); ++s) {
        const std::vector<RatedRequirement> rated = rate(sensors_[s].requirements, all[s]);
        if (std::ranges::any_of(rated, &RatedRequirement::is_undecided)) return false;
    }
    return true;
}

bool Campaign::is_beyond_reach(double error) const {
    std::size_t first = 0;
    for (const Sensor& sensor : sensors_) {
        if (sensor.size() == 0) continue;
        const auto bias = estimates(sensor, first, statistics::kStoppedConfidence).bias;
        if (bias && bias->relative_at_least > error) return true;
        first += sensor.size();
    }
    return false;
}

std::uint64_t Campaign::rays() const {
    std::uint64_t rays = 0;
    for_each_strand([&](const Strand& strand) { rays += strand.sums.rays; });
    return rays;
}

void Campaign::require_valid() const {
    std::uint64_t invalid = 0;
    std::size_t readings = 0;
    for_each_strand([&](const Strand& strand) {
        invalid += strand.sums.invalid;
        readings = strand.sums.sum.size();
    });
    const double all = static_cast<double>(samples_in_all()) * static_cast<double>(readings);
    require_mostly_finite(invalid, all);
}

Campaign::Estimates Campaign::estimates(const Sensor& sensor, std::size_t first, double confidence) const {
    const std::size_t count = sensor.size();
    const auto known_part = estimator_.known_part().subspan(first, count);
    Estimates all;
    if (const auto columns_and_rows = sensor.count(); pools_errors_ && columns_and_rows)
        all.columns = static_cast<std::size_t>((*columns_and_rows)[0]);
    all.replicate_means = replicate_means(first, count);
    all.largest = largest(first, count);
    for (std::size_t j = 0; j < count; ++j) {
        statistics::LargestContributions known = all.largest[j];
        std::uint64_t samples = 0;
        for (const Replicate& replicate : replicates_) samples += replicate.taken(packets_[first + j]);
        const bool is_ruled_out = known.overall == 0 && samples >= kSamplesToRuleOut;
        if (!expected_largest_.empty() && !is_ruled_out)
            known.overall = std::max(known.overall, expected_largest_[first + j]);
        all.samples.push_back(samples);
        double rare_light = statistics::rare_light(known, samples);
        // That all samples agree is no proof where some could have found more light.
        if (all.largest[j].overall > 0 || known_part[j].luminance() > 0)
            rare_light = std::max(
                rare_light, possible_.missed(sensor.measurand(j), largest_reflected(first + j), samples));
        all.rare_light.push_back(rare_light);
    }
    all.readings =
        statistics::estimate_readings({all.replicate_means, count, all.columns}, confidence, all.rare_light);
    const std::vector<double> differences = lacking(first, count);
    if (differences.empty()) return all;
    std::vector<double> values;
    for (const statistics::Estimate& estimate : all.readings) values.push_back(estimate.value);
    all.bias = statistics::bias_bounds({differences, count}, values);
    for (std::size_t j = 0; j < count; ++j)
        all.readings[j] = statistics::widened(all.readings[j], all.bias->of_readings[j]);
    return all;
}

double Campaign::largest_reflected(std::size_t reading) const {
    double largest = 0;
    for_each_strand([&](const Strand& strand) { largest = std::max(largest, strand.sums.largest[reading]); });
    return largest;
}

std::vector<double> Campaign::replicate_means(std::size_t first, std::size_t count) const {
    std::vector<double> means(replicates_.size() * count);
    const auto known = estimator_.known_part();
    parallel_for(replicates_.size(), [&](std::size_t r) {
        for (std::size_t j = 0; j < count; ++j) {
            means[r * count + j] = known[first + j].luminance() + mean(replicates_[r], first + j).luminance();
        }
    });
    return means;
}

std::vector<double> Campaign::lacking(std::size_t first, std::size_t count) const {
    const auto is_compared = [](const Replicate& replicate) { return replicate.comparisons() > 0; };
    if (!std::ranges::all_of(replicates_, is_compared)) return {};
    std::vector<double> differences(replicates_.size() * count);
    parallel_for(replicates_.size(), [&](std::size_t r) {
        const auto comparisons = static_cast<double>(replicates_[r].comparisons());
        for (const Strand& strand : replicates_[r].strands) {
            // A cancelled batch may leave some without.
            if (strand.sums.comparisons == 0) continue;
            for (std::size_t j = 0; j < count; ++j)
                differences[r * count + j] += strand.sums.lacking[first + j].luminance() / comparisons;
        }
    });
    return differences;
}

std::vector<Rgb> Campaign::rgb(std::size_t first, std::size_t count) const {
    std::vector<Rgb> all(count);
    const auto known = estimator_.known_part();
    parallel_for_parts(count, [&](std::size_t begin, std::size_t end) {
        for (const Replicate& replicate : replicates_) {
            for (std::size_t j = begin; j < end; ++j) all[j] += mean(replicate, first + j);
        }
        for (std::size_t j = begin; j < end; ++j)
            all[j] = known[first + j] + all[j] * (1 / static_cast<double>(replicates_.size()));
    });
    return all;
}

std::vector<statistics::LargestContributions> Campaign::largest(std::size_t first, std::size_t count) const {
    std::vector<statistics::LargestContributions> all(count);
    const std::size_t width = replicates_.size() * replicates_[0].strands.size();
    parallel_for_parts(count, [&](std::size_t begin, std::size_t end) {
        // Strand by strand, in the order of the memory.
        std::vector<double> of_strands((end - begin) * width);
        std::size_t s = 0;
        for_each_strand([&](const Strand& strand) {
            const double* own = &strand.sums.largest[first];
            const float* direct = &strand.sums.largest_direct[first];
            for (std::size_t j = begin; j < end; ++j)
                of_strands[(j - begin) * width + s] = std::max(own[j], double{direct[j]});
            ++s;
        });
        for (std::size_t j = begin; j < end; ++j)
            all[j] = statistics::largest_contributions({&of_strands[(j - begin) * width], width});
    });
    return all;
}

}  // namespace stilb::run
