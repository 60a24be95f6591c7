#include "estimators/patch_light/radiosity/patch_shots.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "patches/visibility/item_buffer.h"

namespace stilb::estimators {
namespace {

patches::Viewpoint turned_viewpoint(const patches::Patches& patches, std::uint32_t side) {
    constexpr double kThird = 1. / 3;
    patches::Viewpoint viewpoint = viewpoint_on(patches, side, {kThird, kThird, kThird});
    // Multiples of the golden section are spread evenly over the circle, in any order.
    const double turn = 2 * std::numbers::pi * std::fmod(side / std::numbers::phi, 1.0);
    const auto [u, v, w] = viewpoint.frame;
    viewpoint.frame.u = std::cos(turn) * u + std::sin(turn) * v;
    viewpoint.frame.v = std::cos(turn) * v - std::sin(turn) * u;
    return viewpoint;
}

/// cos dW of every pixel over the sum of all.
std::vector<float> shares_of_pixels(const patches::ItemBufferLayout& layout) {
    double sum = 0;
    const auto weight = [](const patches::BufferPixel& pixel) {
        return std::max(pixel.cosine, 0.0) * pixel.solid_angle_sr;
    };
    layout.for_each_pixel([&](std::size_t, const patches::BufferPixel& pixel) { sum += weight(pixel); });
    std::vector<float> shares(layout.pixel_count());
    layout.for_each_pixel([&](std::size_t index, const patches::BufferPixel& pixel) {
        shares[index] = static_cast<float>(weight(pixel) / sum);
    });
    return shares;
}

}  // namespace

/// The buffers of one thread.
class PatchShooter {
  public:
    PatchShooter(const patches::PatchCaster& caster, patches::BufferBackend backend,
                 const patches::ItemBufferLayout& layout, std::span<const float> weights)
        : patches_(caster.patches()),
          layout_(layout),
          weights_(weights),
          buffers_(make_item_buffers(backend, caster)),
          seen_(layout.pixel_count()),
          shares_(2 * patches_.count()) {}

    std::vector<FormFactor> shoot(std::uint32_t from) {
        buffers_->fill(layout_, turned_viewpoint(patches_, from), seen_);
        std::vector<FormFactor> factors;
        for (std::size_t pixel = 0; pixel < seen_.size(); ++pixel) {
            const std::uint32_t side = seen_[pixel];
            if (side == patches::kNoSide || weights_[pixel] == 0) continue;
            if (shares_[side] == 0) factors.push_back({side, 0});
            shares_[side] += weights_[pixel];
        }
        for (FormFactor& factor : factors) factor.share = std::exchange(shares_[factor.side], 0.f);
        return factors;
    }

  private:
    const patches::Patches& patches_;
    const patches::ItemBufferLayout& layout_;
    std::span<const float> weights_;
    std::unique_ptr<patches::ItemBuffers> buffers_;
    std::vector<std::uint32_t> seen_;
    std::vector<float> shares_;  ///< per side; 0 before and after
};

struct PatchShots::Shooters {
    patches::BufferBackend backend;
    tbb::enumerable_thread_specific<PatchShooter> of_threads;
};

PatchShots::PatchShots(const patches::PatchCaster& caster, const ShootingOptions& options)
    : caster_(caster),
      layout_(options.window, options.resolution),
      weights_(shares_of_pixels(layout_)),
      shooters_(new Shooters{options.backend, tbb::enumerable_thread_specific<PatchShooter>([this, options] {
                                 return PatchShooter(caster_, options.backend, layout_, weights_);
                             })}) {}

PatchShots::~PatchShots() = default;

std::vector<std::vector<FormFactor>> PatchShots::from(std::span<const std::uint32_t> sides) {
    std::vector<std::vector<FormFactor>> factors(sides.size());
    const auto shoot = [&](std::size_t i) { factors[i] = shooters_->of_threads.local().shoot(sides[i]); };
    if (shooters_->backend ==
        patches::BufferBackend::opengl) {  // one buffer at a time, the driver has threads
        for (std::size_t i = 0; i < sides.size(); ++i) shoot(i);
    } else {
        tbb::parallel_for(std::size_t{0}, sides.size(), shoot);
    }
    return factors;
}

}  // namespace stilb::estimators
