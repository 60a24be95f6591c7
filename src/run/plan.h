// What a run decides before its samples count, and the sums of a run of readings so far: values that another
// run continues, in parts or at another time. (The sums of a picture: pictures/picture_sums.h.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "estimators/tally.h"
#include "run/options.h"
#include "sensors/sensor.h"

namespace stilb::run {

/// Runs of one plan add the same sums, whatever ends them, and also where each of them makes a part.
struct RunPlan {
    std::string technique;  ///< Estimator::technique()
    std::uint64_t seed = 1;
    std::size_t replicates = 32;
    /// Of readings or pixels side by side. Neighbours help only where their samples are independent of each
    /// other: light that is stored on patches is not.
    bool pools_errors = false;
    bool has_paces = false;  ///< packets or cells that are sure enough take fewer samples (paces.h)
    /// Of each replicate the paces of its packets or cells. Empty before they are decided.
    std::vector<std::vector<estimators::Pace>> paces = {};

    // Of readings alone.

    /// Parts of a replicate's samples with sums of their own, so that there is work for many threads.
    std::size_t strands = 1;
    std::uint64_t unit = 1;         ///< samples of a replicate are a multiple of this
    std::uint64_t first_check = 1;  ///< samples of a replicate before the first error estimate
    std::uint64_t most_at_once = 1;

    /// Few replicates where all sensors are large grids: the points of a replicate then lie more evenly, and
    /// neighbours help with the errors (statistics/pooled_errors.h).
    static RunPlan of(std::span<const Sensor> sensors, const RunOptions& options, bool lights_patches);

    /// Whether all is decided: a part of a run cannot see what decides the paces.
    bool is_complete() const { return !technique.empty() && (!has_paces || !paces.empty()); }
    std::size_t units() const { return replicates * strands; }
    /// Rounded up to a number of samples of a replicate that its strands can share.
    std::uint64_t in_units(std::uint64_t samples) const { return (samples + unit - 1) / unit * unit; }

    void write(ByteWriter& bytes) const;
    static RunPlan read(ByteReader& bytes);
    bool operator==(const RunPlan&) const = default;
};

/// The strands number `number`, `number` + `of`, `number` + 2 `of` ... of a run, counted over all replicates;
/// or the replicates of a picture with these numbers.
struct RunPart {
    std::size_t number = 0, of = 1;

    bool has(std::size_t strand) const { return strand % of == number; }
};

/// Whether a run adds samples, or gives the result of those that there are.
enum class Samples { as_asked, no_more };

/// Throws InputError where the run has no such part, or no number of paths.
void require_part(const RunOptions& options, const RunPart& part);

/// A run between two of its batches.
struct RunState {
    RunPlan plan;
    std::vector<estimators::Tally> tallies;  ///< of the strands, replicate by replicate; or none

    /// The seeds of runs of the same plan, but for seed and paces, whose samples are among the sums. Such a
    /// state has a result, but cannot be continued.
    std::vector<std::uint64_t> more_seeds = {};

    /// Adds the strands that another part of the run has made, or the samples of other seeds. Throws
    /// std::invalid_argument for a run of another plan, and where both have made the same samples.
    void merge(RunState other);

    std::vector<std::uint64_t> seeds() const;
    /// Of all replicates, as RunSummary.
    std::uint64_t samples() const;
    std::size_t begun() const;  ///< strands with samples

    void write(ByteWriter& bytes) const;
    static RunState read(ByteReader& bytes);

  private:
    void merge_part(RunState part);
    void merge_seeds(RunState other);
};

}  // namespace stilb::run
