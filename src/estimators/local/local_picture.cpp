#include "estimators/local/local_picture.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "base/parallel.h"
#include "estimators/camera_paths.h"
#include "estimators/local/connection.h"
#include "estimators/local/gather.h"
#include "estimators/local/split_plan.h"

namespace stilb::estimators {
namespace {

/// Light paths of a pass, and the number of them for one selected path's vertices in a packet. The more paths
/// are traced, the more evenly the selected vertices lie; tracing costs less than a hundredth of a large
/// picture's pass.
constexpr std::uint64_t kPathsPerPass = 4096;
constexpr std::uint64_t kPathsPerSelected = 256;
/// With a guess: points of it and vertices of the residual that are connected to a packet, and pixels for
/// each path of the residual.
constexpr std::size_t kPointsOfPass = 8;
constexpr std::size_t kVerticesOfPass = 6;
constexpr std::uint64_t kPixelsPerPath = 128;
/// Planning rays from each sub-point.
constexpr unsigned kPilotRays = 4;

/// Edge of a packet in pixels.
constexpr int kPacketSide = 4;
static_assert(kPacketSide * kPacketSide == kPacketWidth);

class SubPointPicture final : public LocalPicture {
  public:
    /// `guide`: may be null.
    SubPointPicture(const LocalTransport& transport, const Problem& problem, const GuidedLight* guide)
        : transport_(transport),
          guide_(guide),
          tracing_(problem, transport.lights),
          cell_edge_(cell_edge_of(tracing_.camera.resolution)),
          points_of_(guide ? cells().size() : 0),
          k_per_m2_(plan(problem)) {}

    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        return std::make_unique<LocalPass>(*this, pass);
    }

  private:
    enum Purpose : std::uint64_t {
        kWalks = kPixels + 1,
        kPackets,
        kSelection,
        kGather,
        kPilot,
        kPlan,
        kShift,
        kGeneral
    };

    class LocalPass final : public PicturePass {
      public:
        LocalPass(const SubPointPicture& picture, const Pass& pass)
            : picture_(picture),
              pass_(pass),
              pool_(picture.trace_paths(pass)),
              gather_point_(gather_point(pass.key.derived(kGather), pass.index)) {}

        std::uint64_t sample(const PixelBlock& block, std::span<Rgb> pixels) const override {
            ReadingSums sums(pixels.size());
            for (int top = 0; top < block.height; top += kPacketSide) {
                for (int left = 0; left < block.width; left += kPacketSide)
                    sample_packet(block, left, top, sums);
            }
            std::copy(sums.sum.begin(), sums.sum.end(), pixels.begin());
            return sums.invalid;
        }

      private:
        void sample_packet(const PixelBlock& block, int left, int top, ReadingSums& sums) const {
            const PixelBlock packet{block.left + left, block.top + top,
                                    std::min(kPacketSide, block.width - left),
                                    std::min(kPacketSide, block.height - top)};
            std::vector<std::uint32_t> readings;
            for (int y = 0; y < packet.height; ++y) {
                for (int x = 0; x < packet.width; ++x) {
                    readings.push_back(static_cast<std::uint32_t>((top + y) * block.width + left + x));
                }
            }
            const std::vector<Pixel> pixels = pixels_of(packet);
            std::vector<transport::Receiver> receivers;
            std::vector<double> k_per_m2;
            std::vector<std::array<double, 2>> shifts;
            std::vector<math::SampleStream> streams;
            receivers.reserve(kPacketWidth);
            CameraPaths started = picture_.tracing_.start_paths(pixels, pass_);
            for (const auto& [pixel, luminance_cd_m2] : started.outside)
                sums.add(readings[pixel], luminance_cd_m2);
            for (std::size_t i = 0; i < started.paths.size(); ++i) {
                const std::size_t pixel = started.pixels[i];
                sums.add(readings[pixel],
                         picture_.add_sub_point(started.paths[i], readings[pixel], receivers));
                k_per_m2.resize(receivers.size(), picture_.k_per_m2_[picture_.cell_of(pixels[pixel])]);
                shifts.resize(receivers.size(), shift_of(pixels[pixel], pass_));
                streams.resize(receivers.size(), started.paths[i].stream);
            }
            if (receivers.empty()) return;
            // The packet's random numbers: those of its first pixel's position.
            const math::RandomKey key = pass_.key.derived(kPackets).derived(
                static_cast<std::uint64_t>(packet.left) << 32 | static_cast<std::uint64_t>(packet.top));
            transport::DirectLight::TileLight direct{};
            picture_.transport_.direct.add_all(receivers, streams, direct);
            for (std::size_t i = 0; i < receivers.size(); ++i) sums.add(receivers[i].reading(), direct[i]);
            if (picture_.guide_) {
                receive_guided(receivers, {key, pass_.index}, shifts,
                               picture_.cell_of(pixels[started.pixels[0]]), sums);
            } else {
                picture_.receive(receivers, k_per_m2, pool_, {key, pass_.index}, sums);
            }
        }

