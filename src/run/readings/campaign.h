// A run of readings: independent replicates that grow together.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "estimators/estimator.h"
#include "run/options.h"
#include "run/plan.h"
#include "run/readings/division.h"
#include "run/readings/possible_light.h"
#include "run/schedule.h"
#include "sensors/sensor.h"
#include "statistics/bias.h"
#include "statistics/interval.h"

namespace stilb::run {

/// About the memory of a run of methods without patches for its readings, beside that of the scene and of a
/// guess of the light (kGuessBytes).
std::size_t memory_of_readings_bytes(std::span<const Sensor> sensors, const RunOptions& options);
inline constexpr std::size_t kGuessBytes = 150'000'000;

class GlareViews;

/// The sums of all replicates, and their progress. Keeps references to the estimator, to the sensors, which
/// may have no readings, to what their eyes see, to the light that may be missed, to the division of light,
/// and to the state, which holds all that is done at any time.
class Campaign final : public Work {
  public:
    /// Begins or, where `state` has sums, continues a run of these readings, with as many in all. `part`: of
    /// its strands; the others stay as they are. `least_samples`: of all replicates, before the first error
    /// estimate. Throws std::invalid_argument where the state is of other readings, or a part has no complete
    /// plan.
    Campaign(const estimators::Estimator& estimator, std::span<const Sensor> sensors, const GlareViews& glare,
             const PossibleLight& possible, std::size_t readings, const LightDivision& division,
             RunState& state, const RunOptions& options, std::uint64_t least_samples, RunPart part = {});

    std::uint64_t samples() const override { return samples_; }
    std::uint64_t samples_in_all() const override;
    std::uint64_t samples_for(std::uint64_t paths) const override;
    std::uint64_t most_samples() const override;
    std::uint64_t next_check() const override { return check_after(samples_); }
    bool is_at_check() const override;
    /// Less where some strands are ahead of others: all get to the same point first.
    std::uint64_t most_at_once() const override;
    /// From some of the replicates on, where time does not suffice for all.
    bool has_result() const override;

    /// The same next samples of every replicate. Each strand's sums belong to one task: nothing depends on
    /// threads. Where the run is ended, unfinished batches are left out. Replicates of different length have
    /// the same expectation, and their spread still gives the error of their mean.
    void advance(std::uint64_t count) override;

    /// Makes the first samples of a whole run, until they have decided all that the plan of its parts needs,
    /// or all `paths` are made.
    void complete_plan(std::uint64_t paths);

    /// The error of the worst sensor.
    double attained_error() const override;
    bool is_decided() const override;
    bool is_beyond_reach(double error) const override;

    const RunPlan& plan() const { return state_.plan; }
    std::size_t replicates() const { return begun_.size(); }
    std::uint64_t rays() const;
    /// Throws as require_mostly_finite().
    void require_valid() const;

    // `first`, `count`: the readings of one sensor.

    struct Estimates {
        std::vector<statistics::Estimate> readings;
        /// Replicates x readings, luminance-weighted [lx or cd/m2].
        std::vector<double> replicate_means;
        std::size_t columns = 0;  ///< as statistics::ReplicateTable's
        std::vector<statistics::LargestContributions> largest;
        std::vector<std::uint64_t> samples;  ///< of all replicates
        /// Light that the readings may lack because it is rare [lx or cd/m2].
        std::vector<double> rare_light;
        std::optional<statistics::BiasBounds> bias;  ///< of methods on patches; the intervals contain it
    };
    /// `weights`: of the channels in the readings; without any, all that light brings. What is lacking, and
    /// the light of lamps that no sample has found, counts by the largest weight.
    Estimates estimates(const Sensor& sensor, std::size_t first, double confidence,
                        ChannelWeights weights = {}) const;
    std::vector<Rgb> rgb(std::size_t first, std::size_t count, ChannelWeights weights = {}) const;

  private:
    std::span<const estimators::Tally> strands_of(std::size_t replicate) const {
        return std::span(state_.tallies).subspan(replicate * plan().strands, plan().strands);
    }
    std::uint64_t samples_of(std::size_t replicate) const;
    std::uint64_t taken(std::size_t replicate, std::uint32_t packet) const;
    std::uint64_t comparisons_of(std::size_t replicate) const;  ///< as in Tally
    bool is_part() const { return part_.of > 1; }
    std::uint64_t check_after(std::uint64_t samples) const {
        return plan().in_units(statistics::next_check(samples, plan().first_check));
    }
    std::size_t packets() const;  ///< their number
    /// Completes the plan of a run that begins.
    void make_plan(std::size_t readings, std::uint64_t least_samples);
    void require_own_sums(std::size_t readings) const;
    void find_begun();
    void sample_strand(std::size_t strand, std::uint64_t count);

    /// Whether what is required in a light scene is decided, of the sensors that it names; ratings of glare
    /// are not waited for.
    bool is_decided_in(const LightDivision::State& state) const;

    template <typename Visit>
    void for_each_strand(const Visit& visit) const {
        for (const std::size_t replicate : begun_) std::ranges::for_each(strands_of(replicate), visit);
    }
    void set_paces();
    /// What needs no samples.
    Rgb known(std::size_t reading, ChannelWeights weights) const;
    /// The part of the light that samples have found which the weights leave, at most 1; 1 where that is
    /// none, unless they leave direct light alone, of which none is rare.
    double sampled_share(std::size_t reading, ChannelWeights weights) const;
    Rgb mean(std::size_t replicate, std::size_t reading, ChannelWeights weights) const;
    /// The largest contribution to a sample of light that does not come straight from a lamp.
    double largest_reflected(std::size_t reading) const;
    std::vector<double> replicate_means(std::size_t first, std::size_t count,
                                        ChannelWeights weights = {}) const;
    std::vector<statistics::LargestContributions> largest(std::size_t first, std::size_t count) const;
    /// Replicates x readings: by how much path tracing finds more light, luminance-weighted.
    std::vector<double> lacking(std::size_t first, std::size_t count) const;

    const estimators::Estimator& estimator_;
    std::span<const Sensor> sensors_;
    const GlareViews& glare_;
    const PossibleLight& possible_;
    std::vector<double> expected_largest_;
    bool targets_means_;
    RunPart part_;
    const LightDivision& division_;
    std::vector<std::uint32_t> packets_;  ///< of the readings; one packet where the method has none
    RunState& state_;
    std::vector<std::size_t> begun_;  ///< the replicates that have samples
    std::uint64_t samples_ = 0;       ///< of each replicate
};

}  // namespace stilb::run
