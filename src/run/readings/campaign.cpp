#include "run/readings/campaign.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/parallel.h"
#include "run/glare/glare.h"
#include "run/paces.h"
#include "run/readings/sensor_estimates.h"
#include "run/streams.h"
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

std::size_t memory_of_readings_bytes(std::span<const Sensor> sensors, const RunOptions& options) {
    std::size_t readings = 0;
    for (const Sensor& sensor : sensors) readings += sensor.size();
    if (readings == 0) return 0;
    const std::size_t replicates = RunPlan::of(sensors, options, false).replicates;
    constexpr std::size_t bytes_of_sum = sizeof(Rgb) + sizeof(double) + sizeof(float);  // Tally
    return readings *
           (kBytesOfReading + bytes_of_sum * replicates * strands_of_replicate(replicates, readings));
}

Campaign::Campaign(const estimators::Estimator& estimator, std::span<const Sensor> sensors,
                   const GlareViews& glare, const PossibleLight& possible, std::size_t readings,
                   const LightDivision& division, RunState& state, const RunOptions& options,
                   std::uint64_t least_samples, RunPart part)
    : estimator_(estimator),
      sensors_(sensors),
      glare_(glare),
      possible_(possible),
      expected_largest_(estimator.expected_largest()),
      targets_means_(is_error_of_means(options)),
      part_(part),
      division_(division),
      packets_(estimator.packets()),
      state_(state) {
    const bool has_packets = !packets_.empty();
    if (!has_packets) packets_.resize(readings);
    if (plan().technique.empty()) {
        state_.plan.has_paces = plan().has_paces && has_packets;
        make_plan(readings, least_samples);
    }
    if (is_part() && !plan().is_complete())
        throw std::invalid_argument("the plan of a part of a run is not complete");
    if (state_.tallies.empty())
        state_.tallies.assign(plan().units(), estimators::Tally(readings, packets(), division_.count()));
    require_own_sums(readings);
    samples_ = std::numeric_limits<std::uint64_t>::max();
    for (std::size_t strand = 0; strand < plan().units(); ++strand) {
        if (part_.has(strand)) samples_ = std::min(samples_, state_.tallies[strand].samples * plan().strands);
    }
    find_begun();
}

std::size_t Campaign::packets() const { return *std::ranges::max_element(packets_) + std::size_t{1}; }

void Campaign::require_own_sums(std::size_t readings) const {
    const auto is_own = [&](const estimators::Tally& tally) {
        return tally.sum.size() == readings && tally.taken.size() == packets() &&
               tally.parts.size() == readings * division_.count() &&
               (tally.lacking.empty() || tally.lacking.size() == readings);
    };
    const bool are_own_paces =
        std::ranges::all_of(plan().paces, [&](const auto& paces) { return paces.size() == packets(); });
    if (state_.tallies.size() != plan().units() || !std::ranges::all_of(state_.tallies, is_own) ||
        !are_own_paces)
        throw std::invalid_argument("the sums are those of other readings");
}

void Campaign::find_begun() {
    begun_.clear();
    for (std::size_t r = 0; r < plan().replicates; ++r) {
        if (samples_of(r) > 0) begun_.push_back(r);
    }
}

void Campaign::make_plan(std::size_t readings, std::uint64_t least_samples) {
    RunPlan& plan = state_.plan;
    plan.technique = estimator_.technique();
    plan.strands = strands_of_replicate(plan.replicates, readings * (1 + division_.count()));
    plan.unit = plan.strands * estimator_.batch_granularity();
    plan.first_check = plan.in_units(std::max(estimator_.first_check(), samples_for(least_samples)));
    const double per_batch =
        kRaysPerRound / (static_cast<double>(plan.replicates) * estimator_.rays_per_sample());
    std::uint64_t batch = 1;
    while (2 * batch <= kLongestBatch && static_cast<double>(2 * batch) <= per_batch) batch *= 2;
    plan.most_at_once = std::max(batch / plan.unit, std::uint64_t{1}) * plan.unit;
}

std::uint64_t Campaign::samples_in_all() const {
    std::uint64_t all = 0;
    for_each_strand([&](const estimators::Tally& strand) { all += strand.samples; });
    return all;
}

std::uint64_t Campaign::samples_for(std::uint64_t paths) const {
    const std::uint64_t each = (paths + plan().replicates - 1) / plan().replicates;
    return std::min(plan().in_units(each), kMostSamples);
}

std::uint64_t Campaign::most_at_once() const {
    std::uint64_t most = plan().most_at_once;
    for (std::size_t strand = 0; strand < plan().units(); ++strand) {
        const std::uint64_t samples = state_.tallies[strand].samples * plan().strands;
        if (part_.has(strand) && samples > samples_) most = std::min(most, samples - samples_);
    }
    return most;
}

std::uint64_t Campaign::most_samples() const { return kMostSamples; }

bool Campaign::is_at_check() const {
    return samples_ > 0 && !is_part() && check_after(samples_ - plan().unit) == samples_;
}

bool Campaign::has_result() const {
    if (is_part()) return true;  // its sums
    return begun_.size() >= std::min(kLeastReplicates, plan().replicates);
}

