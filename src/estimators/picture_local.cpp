// Double local estimation of pictures (theory T.2), by the kernel split where it is `auto` (theory T.1b,
// receiver.h): the sums of local_estimation.cpp for sub-points that each pass draws anew.
//
// A pass walks chains of its own for the whole picture. Each packet of 4 x 4 pixels selects its own few of
// their nodes, and packets lie elsewhere in every pass: errors of neighbouring packets are nearly
// independent, and no structure of the chains shows in the picture.
#include "estimators/picture_local.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "estimators/camera_rays.h"
#include "estimators/direct_light.h"
#include "estimators/fan.h"
#include "estimators/gather.h"
#include "estimators/limits.h"
#include "estimators/node_selection.h"
#include "estimators/split_plan.h"

namespace stilb {
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
        : scene_(input.scene),
          caster_(input.caster),
          camera_(input.camera),
          view_(camera_),
          max_reflections_(input.max_reflections),
          lights_(scene_, caster_),
          tracer_(scene_, caster_, lights_),
          gathers_(split == Split::balanced || has_specular_surfaces(scene_)),
          cells_per_row_((camera_.resolution[0] + kBlockSize - 1) / kBlockSize),
          k_per_m2_(plan(split, input.preparation_key)) {}

    std::unique_ptr<const PicturePass> start(const Pass& pass) const override {
        return std::make_unique<Fans>(*this, pass);
    }
    std::vector<std::string> warnings() const override { return local_warnings(scene_); }

  private:
    class Fans final : public PicturePass {
      public:
        Fans(const LocalPicture& picture, const Pass& pass)
            : picture_(picture),
              pass_(pass),
              streams_(picture.camera_, pass),
              pool_(picture.walk_chains(pass.key.derived(kWalks), pass.index * kChains,
                                        (pass.index + 1) * kChains)) {}

        std::uint64_t sample(const PixelBlock& block, std::span<Spectrum> pixels) const override {
            ReadingSums sums(pixels.size());
            for (int top = 0; top < block.height; top += kSide) {
                for (int left = 0; left < block.width; left += kSide) sample_packet(block, left, top, sums);
            }
            std::copy(sums.sum.begin(), sums.sum.end(), pixels.begin());
            return sums.invalid;
        }

      private:
        void sample_packet(const PixelBlock& block, int left, int top, ReadingSums& sums) const {
            std::vector<Receiver> receivers;
            std::vector<double> k_per_m2;
            receivers.reserve(kPacketWidth);
            for (int y = top; y < std::min(top + kSide, block.height); ++y) {
                for (int x = left; x < std::min(left + kSide, block.width); ++x) {
                    const auto reading = static_cast<std::uint32_t>(y * block.width + x);
                    const int column = block.left + x, row = block.top + y;
                    sums.add(reading,
                             picture_.look_at(column, row, reading, streams_.at(column, row), receivers));
                    k_per_m2.resize(receivers.size(), picture_.k_per_m2_[picture_.cell_of(column, row)]);
                }
            }
            if (receivers.empty()) return;
            // The packet's random numbers: those of its first pixel's place.
            const RandomKey key =
                pass_.key.derived(kPackets).derived(static_cast<std::uint64_t>(block.left + left) << 32 |
                                                    static_cast<std::uint64_t>(block.top + top));
            picture_.receive(receivers, k_per_m2, pool_, {key, pass_.index}, sums);
        }

        const LocalPicture& picture_;
        Pass pass_;
        PixelStreams streams_;
        NodePool pool_;
    };

    std::size_t cell_of(int x, int y) const {
        const int cell = y / kBlockSize * cells_per_row_ + x / kBlockSize;
        return static_cast<std::size_t>(cell);
    }

    /// Appends the sub-point that a sample of a pixel sees; returns the emission that is seen and the direct
    /// light there.
    Spectrum look_at(int x, int y, std::uint32_t reading, SampleStream stream,
                     std::vector<Receiver>& receivers) const {
        const auto direction = sample_pixel(camera_, view_, x, y, stream);
        if (!direction) return {};
        const auto hit = caster_.closest(view_.position(), *direction);
        if (!hit) return {};
        const auto view = tracer_.look_through(*hit, *direction, max_reflections_, stream);
        const Spectrum emission = lights_.emitted_luminance(*hit) + view.emission_cd_m2;
        if (!view.surface || view.reflections == max_reflections_) return emission;
        receivers.emplace_back(reading,
                               SubPoint{*view.surface, view.outgoing, view.transmission, view.reflections},
                               scene_.material(view.surface->material));
        const Receiver& receiver = receivers.back();
        return emission + direct_from_points(receiver, caster_, lights_) +
               sample_direct_from_areas(receiver, caster_, lights_, stream);
    }

    /// Adds a sample of a packet's indirect light.
    void receive(std::span<const Receiver> receivers, std::span<const double> k_per_m2, const NodePool& pool,
                 const Pass& pass, ReadingSums& sums) const {
        const std::vector<PointTile> tiles = tiles_of(receivers, k_per_m2, caster_, max_reflections_);
        const double u = SampleStream(pass.key.derived(kSelection), pass.index).next();
        std::vector<ChainNode> nodes = pool.select(pool.size() / kChainsPerSelected + 1, u);
        for (ChainNode& node : nodes) node.flux_lm *= 1.0 / kChains;
        Fan(caster_, tiles).collect(nodes, sums);
        if (!gathers_) return;
        const std::vector<SplitPlan> plans(receivers.size(), {0, 1});
        Gather(caster_, tracer_, tiles, plans).collect({pass.key.derived(kGather), pass.index, 1}, sums);
    }

    std::vector<ChainNode> walk_chains(RandomKey key, std::uint64_t first, std::uint64_t end) const {
        return walk_light_chains(scene_, caster_, lights_, max_reflections_, key, first, end);
    }

    /// A k for each cell of kBlockSize pixels' edge, from a packet of sub-points spread over it.
    std::vector<double> plan(Split split, RandomKey key) const {
        const std::vector<PixelBlock> cells = blocks_of(camera_.resolution);
        std::vector<double> k_per_m2(cells.size(), std::numeric_limits<double>::infinity());
        if (split == Split::none) return k_per_m2;
        const std::vector<ChainNode> nodes = walk_chains(key.derived(kPilot), 0, kPilotChains);
        const PilotLight pilot{
            nodes, kPilotChains, {}, surface_area_m2(scene_), max_reflections_, kChainsPerSelected};
        const Pass pass{key.derived(kPlan), 0};
        const PixelStreams streams(camera_, pass);
        tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t c) {
            std::vector<Receiver> receivers;
            const PixelBlock& cell = cells[c];
            for (int i = 0; i < kPacketWidth; ++i) {
                const int x = cell.left + (4 * (i % 4) + 2) * cell.width / 16;
                const int y = cell.top + (4 * (i / 4) + 2) * cell.height / 16;
                look_at(x, y, 0, streams.at(x, y), receivers);
            }
            if (receivers.empty()) return;
            k_per_m2[c] = plan_constant(caster_, tracer_, receivers, pilot, kChains / kChainsPerSelected,
                                        kPilotRays, pass.key.derived(c));
        });
        return k_per_m2;
    }

    const Scene& scene_;
    const RayCaster& caster_;
    Camera camera_;
    CameraView view_;
    int max_reflections_;
    LightSampler lights_;
    PathTracer tracer_;
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

}  // namespace stilb
