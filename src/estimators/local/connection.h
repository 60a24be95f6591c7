// Connections of light vertices to all receivers, in packets of shadow rays with a common origin.
//
// Receiver x gets W f_r(y; in, y->x) w G response(x->y) from vertex y, with G = cos+ cos+ V / d^2 and the
// weight w of the bounded connection (theory T.1, T.1b and, with a BRDF at both ends, T.2; weights.h).
// Geometry is in single precision; sums over more than a short block of vertices are in double.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "estimators/estimator.h"
#include "estimators/local/kernel_choice.h"
#include "estimators/local/point_tile.h"
#include "transport/light_path.h"

namespace stilb::estimators {

/// Keeps references to its arguments' targets. Immutable.
class Connections {
  public:
    /// An infinite k of a tile's receiver gives w = 1 there (plain local estimation). Vertices that path
    /// tracing cannot find (LightVertex::only_by_light) have w = 1 for any k.
    Connections(const rays::RayCaster& caster, std::span<const PointTile> tiles,
                const Monitor& monitor = Monitor::none())
        : caster_(caster), tiles_(tiles), monitor_(monitor) {}

    /// Adds the contributions of the vertices to each receiver, and keeps the largest single ones. Counts
    /// rays. Throws Cancelled, with unfinished sums, where the monitor ends the run.
    void collect(std::span<const transport::LightVertex> nodes, ReadingSums& sums) const;

  private:
    const rays::RayCaster& caster_;
    std::span<const PointTile> tiles_;
    const Monitor& monitor_;
};

/// A point that sends the same light in all directions, in single precision.
struct EmittingPoint {
    SegmentOrigin origin;
    /// Divides the k of the receivers' tile; 0: w = 1.
    float split = 1;
    std::array<float, kBands> coefficient{};  ///< luminance over density: receivers get it times w G
};
/// Adds the light of few points to the receivers of a tile, whose responses must be constant. Counts rays.
void connect_points(const rays::RayCaster& caster, const PointTile& tile,
                    std::span<const EmittingPoint> points, ReadingSums& sums);

// Selection of fewer vertices from more light paths: connections cost most, so they go to vertices that lie
// evenly.

/// Vertices along a space-filling curve, surfaces of different orientation one after another.
class NodePool {
  public:
    explicit NodePool(const std::vector<transport::LightVertex>& nodes);

    std::size_t size() const { return nodes_.size(); }

    /// Selects about `count` vertices that represent all without bias: for every function of a vertex the
    /// expectation over u (uniform in [0, 1)) of the sum over the selected ones, with their fluxes, is the
    /// sum over all.
    ///
    /// Systematic sampling in proportion to importance, the reflected flux or, of gloss, more: the selected
    /// vertices carry about equal fluxes and lie as evenly as the flux does, so that a kernel which varies
    /// slowly over surfaces is summed with far less variance than over as many vertices of independent light
    /// paths.
    std::vector<transport::LightVertex> select(std::size_t count, double u) const;

  private:
    std::vector<transport::LightVertex> nodes_;
    std::vector<double> passed_;  ///< importance up to each vertex, its own included
};

/// Vertices that are chosen for groups of receivers, by their importance as in NodePool and by the kernel.
class NearNodePool {
  public:
    NearNodePool(const std::vector<transport::LightVertex>& nodes, const Vec3& center);

    KernelChoice::Sums sums_for(std::span<const transport::Receiver> receivers, double k_per_m2) const {
        return choice_.sums_for(receivers, k_per_m2);
    }
    /// As NodePool's.
    std::vector<transport::LightVertex> select(const KernelChoice::Sums& sums, std::size_t count,
                                               double u) const;

  private:
    std::vector<transport::LightVertex> nodes_;
    KernelChoice choice_;
};

}  // namespace stilb::estimators