        /// As receive(), with the guess.
        void receive_guided(std::span<const transport::Receiver> receivers, const Pass& own,
                            std::span<const std::array<double, 2>> shifts, std::size_t cell,
                            ReadingSums& sums) const {
            const GuidedLight& guide = *picture_.guide_;
            const GuidedLight::Divided divided = guide.divide(receivers);
            const std::vector<PointTile> even = guide.tiles(divided.even, kPointsOfPass);
            const std::vector<PointTile> general = guide.tiles(divided.general, kPointsOfPass);
            const double u = math::SampleStream(own.key.derived(kSelection), own.index).next();
            const std::vector<transport::LightVertex> nodes = pool_.select(kVerticesOfPass, u);
            Connections(guide.caster, even, picture_.transport_.monitor).collect(nodes, sums);
            Connections(guide.caster, general, picture_.transport_.monitor).collect(nodes, sums);
            std::vector<EmittingPoint> points;
            guide.points.select(
                picture_.points_of_[cell], kPointsOfPass,
                {fraction(gather_point_[0] + shifts[0][0]), fraction(gather_point_[1] + shifts[0][1])},
                points);
            for (const PointTile& tile : even) {
                connect_points(guide.caster, tile, points, sums);
                GuessGather::Sums gathered;
                guide.gather.add_round(tile, GatherLanes(tile, shifts), gather_point_,
                                       own.key.derived(kGather), own.index, gathered);
                GuessGather::flush(tile, gathered, sums);
            }
            for (const PointTile& tile : general)
                guide.gather.add_general_round(tile, own.key.derived(kGeneral), own.index, sums);
        }

        const SubPointPicture& picture_;
        Pass pass_;
        NodePool pool_;
        std::array<double, 3> gather_point_;
    };

    std::vector<transport::LightVertex> trace_paths(const Pass& pass) const {
        if (!guide_)
            return transport_.trace_light_paths(pass.key.derived(kWalks), pass.index * kPathsPerPass,
                                                (pass.index + 1) * kPathsPerPass);
        const auto& [width, height] = tracing_.camera.resolution;
        const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
        const std::uint64_t paths = std::clamp<std::uint64_t>(pixels / kPixelsPerPath, 16, kPathsPerPass);
        std::vector<transport::LightVertex> nodes =
            guide_->residual.trace(pass.key.derived(kWalks), pass.index * paths, (pass.index + 1) * paths);
        for (transport::LightVertex& node : nodes) node.flux_lm *= 1. / static_cast<double>(paths);
        return nodes;
    }

    /// Pixels of a 4 x 4 block take neighbouring directions in all passes of a replicate.
    static std::array<double, 2> shift_of(const Pixel& pixel, const Pass& pass) {
        const auto block = static_cast<std::uint64_t>(pixel.x / kPacketSide) << 32 |
                           static_cast<std::uint64_t>(pixel.y / kPacketSide);
        const auto random = math::SampleStream(pass.key.derived(kShift), block, 0).next_two();
        return gather_shift(
            random, static_cast<std::size_t>(pixel.y % kPacketSide * kPacketSide + pixel.x % kPacketSide));
    }

    std::size_t cell_of(const Pixel& pixel) const {
        const int cells_per_row = (tracing_.camera.resolution[0] + cell_edge_ - 1) / cell_edge_;
        const int cell = pixel.y / cell_edge_ * cells_per_row + pixel.x / cell_edge_;
        return static_cast<std::size_t>(cell);
    }

    /// Appends the sub-point of a camera path; returns the emission seen.
    Rgb add_sub_point(transport::Path& path, std::uint32_t reading,
                      std::vector<transport::Receiver>& receivers) const {
        const bool meets_surface = transport_.tracer.follow_to_scattering(path);
        const Rgb emission = path.luminance_cd_m2;
        if (!meets_surface || path.reflections_left == 0) return emission;
        receivers.emplace_back(reading,
                               transport::SubPoint{path.hit, path.outgoing, path.throughput,
                                                   tracing_.max_reflections - path.reflections_left},
                               tracing_.scene.material(path.hit.material));
        return emission;
    }

