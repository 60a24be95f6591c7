// Double local estimation of pictures (theory T.2), by the kernel split where it is `auto` (theory T.1b,
// receiver.h): the sums of local_estimation.cpp for sub-points that each pass draws anew.
//
// A pass walks chains of its own for the whole picture. Each packet of 4 x 4 pixels selects its own few of
// their nodes, and packets lie elsewhere in every pass: errors of neighbouring packets are nearly
// independent, and no structure of the chains shows in the picture.
#include "estimators/local/picture_local.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "estimators/camera_paths.h"
#include "estimators/limits.h"
#include "estimators/local/connection.h"
#include "estimators/local/gather.h"
#include "estimators/local/node_selection.h"
#include "estimators/local/split_plan.h"
#include "transport/direct_light.h"

namespace stilb::estimators {
namespace {

/// Chains of a pass, and of so many of them a packet selects one chain's nodes. The more are walked, the more
/// evenly the selected nodes lie; walking costs less than a hundredth of a large picture's pass.
constexpr std::uint64_t kChains = 4096;
constexpr std::uint64_t kChainsPerSelected = 256;
/// For planning, which needs little: any plan is unbiased.
constexpr std::uint64_t kPilotChains = 256;
constexpr unsigned kPilotRays = 4;

enum Purpose : std::uint64_t { kWalks = kPixels + 1, kPackets, kSelection, kGather, kPilot, kPlan };

/// Edge of a packet.
constexpr int kSide = 4;
static_assert(kSide * kSide == kPacketWidth);

class LocalPicture final : public PictureEstimator {
  public:
    enum class Split { none, balanced };

    LocalPicture(const PictureInput& input, Split split)
        : tracing_(input),
          gathers_(split == Split::balanced || has_specular_surfaces(tracing_.scene)),
          cells_per_row_((tracing_.camera.resolution[0] + kBlockSize - 1) / kBlockSize),
          k_per_m2_(plan(split, input.preparation_key)) {}

    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        return std::make_unique<Fans>(*this, pass);
    }
    std::vector<std::string> warnings() const override { return local_warnings(tracing_.scene); }

  private:
    class Fans final : public PicturePass {
      public:
        Fans(const LocalPicture& picture, const Pass& pass)
            : picture_(picture),
              pass_(pass),
              pool_(picture.walk_chains(pass.key.derived(kWalks), pass.index * kChains,
                                        (pass.index + 1) * kChains)) {}

        std::uint64_t sample(const PixelBlock& block, std::span<Rgb> pixels) const override {
            ReadingSums sums(pixels.size());
            for (int top = 0; top < block.height; top += kSide) {
                for (int left = 0; left < block.width; left += kSide) sample_packet(block, left, top, sums);
            }
            std::copy(sums.sum.begin(), sums.sum.end(), pixels.begin());
            return sums.invalid;
        }

      private:
        void sample_packet(const PixelBlock& block, int left, int top, ReadingSums& sums) const {
            const PixelBlock packet{block.left + left, block.top + top, std::min(kSide, block.width - left),
                                    std::min(kSide, block.height - top)};
            std::vector<std::uint32_t> readings;
            for (int y = 0; y < packet.height; ++y) {
                for (int x = 0; x < packet.width; ++x) {
                    readings.push_back(static_cast<std::uint32_t>((top + y) * block.width + left + x));
                }
            }
            const std::vector<Pixel> pixels = pixels_of(packet);
            std::vector<transport::Receiver> receivers;
            std::vector<double> k_per_m2;
            receivers.reserve(kPacketWidth);
            CameraPaths started = picture_.tracing_.start_paths(pixels, pass_);
            for (const auto& [pixel, luminance_cd_m2] : started.outside)
                sums.add(readings[pixel], luminance_cd_m2);
            for (std::size_t i = 0; i < started.paths.size(); ++i) {
                const std::size_t pixel = started.pixels[i];
                sums.add(readings[pixel], picture_.look(started.paths[i], readings[pixel], receivers));
                k_per_m2.resize(receivers.size(), picture_.k_per_m2_[picture_.cell_of(pixels[pixel])]);
            }
            if (receivers.empty()) return;
            // The packet's random numbers: those of its first pixel's place.
            const math::RandomKey key = pass_.key.derived(kPackets).derived(
                static_cast<std::uint64_t>(packet.left) << 32 | static_cast<std::uint64_t>(packet.top));
            picture_.receive(receivers, k_per_m2, pool_, {key, pass_.index}, sums);
        }

        const LocalPicture& picture_;
        Pass pass_;
        NodePool pool_;
    };

