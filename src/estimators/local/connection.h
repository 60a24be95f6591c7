// Connections of light vertices to all receivers, in packets of shadow rays with a common origin.
//
// Receiver x gets W f_r(y; in, y->x) w G response(x->y) from vertex y, with G = cos+ cos+ V / d^2 and the
// weight w of the bounded connection (theory T.1, T.1b and, with a BRDF at both ends, T.2; weights.h).
// Geometry is in single precision; sums over more than a short block of vertices are in double.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "estimators/estimator.h"
#include "estimators/local/point_tile.h"
#include "transport/light_path.h"

namespace stilb::estimators {

/// Keeps references to its arguments' targets. Immutable.
class Connections {
  public:
    /// An infinite k of a tile's receiver gives w = 1 there (plain local estimation). Vertices that path
    /// tracing cannot find (LightVertex::only_by_light) have w = 1 for any k.
    /// `channels`: null, or those of the tallies.
    Connections(const rays::RayCaster& caster, std::span<const PointTile> tiles,
                const Monitor& monitor = Monitor::none(), const transport::Channels* channels = nullptr)
        : caster_(caster), tiles_(tiles), monitor_(monitor), channels_(channels) {}

    /// Adds the contributions of the vertices to each receiver, and keeps the largest single ones. Counts
    /// rays. Throws Cancelled, with unfinished sums, where the monitor ends the run.
    void collect(std::span<const transport::LightVertex> nodes, Tally& sums) const;

  private:
    const rays::RayCaster& caster_;
    std::span<const PointTile> tiles_;
    const Monitor& monitor_;
    const transport::Channels* channels_;
};

/// A point that sends the same light in all directions, in single precision.
struct EmittingPoint {
    SegmentOrigin origin;
    /// Divides the k of the receivers' tile; 0: w = 1.
    float split = 1;
    std::array<float, kBands> coefficient{};  ///< luminance over density: receivers get it times w G
    int reflections = 1;                      ///< of the light, that at the point included
    std::uint32_t light = 0;                  ///< that it comes from, where there are no shares
    /// As those of a LightVertex.
    std::shared_ptr<const std::vector<Rgb>> shares = nullptr;
};
/// Adds the light of points to the receivers of a tile, whose responses must be constant. Counts rays.
/// `channels`: null, or those of the shares and of the tally.
void connect_points(const rays::RayCaster& caster, const PointTile& tile,
                    std::span<const EmittingPoint> points, Tally& sums, const transport::Channels* channels);

}  // namespace stilb::estimators
