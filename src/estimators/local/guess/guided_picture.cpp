#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

#include "estimators/limits.h"
#include "estimators/local/connection.h"
#include "estimators/local/light_path_reception.h"
#include "estimators/local/local_picture.h"
#include "estimators/local/sub_points.h"

namespace stilb::estimators {
namespace {

/// Gathering rays from each sub-point, which has cost a camera path; and samples of direct light where lamps
/// may be partly hidden.
constexpr std::uint64_t kRays = 4;
constexpr std::uint64_t kDirectSamples = 4;
/// Points of the guess that are connected to a packet.
constexpr std::size_t kPoints = 32;
/// Vertices of the residual that are connected to a packet.
constexpr std::size_t kVertices = 12;
/// Pixels for each path of the residual, and the largest number of paths in a pass.
constexpr std::uint64_t kPixelsPerPath = 128;
constexpr std::uint64_t kMostPaths = 2048;

/// Points of the guess for the sub-points of a cell, chosen for some that are spread over it.
struct CellPoints {
    std::vector<SurfacePoint> spread;
    GuessPoints::Choice choice;

    /// Whether each receiver is near to one of these and faces alike. If not, what brings most of its light
    /// may be chosen rarely, and count much then: wall and floor see each other, but not themselves.
    bool is_for(std::span<const transport::Receiver> receivers, double k_per_m2) const {
        constexpr double parallel = 0.9, near = 0.25;  // connections vary little over a distance of k^-1/2
        return std::ranges::all_of(receivers, [&](const transport::Receiver& receiver) {
            return std::ranges::any_of(spread, [&](const SurfacePoint& other) {
                return dot(receiver.normal(), other.normal) > parallel &&
                       squared_length(receiver.position() - other.position) * k_per_m2 < near;
            });
        });
    }
};

class GuidedPicture final : public LocalPicture {
  public:
    GuidedPicture(const LocalTransport& transport, const Problem& problem, const GuidedLight& guide)
        : transport_(transport),
          guide_(guide),
          sub_points_(transport, problem, kDirectSamples),
          reception_(transport, problem, sub_points_),
          plan_{{problem.preparation_key.derived(PreparationStream::guided_picture)}, 0},
          points_of_(sub_points_.cells()) {}

    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        return std::make_unique<GuidedPass>(*this, pass);
    }

  private:
    class GuidedPass final : public PicturePass {
      public:
        GuidedPass(const GuidedPicture& picture, const Pass& pass)
            : picture_(picture),
              pass_(pass),
              pool_(picture.trace_residual(pass), picture.guide_.caster.center()),
              selection_point_(
                  math::SampleStream(pass.key.derived(PassStream::guess_points), pass.index, 4).next_two()),
              gather_points_(
                  gather_points(pass.key.derived(PassStream::guess_rays), kRays * pass.index, kRays)) {}

        void sample(const PixelBlock& block, Tally& sums) const override {
            const auto [even, glossy] = picture_.divide(picture_.sub_points_.of_block(block, pass_, sums));
            choose_near(pool_, even, picture_.guide_.k_per_m2(kPoints),
                        [&](const SubPointPacket& packet, const KernelChoice::Sums& near) {
                            receive(packet, near, sums);
                        });
            if (!glossy.empty())
                picture_.reception_.receive(glossy, {block.left, block.top}, light_paths(), pass_, sums);
        }

      private:
        /// Vertices of light paths, traced when they are needed.
        const NearNodePool& light_paths() const {
            std::call_once(are_traced_, [&] { light_paths_.emplace(picture_.reception_.trace(pass_)); });
            return *light_paths_;
        }

        /// Adds a sample of the indirect light of a packet whose receivers have a constant response.
        void receive(const SubPointPacket& packet, const KernelChoice::Sums& near, Tally& sums) const {
            const GuidedLight& guide = picture_.guide_;
            const std::vector<PointTile> tiles = guide.tiles(packet.receivers, kPoints);
            const double u =
                math::SampleStream(packet.key(pass_, PassStream::residual_selection), pass_.index).next();
            Connections(guide.caster, tiles, picture_.transport_.monitor, guide.guess.channels())
                .collect(pool_.select(near, kVertices, u), sums);
            gather(packet, tiles, sums);
        }