std::uint64_t Campaign::samples_of(std::size_t replicate) const {
    std::uint64_t all = 0;
    for (const estimators::Tally& strand : strands_of(replicate)) all += strand.samples;
    return all;
}

std::uint64_t Campaign::taken(std::size_t replicate, std::uint32_t packet) const {
    std::uint64_t all = 0;
    for (const estimators::Tally& strand : strands_of(replicate)) all += strand.taken[packet];
    return all;
}

std::uint64_t Campaign::comparisons_of(std::size_t replicate) const {
    std::uint64_t all = 0;
    for (const estimators::Tally& strand : strands_of(replicate)) all += strand.comparisons;
    return all;
}

Rgb Campaign::known(std::size_t reading, ChannelWeights weights) const {
    if (weights.empty()) return estimator_.known_part()[reading];
    const std::size_t readings = estimator_.known_part().size();
    Rgb all;
    for (std::size_t c = 0; c < weights.size(); ++c)
        all += weights[c] * estimator_.known_parts()[c * readings + reading];
    return all;
}

double Campaign::sampled_share(std::size_t reading, ChannelWeights weights) const {
    double whole = 0, own = 0, weight = 0;
    for (const std::size_t r : begun_) {
        whole += mean(r, reading, {}).luminance();
        own += mean(r, reading, weights).luminance();
    }
    for (const Rgb& of_channel : weights) weight = std::max(weight, of_channel.max());
    if (own > 0 && whole > 0) return std::min(1.0, own / (weight * whole));
    return division_.is_direct(weights) ? 0 : 1;
}

Rgb Campaign::mean(std::size_t replicate, std::size_t reading, ChannelWeights weights) const {
    Rgb all;
    for (const estimators::Tally& strand : strands_of(replicate)) {
        if (weights.empty()) all += strand.sum[reading];
        for (std::size_t c = 0; c < weights.size(); ++c)
            all += weights[c] * strand.parts[c * strand.sum.size() + reading];
    }
    return all * (1 / static_cast<double>(taken(replicate, packets_[reading])));
}

void Campaign::sample_strand(std::size_t strand, std::uint64_t count) {
    estimators::Tally& tally = state_.tallies[strand];
    const std::size_t replicate = strand / plan().strands;
    const std::uint64_t first = samples_ + strand % plan().strands * count;
    // A run that was interrupted has made the samples of some strands (most_at_once()).
    if (!part_.has(strand) || tally.samples * plan().strands > samples_) return;
    const math::RandomKey key = key_of_seed(plan().seed).derived(RunStream::readings).derived(replicate);
    estimators::Batch batch{{key}, first, count, {}};
    if (!plan().paces.empty()) batch.paces = plan().paces[replicate];
    estimators::Tally more(tally.sum.size(), tally.taken.size(), division_.count());
    estimator_.run_batch(batch, more);
    more.count(batch);
    tally += more;
}

void Campaign::advance(std::uint64_t count) {
    try {
        parallel_for(plan().units(),
                     [&](std::size_t strand) { sample_strand(strand, count / plan().strands); });
    } catch (const Cancelled&) {
        find_begun();
        throw;
    }
    find_begun();
    samples_ += count;
    if (plan().has_paces && plan().paces.empty() && samples_ >= kSamplesBeforePaces) set_paces();
}

void Campaign::complete_plan(std::uint64_t paths) {
    const std::uint64_t last = samples_for(paths);
    while (!plan().is_complete() && samples_ < last)
        advance(std::min(most_at_once(), std::min(last, next_check()) - samples_));
    state_.plan.has_paces = !plan().paces.empty();
}

void Campaign::set_paces() {
    std::vector<std::size_t> readings;
    for (const Sensor& sensor : sensors_) readings.push_back(sensor.size());
    const std::vector<double> means = replicate_means(0, packets_.size());
    for (std::size_t r = 0; r < plan().replicates; ++r)
        state_.plan.paces.push_back(
            paces_of(r, {means, packets_.size()}, packets_, readings, samples_, kReadingReserve));
}

double Campaign::attained_error() const {
    if (is_part()) return std::numeric_limits<double>::infinity();
    if (targets_means_)
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
    if (is_part() || !sensors::has_requirements(sensors_)) return false;
    std::vector<SensorEstimates> all = estimate_all(*this, sensors_, statistics::kVerdictConfidence);
    glare_.rate(all, statistics::kVerdictConfidence);
    for (std::size_t s = 0; s < all.size(); ++s) {
        const std::vector<RatedRequirement> rated = rate(sensors_[s].requirements, all[s]);
        if (std::ranges::any_of(rated, &RatedRequirement::is_undecided)) return false;
    }
    return std::ranges::all_of(division_.states(),
                               [&](const LightDivision::State& state) { return is_decided_in(state); });
}

