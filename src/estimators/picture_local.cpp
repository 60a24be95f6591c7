// Double local estimation of pictures (theory T.2), by the kernel split where it is `auto` (theory T.1b,
// receiver.h): the sums of local_estimation.cpp for the sub-points of a block of pixels, which each pass draws
// anew, and light chains of the block's own in each pass. Errors of different blocks and of different
// replicates are independent, so that no structure of the chains shows in the picture.
#include "estimators/picture_local.h"

#include <tbb/parallel_for.h>

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

/// In each pass, for each block: chains whose nodes go to the block's sub-points, and how many are walked for
/// each of these (node_selection.h). As many as cost about what the rest of the pass does.
constexpr std::uint64_t kSelectedChains = 16;
constexpr std::uint64_t kChainsPerSelected = 4;
constexpr std::uint64_t kChains = kSelectedChains * kChainsPerSelected;
/// For planning, which needs little: any plan is unbiased.
constexpr std::uint64_t kPilotChains = 256;
constexpr unsigned kPilotRays = 16;

enum Purpose : std::uint64_t { kWalks, kSelection, kGather, kPilot, kPlan };

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
          k_per_m2_(plan(split, input.preparation_key)) {}

    std::uint64_t sample(const PixelBlock& block, const Pass& pass,
                         std::span<Spectrum> pixels) const override {
        std::vector<Receiver> receivers;
        for_each_pixel(block, [&](int x, int y, std::uint32_t reading) {
            pixels[reading] = look_at(x, y, reading, pass, receivers);
        });
        ReadingSums sums(pixels.size());
        receive(receivers, block.index, pass, sums);
        std::uint64_t invalid = sums.invalid;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            pixels[i] += sums.sum[i] * (1.0 / static_cast<double>(kChains));
            if (pixels[i].is_finite()) continue;
            pixels[i] = {};
            ++invalid;
        }
        return invalid;
    }

    std::vector<std::string> warnings() const override { return local_warnings(scene_); }

  private:
    /// In squares of 4 x 4, which share packets.
    template <typename Action>
    static void for_each_pixel(const PixelBlock& block, const Action& action) {
        constexpr int side = 4;
        static_assert(side * side == kPacketWidth);
        for (int top = 0; top < block.height; top += side) {
            for (int left = 0; left < block.width; left += side) {
                for (int y = top; y < std::min(top + side, block.height); ++y) {
                    for (int x = left; x < std::min(left + side, block.width); ++x) {
                        action(block.left + x, block.top + y,
                               static_cast<std::uint32_t>(y * block.width + x));
                    }
                }
            }
        }
    }

    /// Appends the sub-point that a sample of a pixel sees; returns the emission that is seen and the direct
    /// light there.
    Spectrum look_at(int x, int y, std::uint32_t reading, const Pass& pass,
                     std::vector<Receiver>& receivers) const {
        SampleStream stream = pixel_stream(camera_, pass, x, y);
        const auto direction = sample_pixel(camera_, view_, x, y, stream);
        if (!direction) return {};
        const auto hit = caster_.closest(view_.position(), *direction);
        if (!hit) return {};
        const auto view = tracer_.look_through(*hit, *direction, max_reflections_, stream);
        const Spectrum emission = lights_.emitted_luminance(*hit) + view.emission_cd_m2;
        if (!view.surface || view.reflections == max_reflections_) return emission;
        receivers.emplace_back(
            reading, SubPoint{*view.surface, view.outgoing, view.transmission, view.reflections},
            scene_.material(view.surface->material));
        const Receiver& receiver = receivers.back();
        return emission + direct_from_points(receiver, caster_, lights_) +
               sample_direct_from_areas(receiver, caster_, lights_, stream);
    }

    /// Adds kChains times a sample of the indirect light.
    void receive(const std::vector<Receiver>& receivers, std::size_t block, const Pass& pass,
                 ReadingSums& sums) const {
        if (receivers.empty()) return;
        const RandomKey key = pass.key.derived(block);
        const std::vector<double> k(receivers.size(), k_per_m2_[block]);
        const std::vector<PointTile> tiles = tiles_of(receivers, k, caster_, max_reflections_);
        Fan(caster_, tiles).collect(fan_nodes(key, pass.index), sums);
        if (!gathers_) return;
        const std::vector<SplitPlan> plans(receivers.size(), {k_per_m2_[block], kChains});
        Gather(caster_, tracer_, tiles, plans)
            .collect({key.derived(kGather), pass.index * kChains, kChains}, sums);
    }

    std::vector<ChainNode> fan_nodes(RandomKey key, std::uint64_t pass) const {
        const std::vector<ChainNode> nodes = walk_chains(key.derived(kWalks), pass * kChains, kChains);
        const double u = SampleStream(key.derived(kSelection), pass).next();
        return select_nodes(nodes, nodes.size() / kChainsPerSelected + 1, u);
    }

    std::vector<ChainNode> walk_chains(RandomKey key, std::uint64_t first, std::uint64_t count) const {
        std::vector<ChainNode> nodes;
        for (std::uint64_t chain = first; chain < first + count; ++chain) {
            walk_light_chain(scene_, caster_, lights_, max_reflections_, SampleStream(key, chain), nodes);
        }
        return nodes;
    }

    /// A k for each block, from a packet of sub-points spread over it.
    std::vector<double> plan(Split split, RandomKey key) const {
        const std::vector<PixelBlock> blocks = blocks_of(camera_.resolution);
        std::vector<double> k_per_m2(blocks.size(), std::numeric_limits<double>::infinity());
        if (split == Split::none) return k_per_m2;
        const std::vector<ChainNode> nodes = walk_chains(key.derived(kPilot), 0, kPilotChains);
        double area = std::numeric_limits<double>::min();
        for (const Object& object : scene_.objects) area += area_m2(object.shape);
        const PilotLight pilot{nodes, kPilotChains, {}, area, max_reflections_, kChainsPerSelected};
        tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
            const Pass pass{key.derived(kPlan), 0};
            std::vector<Receiver> receivers;
            const PixelBlock& block = blocks[b];
            for (int i = 0; i < kPacketWidth; ++i) {
                look_at(block.left + (4 * (i % 4) + 2) * block.width / 16,
                        block.top + (4 * (i / 4) + 2) * block.height / 16, 0, pass, receivers);
            }
            if (receivers.empty()) return;
            k_per_m2[b] = plan_constant(caster_, tracer_, receivers, pilot, kSelectedChains, kPilotRays,
                                        pass.key.derived(b));
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
    std::vector<double> k_per_m2_;  ///< of each block
};

}  // namespace

std::unique_ptr<PictureEstimator> make_local_picture(const PictureInput& input) {
    return std::make_unique<LocalPicture>(input, LocalPicture::Split::none);
}

std::unique_ptr<PictureEstimator> make_auto_picture(const PictureInput& input) {
    return std::make_unique<LocalPicture>(input, LocalPicture::Split::balanced);
}

}  // namespace stilb