    std::size_t cell_of(const Pixel& pixel) const {
        const int cell = pixel.y / kBlockSize * cells_per_row_ + pixel.x / kBlockSize;
        return static_cast<std::size_t>(cell);
    }

    /// Appends the sub-point that a path from the camera comes to; returns the emission that it sees and the
    /// direct light at the sub-point.
    Rgb look(transport::Path& path, std::uint32_t reading,
             std::vector<transport::Receiver>& receivers) const {
        const bool meets_surface = tracing_.tracer.look_through(path);
        const Rgb emission = path.luminance_cd_m2;
        if (!meets_surface || path.reflections_left == 0) return emission;
        receivers.emplace_back(reading,
                               transport::SubPoint{path.hit, path.outgoing, path.throughput,
                                                   tracing_.max_reflections - path.reflections_left},
                               tracing_.scene.material(path.hit.material));
        const transport::Receiver& receiver = receivers.back();
        return emission + direct_from_points(receiver, tracing_.caster, tracing_.lights) +
               sample_direct_from_areas(receiver, tracing_.caster, tracing_.lights, path.stream);
    }

    /// Adds a sample of a packet's indirect light.
    void receive(std::span<const transport::Receiver> receivers, std::span<const double> k_per_m2,
                 const NodePool& pool, const Pass& pass, ReadingSums& sums) const {
        const std::vector<PointTile> tiles =
            tiles_of(receivers, k_per_m2, tracing_.caster, tracing_.max_reflections);
        const double u = math::SampleStream(pass.key.derived(kSelection), pass.index).next();
        std::vector<transport::LightVertex> nodes = pool.select(pool.size() / kChainsPerSelected + 1, u);
        for (transport::LightVertex& node : nodes) node.flux_lm *= 1.0 / kChains;
        Fan(tracing_.caster, tiles).collect(nodes, sums);
        if (!gathers_) return;
        const std::vector<SplitPlan> plans(receivers.size(), {0, 1});
        Gather(tracing_.caster, tracing_.tracer, tiles, plans)
            .collect({pass.key.derived(kGather), pass.index, 1}, sums);
    }

    std::vector<transport::LightVertex> walk_chains(math::RandomKey key, std::uint64_t first,
                                                    std::uint64_t end) const {
        return trace_light_paths(tracing_.scene, tracing_.caster, tracing_.lights, tracing_.max_reflections,
                                 key, first, end);
    }

    /// A k for each cell of kBlockSize pixels' edge, from a packet of sub-points spread over it.
    std::vector<double> plan(Split split, math::RandomKey key) const {
        const std::vector<PixelBlock> cells = blocks_of(tracing_.camera.resolution);
        std::vector<double> k_per_m2(cells.size(), std::numeric_limits<double>::infinity());
        if (split == Split::none) return k_per_m2;
        const std::vector<transport::LightVertex> nodes = walk_chains(key.derived(kPilot), 0, kPilotChains);
        const PilotLight pilot{nodes,
                               kPilotChains,
                               {},
                               surface_area_m2(tracing_.scene),
                               tracing_.max_reflections,
                               kChainsPerSelected};
        const Pass pass{key.derived(kPlan), 0};
        tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t c) {
            std::vector<Pixel> pixels;
            const PixelBlock& cell = cells[c];
            for (int i = 0; i < kPacketWidth; ++i) {
                pixels.push_back({cell.left + (4 * (i % 4) + 2) * cell.width / 16,
                                  cell.top + (4 * (i / 4) + 2) * cell.height / 16});
            }
            std::vector<transport::Receiver> receivers;
            for (transport::Path& path : tracing_.start_paths(pixels, pass).paths) look(path, 0, receivers);
            if (receivers.empty()) return;
            k_per_m2[c] = plan_constant(tracing_.caster, tracing_.tracer, receivers, pilot,
                                        kChains / kChainsPerSelected, kPilotRays, pass.key.derived(c));
        });
        return k_per_m2;
    }

    PictureTracing tracing_;
    bool gathers_;
    int cells_per_row_;
    std::vector<double> k_per_m2_;  ///< of each cell
};

}  // namespace

std::unique_ptr<PictureEstimator> make_local_picture(const PictureInput& input) {
    return std::make_unique<LocalPicture>(input, LocalPicture::Split::none);
}

std::unique_ptr<PictureEstimator> make_auto_picture(const PictureInput& input) {
    return std::make_unique<LocalPicture>(input, LocalPicture::Split::balanced);
}

}  // namespace stilb::estimators
