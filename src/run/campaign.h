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
#include "run/possible_light.h"
#include "run/schedule.h"
#include "sensors/sensor.h"
#include "statistics/bias.h"
#include "statistics/interval.h"

namespace stilb::run {

/// How many replicates a run has, and how their errors follow.
struct ReplicatePlan {
    std::size_t replicates = 32;
    bool pools_errors = false;  ///< of readings side by side
    bool has_paces = false;     ///< packets that are sure enough take fewer samples (paces.h)
    Target target = Target::readings;

    /// Few replicates where all sensors are large grids: the points of a replicate then lie more evenly, and
    /// neighbours help with the errors (statistics/pooled_errors.h).
    static ReplicatePlan of(std::span<const Sensor> sensors, const RunOptions& options, bool lights_patches);
};

/// About the memory of a run of methods without patches for its readings, beside that of the scene and of a
/// guess of the light (kGuessBytes).
std::size_t memory_of_readings_bytes(std::span<const Sensor> sensors, const RunOptions& options);
inline constexpr std::size_t kGuessBytes = 150'000'000;

class GlareViews;

/// The sums of all replicates, and their progress. Keeps references to the estimator, to the sensors, which
/// may have no readings, to what their eyes see, and to the light that may be missed.
class Campaign final : public Work {
  public:
    /// `readings`: of all sensors. `key`: of all replicates. `least_samples`: of all replicates, before the
    /// first error estimate.
    Campaign(const estimators::Estimator& estimator, std::span<const Sensor> sensors, const GlareViews& glare,
             const PossibleLight& possible, std::size_t readings, math::RandomKey key,
             const ReplicatePlan& plan, std::uint64_t least_samples);

    std::uint64_t samples() const override { return samples_; }
    std::uint64_t samples_in_all() const override;
    std::uint64_t samples_for(std::uint64_t paths) const override;
    std::uint64_t most_samples() const override;
    std::uint64_t next_check() const override {
        return in_units(statistics::next_check(samples_, first_check_));
    }
    std::uint64_t most_at_once() const override { return batch_; }
    /// From some of the replicates on, where time does not suffice for all.
    bool has_result() const override;

    /// The same next samples of every replicate. Each strand's sums belong to one task: nothing depends on
    /// threads. Where the run is ended, unfinished batches are left out. Replicates of different length have
    /// the same expectation, and their spread still gives the error of their mean.
    void advance(std::uint64_t count) override;

    /// The error of the worst sensor.
    double attained_error() const override;
    bool is_decided() const override;
    bool is_beyond_reach(double error) const override;

    std::size_t replicates() const { return replicates_.size(); }
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
    Estimates estimates(const Sensor& sensor, std::size_t first, double confidence) const;
    std::vector<Rgb> rgb(std::size_t first, std::size_t count) const;

  private:
    /// A part of a replicate's samples with sums of its own, so that there is work for many threads.
    struct Strand {
        Strand(std::size_t readings, std::size_t packets) : sums(readings), taken(packets) {}

        void add(const estimators::Batch& batch, const estimators::Estimator& estimator);

        estimators::ReadingSums sums;
        std::vector<std::uint64_t> taken;  ///< samples, by packet
        std::uint64_t samples = 0;
    };
    struct Replicate {
        math::RandomKey key;
        std::vector<Strand> strands;
        std::vector<estimators::Pace> paces;  ///< of the packets; empty: all take all samples

        std::uint64_t samples() const;
        std::uint64_t taken(std::size_t packet) const;
        std::uint64_t comparisons() const;  ///< as ReadingSums'
        Rgb sum(std::size_t reading) const;
    };

    /// Rounded up to a number of samples of a replicate that its strands can share.
    std::uint64_t in_units(std::uint64_t samples) const;

    template <typename Visit>
    void for_each_strand(const Visit& visit) const {
        for (const Replicate& replicate : replicates_) std::ranges::for_each(replicate.strands, visit);
    }
    void set_paces();
    Rgb mean(const Replicate& replicate, std::size_t reading) const {
        return replicate.sum(reading) * (1 / static_cast<double>(replicate.taken(packets_[reading])));
    }
    /// The largest contribution to a sample of light that does not come straight from a lamp.
    double largest_reflected(std::size_t reading) const;
    std::vector<double> replicate_means(std::size_t first, std::size_t count) const;
    std::vector<statistics::LargestContributions> largest(std::size_t first, std::size_t count) const;
    /// Replicates x readings: by how much path tracing finds more light, luminance-weighted.
    std::vector<double> lacking(std::size_t first, std::size_t count) const;

    const estimators::Estimator& estimator_;
    std::span<const Sensor> sensors_;
    const GlareViews& glare_;
    const PossibleLight& possible_;
    std::vector<double> expected_largest_;
    bool pools_errors_, has_paces_;
    Target target_;
    std::vector<std::uint32_t> packets_;  ///< of the readings; one packet where the method has none
    std::uint64_t unit_ = 1;              ///< samples of a replicate are a multiple of this
    std::vector<Replicate> replicates_;
    std::uint64_t first_check_ = 1;
    std::uint64_t batch_ = 1;
    std::uint64_t samples_ = 0;  ///< of each replicate
};

}  // namespace stilb::run
