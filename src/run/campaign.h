// A run of readings: independent replicates that grow together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "estimators/estimator.h"
#include "run/options.h"
#include "run/schedule.h"
#include "sensors/sensor.h"
#include "statistics/bias.h"
#include "statistics/interval.h"

namespace stilb::run {

/// The sums of all replicates, and their progress. Keeps references to the estimator and the sensors.
class Campaign final : public Work {
  public:
    /// `readings`: of all sensors. `key`: of all replicates. `least_samples`: of all replicates, before the
    /// first error estimate.
    Campaign(const estimators::Estimator& estimator, std::span<const Sensor> sensors, std::size_t readings,
             math::RandomKey key, const RunOptions& options, std::uint64_t least_samples);

    std::uint64_t samples() const override { return samples_; }
    std::uint64_t samples_in_all() const override;
    std::uint64_t samples_for(std::uint64_t paths) const override;
    std::uint64_t most_samples() const override;
    std::uint64_t next_check() const override { return statistics::next_check(samples_, first_check_); }
    std::uint64_t most_at_once() const override { return batch_; }
    /// From some of the replicates on, where time does not suffice for all.
    bool has_result() const override;

    /// The same next samples of every replicate. Each replicate's sums belong to one task: nothing depends on
    /// threads. Where the run is ended, unfinished batches are left out. Replicates of different length have
    /// the same expectation, and their spread still gives the error of their mean.
    void advance(std::uint64_t count) override;

    /// The error of the worst sensor.
    double attained_error() const override;
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
        std::vector<statistics::LargestContributions> largest;
        /// Light that the readings may lack because it is rare [lx or cd/m2].
        std::vector<double> rare_light;
        std::optional<statistics::BiasBounds> bias;  ///< of methods on patches; the intervals contain it
    };
    Estimates estimates(std::size_t first, std::size_t count, double confidence) const;
    std::vector<Rgb> rgb(std::size_t first, std::size_t count) const;

  private:
    struct Replicate {
        Replicate(math::RandomKey own_key, std::size_t readings) : key(own_key), sums(readings) {}

        void add(std::uint64_t count, const estimators::Estimator& estimator);
        Rgb mean(std::size_t reading) const { return sums.sum[reading] * (1 / static_cast<double>(samples)); }

        math::RandomKey key;
        estimators::ReadingSums sums;
        std::uint64_t samples = 0;
    };

    std::vector<double> replicate_means(std::size_t first, std::size_t count) const;
    std::vector<statistics::LargestContributions> largest(std::size_t first, std::size_t count) const;
    /// Replicates x readings: by how much path tracing finds more light, luminance-weighted.
    std::vector<double> lacking(std::size_t first, std::size_t count) const;

    const estimators::Estimator& estimator_;
    std::span<const Sensor> sensors_;
    std::uint64_t granularity_;
    std::vector<double> expected_largest_;
    std::vector<Replicate> replicates_;
    std::uint64_t first_check_ = 1;
    std::uint64_t batch_ = 1;
    std::uint64_t samples_ = 0;  ///< of each replicate
};

}  // namespace stilb::run
