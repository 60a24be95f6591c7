// The part of illuminances that rays from the measuring points bring in, in packets of neighbours.
#pragma once

#include <span>
#include <vector>

#include "estimators/estimator.h"
#include "estimators/packed_points.h"
#include "estimators/path_tracer.h"
#include "estimators/split_plan.h"

namespace stilb {

/// Estimates, for every point x with its own k,
///
///     integral over the hemisphere of L_r(y, y->x) (1 - w) cos(theta_x) dw      (theory T.1b)
///
/// with w of kernel_split.h, by cosine-distributed rays from x to y. The points of a packet share their
/// directions, so that the rays are nearly parallel; what goes on from y is each point's own. What is seen by
/// mirrors has w = 0 always, because no node on a mirror can be joined to x; emission counts behind mirrors
/// only: the rest is direct light. Keeps references.
class Gather {
  public:
    Gather(const RayCaster& caster, const PathTracer& tracer, const PackedPoints& points,
           std::span<const SplitPlan> plans, int max_reflections)
        : caster_(caster),
          tracer_(tracer),
          points_(points),
          plans_(plans),
          max_reflections_(max_reflections) {}

    /// A ray of each point for so many chains of the batch as its plan says, weighing as much as these.
    void collect(const Batch& batch, ReadingSums& sums) const;

  private:
    void trace_packet(std::size_t first, RandomKey key, std::uint64_t index, double weight,
                      ReadingSums& sums) const;

    const RayCaster& caster_;
    const PathTracer& tracer_;
    const PackedPoints& points_;
    std::span<const SplitPlan> plans_;
    int max_reflections_;
};

}  // namespace stilb
