// The fan: light from the nodes of chains to all measuring points, in packets of rays with a common origin.
//
// From node y point x receives W f_r(y; in, y->x) w G, with G = cos+ cos+ V / d^2 and w of the kernel split
// (theory T.1 and T.1b). Geometry is in single precision; sums over more than a short block of nodes are in
// double.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "estimators/estimator.h"
#include "estimators/light_chain.h"
#include "estimators/packed_points.h"

namespace stilb {

/// The measuring points of a run, in packets of neighbours. Immutable.
class Fan {
  public:
    /// `k_per_m2` is the kernel split's constant of each point: infinity makes w = 1 (plain local
    /// estimation). Nodes that path tracing cannot make (ChainNode::only_by_light) have w = 1 whatever k is.
    Fan(const RayCaster& caster, std::span<const PackedPoint> points, std::span<const double> k_per_m2);

    /// Adds what the nodes send to each point, and keeps the largest single contributions. Counts rays.
    void collect(std::span<const ChainNode> nodes, ReadingSums& sums) const;

    /// Sixteen points, as a structure of arrays relative to the ray caster's centre.
    struct alignas(64) Tile {
        using Floats = std::array<float, kPacketWidth>;
        Floats x{}, y{}, z{};                       ///< the points themselves: G is theirs
        Floats lifted_x{}, lifted_y{}, lifted_z{};  ///< where segments end
        Floats normal_x{}, normal_y{}, normal_z{};  ///< 0 in lanes without a point
        Floats inverse_k{};
        std::array<std::uint32_t, kPacketWidth> reading{};
    };

  private:
    const RayCaster& caster_;
    std::vector<Tile> tiles_;
};

}  // namespace stilb