        /// Light of the guess for receivers of constant response.
        void gather(const SubPointPacket& packet, std::span<const PointTile> tiles, Tally& sums) const {
            const GuidedLight& guide = picture_.guide_;
            std::vector<std::array<double, 2>> shifts;
            for (const Pixel& pixel : packet.pixels) shifts.push_back(shift_of(pixel, pass_));
            const CellPoints& of_cell = picture_.points_of(packet.pixels[0]);
            std::optional<GuessPoints::Choice> own;
            if (!of_cell.is_for(packet.receivers, guide.points.k_per_m2(kPoints)))
                own = guide.points.all_sides(packet.receivers, kPoints);
            std::vector<EmittingPoint> points;
            guide.points.select(
                own ? *own : of_cell.choice,
                {fraction(selection_point_[0] + shifts[0][0]), fraction(selection_point_[1] + shifts[0][1])},
                points);
            for (const PointTile& tile : tiles) {
                connect_points(guide.caster, tile, points, sums, guide.guess.channels());
                const GatherLanes lanes(tile, shifts);
                GuessGather::Sums gathered;
                for (std::uint64_t i = 0; i < kRays; ++i)
                    guide.gather.add_round(tile, lanes, gather_points_[i],
                                           packet.key(pass_, PassStream::continued_rays),
                                           kRays * pass_.index + i, {{}, guide.points.split()}, gathered);
                guide.gather.flush(tile, gathered, 1. / kRays, sums);
            }
        }

        const GuidedPicture& picture_;
        Pass pass_;
        NearNodePool pool_;
        std::array<double, 2> selection_point_;
        std::vector<GatherPoint> gather_points_;  ///< of the rays
        mutable std::once_flag are_traced_;
        mutable std::optional<NearNodePool> light_paths_;
    };

    /// The parts of sub-points that receive light by the guess, and those that do so by light paths: gloss,
    /// and bent surfaces.
    struct Divided {
        std::vector<SubPointPacket> even, glossy;
    };
    Divided divide(std::span<const SubPointPacket> packets) const {
        Divided divided;
        for (const SubPointPacket& packet : packets) {
            SubPointPacket even{packet.first, {}, {}}, glossy{packet.first, {}, {}};
            for (std::size_t i = 0; i < packet.receivers.size(); ++i) {
                const GuidedLight::Divided parts = guide_.divide({&packet.receivers[i], 1});
                for (const transport::Receiver& part : parts.even)
                    even.receivers.push_back(part), even.pixels.push_back(packet.pixels[i]);
                for (const transport::Receiver& part : parts.general)
                    glossy.receivers.push_back(part), glossy.pixels.push_back(packet.pixels[i]);
            }
            if (!even.receivers.empty()) divided.even.push_back(std::move(even));
            if (!glossy.receivers.empty()) divided.glossy.push_back(std::move(glossy));
        }
        return divided;
    }

    const CellPoints& points_of(const Pixel& pixel) const {
        const std::size_t cell = sub_points_.cell_of(pixel);
        return points_of_.of(cell, [&] {
            const std::vector<transport::Receiver> receivers = sub_points_.of_cell(cell, plan_);
            CellPoints points{{}, guide_.points.all_sides(receivers, kPoints)};
            for (const transport::Receiver& receiver : receivers) points.spread.push_back(receiver.point());
            return points;
        });
    }

    std::vector<transport::LightVertex> trace_residual(const Pass& pass) const {
        const auto& [width, height] = sub_points_.tracing().camera.resolution;
        const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
        const std::uint64_t paths = paths_at_once(
            transport_.scene, std::clamp<std::uint64_t>(pixels / kPixelsPerPath, 16, kMostPaths));
        std::vector<transport::LightVertex> nodes = guide_.residual.trace(
            {pass.key.derived(PassStream::residual)}, pass.index * paths, (pass.index + 1) * paths);
        for (transport::LightVertex& node : nodes) node.flux_lm *= 1. / static_cast<double>(paths);
        return nodes;
    }

    /// Pixels of a 4 x 4 block take neighbouring directions in all passes of a replicate.
    static std::array<double, 2> shift_of(const Pixel& pixel, const Pass& pass) {
        const auto block = static_cast<std::uint64_t>(pixel.x / kPacketSide) << 32 |
                           static_cast<std::uint64_t>(pixel.y / kPacketSide);
        const auto random = math::SampleStream(pass.key.derived(PassStream::shift), block, 0).next_two();
        const auto row = static_cast<std::size_t>(pixel.y % kPacketSide),
                   column = static_cast<std::size_t>(pixel.x % kPacketSide);
        return gather_shift(random, row * kPacketSide + column);
    }

    const LocalTransport& transport_;
    const GuidedLight& guide_;
    SubPoints sub_points_;
    LightPathReception reception_;
    Pass plan_;  ///< its sub-points represent the cells'
    OfCells<CellPoints> points_of_;
};

}  // namespace

std::unique_ptr<const LocalPicture> make_guided_picture(const LocalTransport& transport,
                                                        const Problem& problem, const GuidedLight& guide) {
    return std::make_unique<GuidedPicture>(transport, problem, guide);
}

}  // namespace stilb::estimators
