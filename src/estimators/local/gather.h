// The part of readings that gathering rays from the receivers estimate, in packets of neighbours.
#pragma once

#include <span>
#include <vector>

#include "estimators/estimator.h"
#include "estimators/local/point_tile.h"
#include "estimators/local/split_plan.h"
#include "transport/path_tracer.h"

namespace stilb::estimators {

/// Estimates, for every receiver x with its own k,
///
///     integral over the hemisphere of L_r(y, y->x) (1 - w) response(x->y) cos(theta_x) dw    (theory T.1b)
///
/// with w of weights.h. In a round every receiver of a packet sends out a ray about in proportion to
/// response x cosine, and two paths that go on from the point y that it meets serve all receivers of the
/// packet that see y: path reuse [Bekaert et al. 2002], by the balance heuristic over the rays that could
/// have met y.
///
/// Surfaces seen by mirrors and glass always have w = 0, because no light vertex on a specular surface can be
/// connected to x, and serve only the receiver whose ray it is; emission counts behind them only: the rest is
/// direct light. Keeps references to its arguments' targets.
class Gather {
  public:
    Gather(const rays::RayCaster& caster, const transport::PathTracer& tracer,
           std::span<const PointTile> tiles, std::span<const SplitPlan> plans,
           const Monitor& monitor = Monitor::none(), const transport::Channels* channels = nullptr)
        : caster_(caster),
          tracer_(tracer),
          tiles_(tiles),
          plans_(plans),
          monitor_(monitor),
          channels_(channels) {}

    /// One round per so many light paths of the batch as the plan says, with their weight. Throws Cancelled,
    /// with unfinished sums, where the monitor ends the run.
    void collect(const Batch& batch, Tally& sums) const;

  private:
    void trace_round(const PointTile& tile, math::RandomKey key, std::uint64_t round, double weight,
                     Tally& sums) const;
    /// `from`: where light arrives that is scattered at `hit`.
    void share_out(const rays::Hit& hit, const rays::Hit& from, const transport::LobeChoice& scattering,
                   const PointTile& tile, std::size_t own, math::SampleStream& stream, double weight,
                   Tally& sums) const;

    const rays::RayCaster& caster_;
    const transport::PathTracer& tracer_;
    std::span<const PointTile> tiles_;
    std::span<const SplitPlan> plans_;
    const Monitor& monitor_;
    const transport::Channels* channels_;  ///< null, or those of the tallies
};

}  // namespace stilb::estimators
