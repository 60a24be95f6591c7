// How readings are estimated. An estimator knows nothing of files, progress or stopping: it adds batches of
// samples to sums, and a run makes values with intervals of them. Only making one may use several threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/rgb.h"
#include "estimators/patch_light/patch_report.h"
#include "math/random.h"
#include "transport/receiver.h"

namespace stilb::estimators {

/// The unit of work: samples first ... first + count - 1 of the replicate that `key` stands for. What a batch
/// adds depends on these alone.
struct Batch {
    math::RandomKey key;
    std::uint64_t first = 0;
    std::uint64_t count = 0;
};

/// What batches of one replicate add up to. The value of a reading is known part + sum / samples.
struct ReadingSums {
    std::vector<Rgb> sum;         ///< one for each reading [lx or cd/m2, x samples]
    std::vector<double> largest;  ///< largest single contribution to each reading, before division
    std::uint64_t rays = 0;
    std::uint64_t invalid = 0;  ///< contributions that were not finite, left out

    explicit ReadingSums(std::size_t readings) : sum(readings), largest(readings) {}

    /// Adds a contribution to a reading.
    void add(std::size_t reading, const Rgb& contribution) {
        if (!contribution.is_finite()) {
            ++invalid;
            return;
        }
        sum[reading] += contribution;
        largest[reading] = std::max(largest[reading], contribution.luminance());
    }
};

class Estimator {
  public:
    virtual ~Estimator() = default;

    /// Adds a batch. Batches may run in parallel on different sums.
    virtual void run_batch(const Batch& batch, ReadingSums& sums) const = 0;
    /// The part of each reading that is known without sampling [lx or cd/m2].
    virtual std::span<const Rgb> known_part() const = 0;
    /// The number of samples of a batch is a multiple of this.
    virtual std::uint64_t batch_granularity() const = 0;
    /// Rays that one sample costs, roughly, over all readings: batches are made long or short by it.
    virtual double rays_per_sample() const = 0;
    /// What the method cannot make in this scene, for the user; empty where nothing is missing.
    virtual std::vector<std::string> warnings() const = 0;
    /// Where patches stand for surfaces.
    virtual std::optional<PatchReport> patch_report() const { return std::nullopt; }
};

}  // namespace stilb::estimators
