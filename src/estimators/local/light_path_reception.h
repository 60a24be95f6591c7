// Indirect light of a picture's sub-points by light paths: connections with vertices chosen near them, and
// gathering rays (theory T.1b, T.2). A pass traces light paths of its own for the whole picture.
#pragma once

#include <span>
#include <vector>

#include "estimators/local/local_transport.h"
#include "estimators/local/node_pool.h"
#include "estimators/local/sub_points.h"

namespace stilb::estimators {

/// Keeps references to its arguments. Immutable.
class LightPathReception {
  public:
    LightPathReception(const LocalTransport& transport, const Problem& problem, const SubPoints& sub_points);

    /// The vertices of a pass.
    NearNodePool trace(const Pass& pass) const;
    /// Adds a sample of the light of packets in a block. `block_pixel`: any pixel of the block.
    void receive(std::span<const SubPointPacket> packets, const Pixel& block_pixel, const NearNodePool& pool,
                 const Pass& pass, Tally& sums) const;

  private:
    void receive(const SubPointPacket& packet, const NearNodePool& pool, const KernelChoice::Sums& near,
                 const Pass& pass, Tally& sums) const;
    /// The k of the cell around a pixel.
    double k_per_m2_of(const Pixel& pixel) const;

    const LocalTransport& transport_;
    const SubPoints& sub_points_;
    Pass plan_;  ///< its sub-points represent the cells'
    double area_m2_;
    std::uint64_t paths_, pilot_paths_;  ///< of a pass, and before all
    std::vector<transport::LightVertex> pilot_nodes_;
    OfCells<double> k_per_m2_;
};

}  // namespace stilb::estimators
