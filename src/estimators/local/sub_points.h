// Sub-points: the surfaces that a picture's pixels see, as receivers of light in packets of 4 x 4 pixels.
// Each pass draws them anew.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "estimators/camera_paths.h"
#include "estimators/estimator.h"
#include "estimators/local/local_transport.h"
#include "estimators/local/node_pool.h"

namespace stilb::estimators {

static_assert(kPacketSide * kPacketSide == kPacketWidth);

/// The sub-points of a packet.
struct SubPointPacket {
    Pixel first;                                 ///< top left
    std::vector<transport::Receiver> receivers;  ///< `reading`: the pixel's number in its block
    std::vector<Pixel> pixels;                   ///< of each receiver

    /// A key of the packet's position and the pass.
    math::RandomKey key(const Pass& pass, PassStream purpose) const;
};

/// Calls `receive` for each packet of a block, with the weights of the vertices for it. Packets of one plane
/// share the block's weights; others have their own.
using ReceiveNear = std::function<void(const SubPointPacket&, const KernelChoice::Sums&)>;
void choose_near(const NearNodePool& pool, std::span<const SubPointPacket> packets, double k_per_m2,
                 const ReceiveNear& receive);

/// Keeps references to the arguments' targets. Immutable.
class SubPoints {
  public:
    /// `direct_samples`: of direct light at each sub-point, where it has to be sampled.
    SubPoints(const LocalTransport& transport, const Problem& problem, std::uint64_t direct_samples);

    /// The packets of a block. Adds emission, light from outside and direct light to the block's pixels.
    std::vector<SubPointPacket> of_block(const PixelBlock& block, const Pass& pass, Tally& sums) const;

    // Planning: the picture is divided into cells.

    std::size_t cells() const { return cells_.size(); }
    std::size_t cell_of(const Pixel& pixel) const;
    /// Receivers that are spread over a cell, none where no surface is seen.
    std::vector<transport::Receiver> of_cell(std::size_t cell, const Pass& pass) const;

    const PictureTracing& tracing() const { return tracing_; }

  private:
    SubPointPacket of_packet(const PixelBlock& block, int left, int top, const Pass& pass, Tally& sums) const;
    void add_direct(const SubPointPacket& packet, const Pass& pass, Tally& sums) const;
    /// Appends the sub-point of a camera path; returns the emission seen.
    Rgb add(transport::Path& path, std::uint32_t reading, std::vector<transport::Receiver>& receivers) const;

    const LocalTransport& transport_;
    PictureTracing tracing_;
    std::uint64_t direct_samples_;
    int cell_edge_;
    std::vector<PixelBlock> cells_;
};

/// Values for the cells of a picture, each made when it is needed first: a method that is only tried needs
/// few of them. All queries may run in parallel.
template <typename Value>
class OfCells {
  public:
    explicit OfCells(std::size_t cells)
        : values_(cells), are_made_(std::make_unique<std::once_flag[]>(cells)) {}

    /// `make` depends on the cell alone, and runs in one thread.
    template <typename Make>
    const Value& of(std::size_t cell, const Make& make) const {
        std::call_once(are_made_[cell], [&] { values_[cell] = make(); });
        return values_[cell];
    }

  private:
    mutable std::vector<Value> values_;
    std::unique_ptr<std::once_flag[]> are_made_;
};

}  // namespace stilb::estimators