bool Campaign::is_decided_in(const LightDivision::State& state) const {
    const std::vector<std::string>& judged = state.light_scene.sensors;
    if (judged.empty()) return true;
    const std::vector<SensorEstimates> all =
        estimate_all(*this, sensors_, statistics::kVerdictConfidence, state.weights);
    for (std::size_t s = 0; s < all.size(); ++s) {
        if (sensors_[s].rates_glare() || std::ranges::find(judged, sensors_[s].name) == judged.end())
            continue;
        const std::vector<RatedRequirement> rated = rate(sensors_[s].requirements, all[s]);
        if (std::ranges::any_of(rated, &RatedRequirement::is_undecided)) return false;
    }
    return true;
}

bool Campaign::is_beyond_reach(double error) const {
    if (is_part()) return false;
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
    for_each_strand([&](const estimators::Tally& strand) { rays += strand.rays; });
    return rays;
}

void Campaign::require_valid() const {
    std::uint64_t invalid = 0;
    std::size_t readings = 0;
    for_each_strand([&](const estimators::Tally& strand) {
        invalid += strand.invalid;
        readings = strand.sum.size();
    });
    const double all = static_cast<double>(samples_in_all()) * static_cast<double>(readings);
    require_mostly_finite(invalid, all);
}

Campaign::Estimates Campaign::estimates(const Sensor& sensor, std::size_t first, double confidence,
                                        ChannelWeights weights) const {
    const std::size_t count = sensor.size();
    const auto known_part = estimator_.known_part().subspan(first, count);
    Estimates all;
    if (const auto columns_and_rows = sensor.count(); plan().pools_errors && columns_and_rows)
        all.columns = static_cast<std::size_t>((*columns_and_rows)[0]);
    all.replicate_means = replicate_means(first, count, weights);
    double largest_weight = weights.empty() ? 1 : 0;
    for (const Rgb& weight : weights) largest_weight = std::max(largest_weight, weight.max());
    all.largest = largest(first, count);
    for (std::size_t j = 0; j < count; ++j) {
        statistics::LargestContributions known = all.largest[j];
        std::uint64_t samples = 0;
        for (const std::size_t r : begun_) samples += taken(r, packets_[first + j]);
        const bool is_ruled_out = known.overall == 0 && samples >= kSamplesToRuleOut;
        if (!expected_largest_.empty() && !is_ruled_out)
            known.overall = std::max(known.overall, expected_largest_[first + j]);
        all.samples.push_back(samples);
        double rare_light = statistics::rare_light(known, samples);
        // That all samples agree is no proof where some could have found more light.
        if (all.largest[j].overall > 0 || known_part[j].luminance() > 0)
            rare_light = std::max(
                rare_light, possible_.missed(sensor.measurand(j), largest_reflected(first + j), samples));
        if (!weights.empty()) rare_light *= largest_weight * sampled_share(first + j, weights);
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
    for_each_strand(
        [&](const estimators::Tally& strand) { largest = std::max(largest, strand.largest[reading]); });
    return largest;
}

std::vector<double> Campaign::replicate_means(std::size_t first, std::size_t count,
                                              ChannelWeights weights) const {
    std::vector<double> means(begun_.size() * count);
    parallel_for(begun_.size(), [&](std::size_t r) {
        for (std::size_t j = 0; j < count; ++j)
            means[r * count + j] =
                known(first + j, weights).luminance() + mean(begun_[r], first + j, weights).luminance();
    });
    return means;
}

std::vector<double> Campaign::lacking(std::size_t first, std::size_t count) const {
    if (!std::ranges::all_of(begun_, [&](std::size_t r) { return comparisons_of(r) > 0; })) return {};
    std::vector<double> differences(begun_.size() * count);
    parallel_for(begun_.size(), [&](std::size_t r) {
        const auto comparisons = static_cast<double>(comparisons_of(begun_[r]));
        for (const estimators::Tally& strand : strands_of(begun_[r])) {
            // A cancelled batch may leave some without.
            if (strand.comparisons == 0) continue;
            for (std::size_t j = 0; j < count; ++j)
                differences[r * count + j] += strand.lacking[first + j].luminance() / comparisons;
        }
    });
    return differences;
}

std::vector<Rgb> Campaign::rgb(std::size_t first, std::size_t count, ChannelWeights weights) const {
    std::vector<Rgb> all(count);
    parallel_for_parts(count, [&](std::size_t begin, std::size_t end) {
        for (const std::size_t replicate : begun_) {
            for (std::size_t j = begin; j < end; ++j) all[j] += mean(replicate, first + j, weights);
        }
        for (std::size_t j = begin; j < end; ++j)
            all[j] = known(first + j, weights) + all[j] * (1 / static_cast<double>(begun_.size()));
    });
    return all;
}

std::vector<statistics::LargestContributions> Campaign::largest(std::size_t first, std::size_t count) const {
    std::vector<statistics::LargestContributions> all(count);
    const std::size_t width = begun_.size() * plan().strands;
    parallel_for_parts(count, [&](std::size_t begin, std::size_t end) {
        // Strand by strand, in the order of the memory.
        std::vector<double> of_strands((end - begin) * width);
        std::size_t s = 0;
        for_each_strand([&](const estimators::Tally& strand) {
            const double* own = &strand.largest[first];
            const float* direct = &strand.largest_direct[first];
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