    /// Adds a sample of a packet's indirect light.
    void receive(std::span<const transport::Receiver> receivers, std::span<const double> k_per_m2,
                 const NodePool& pool, const Pass& pass, ReadingSums& sums) const {
        const std::vector<PointTile> tiles =
            tiles_of(receivers, k_per_m2, tracing_.caster, tracing_.max_reflections);
        const double u = math::SampleStream(pass.key.derived(kSelection), pass.index).next();
        std::vector<transport::LightVertex> nodes = pool.select(pool.size() / kPathsPerSelected + 1, u);
        for (transport::LightVertex& vertex : nodes) vertex.flux_lm *= 1.0 / kPathsPerPass;
        Connections(tracing_.caster, tiles, transport_.monitor).collect(nodes, sums);
        if (!transport_.gathers) return;
        const std::vector<SplitPlan> plans(receivers.size(), {0, 1});
        Gather(tracing_.caster, transport_.tracer, tiles, plans)
            .collect({pass.key.derived(kGather), pass.index, 1}, sums);
    }

    /// The edge of cells with a k of their own, in pixels: planning must not take long beside the first pass.
    static int cell_edge_of(const std::array<int, 2>& resolution) {
        constexpr std::size_t most_cells = 4096;
        int edge = kBlockSize;
        while (blocks_of(resolution, {edge, edge}, edge).size() > most_cells) edge *= 2;
        return edge;
    }

    /// A k for each cell, from a packet of sub-points spread over it.
    std::vector<PixelBlock> cells() const {
        return blocks_of(tracing_.camera.resolution, {cell_edge_, cell_edge_}, cell_edge_);
    }
    std::vector<double> plan(const Problem& problem) {
        const std::vector<PixelBlock> cells = this->cells();
        std::vector<double> k_per_m2(cells.size(), std::numeric_limits<double>::infinity());
        if (transport_.split == Split::none) return k_per_m2;
        const math::RandomKey key = problem.preparation_key;
        const std::vector<transport::LightVertex> nodes =
            transport_.trace_light_paths(key.derived(kPilot), 0, kPilotPaths);
        const PilotLight pilot{nodes,
                               kPilotPaths,
                               {},
                               surface_area_m2(tracing_.scene),
                               tracing_.max_reflections,
                               kPathsPerSelected};
        const Pass pass{key.derived(kPlan), 0};
        std::atomic<std::size_t> done = 0;
        parallel_for(cells.size(), [&](std::size_t c) {
            const double share = static_cast<double>(done++) / static_cast<double>(cells.size());
            problem.monitor.report("planning", share);
            problem.monitor.require_time("planning", share);
            std::vector<Pixel> pixels;
            const PixelBlock& cell = cells[c];
            for (int i = 0; i < kPacketWidth; ++i) {
                pixels.push_back({cell.left + (4 * (i % 4) + 2) * cell.width / 16,
                                  cell.top + (4 * (i / 4) + 2) * cell.height / 16});
            }
            std::vector<transport::Receiver> receivers;
            for (transport::Path& path : tracing_.start_paths(pixels, pass).paths)
                add_sub_point(path, 0, receivers);
            if (guide_) {
                // Also where none of the sub-points meets a surface: those of the pixels may.
                points_of_[c] = guide_->points_for(receivers, kPointsOfPass);
                return;
            }
            if (receivers.empty()) return;
            k_per_m2[c] = plan_constant(tracing_.caster, transport_.tracer, receivers, pilot,
                                        kPathsPerPass / kPathsPerSelected, kPilotRays, pass.key.derived(c));
        });
        return k_per_m2;
    }

    const LocalTransport& transport_;
    const GuidedLight* guide_;
    PictureTracing tracing_;
    int cell_edge_;
    std::vector<GuessPoints::Sums> points_of_;  ///< of each cell
    std::vector<double> k_per_m2_;              ///< of each cell
};

}  // namespace

std::unique_ptr<const LocalPicture> make_local_picture(const LocalTransport& transport,
                                                       const Problem& problem, const GuidedLight* guide) {
    return std::make_unique<SubPointPicture>(transport, problem, guide);
}

}  // namespace stilb::estimators
