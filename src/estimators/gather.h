// The part of illuminances that rays from the measuring points bring in, in packets of neighbours.
#pragma once

#include <span>
#include <vector>

#include "estimators/estimator.h"
#include "estimators/path_tracer.h"
#include "estimators/point_tile.h"
#include "estimators/split_plan.h"

namespace stilb {

/// Estimates, for every point x with its own k,
///
///     integral over the hemisphere of L_r(y, y->x) (1 - w) cos(theta_x) dw      (theory T.1b)
///
/// with w of kernel_split.h. In a round every point of a packet sends out a cosine-distributed ray, and what
/// goes on from the place y that it meets serves all points of the packet that see y: path reuse [Bekaert et
/// al. 2002], by the balance heuristic over the rays that could have met y.
///
/// What is seen by mirrors has w = 0 always, because no node on a mirror can be joined to x, and serves the
/// ray's own point only; emission counts behind mirrors only: the rest is direct light. Keeps what its
/// arguments refer to.
class Gather {
  public:
    Gather(const RayCaster& caster, const PathTracer& tracer, std::span<const PackedPoint> points,
           std::span<const PointTile> tiles, std::span<const SplitPlan> plans, int max_reflections)
        : caster_(caster),
          tracer_(tracer),
          points_(points),
          tiles_(tiles),
          plans_(plans),
          max_reflections_(max_reflections) {}

    /// A round for so many chains of the batch as the plan says, weighing as much as these.
    void collect(const Batch& batch, ReadingSums& sums) const;

  private:
    void trace_round(std::size_t tile, RandomKey key, std::uint64_t round, double weight,
                     ReadingSums& sums) const;
    void share_out(const Hit& hit, const PointTile& tile, std::size_t own, SampleStream& stream,
                   double weight, ReadingSums& sums) const;

    const RayCaster& caster_;
    const PathTracer& tracer_;
    std::span<const PackedPoint> points_;
    std::span<const PointTile> tiles_;
    std::span<const SplitPlan> plans_;
    int max_reflections_;
};

}  // namespace stilb
