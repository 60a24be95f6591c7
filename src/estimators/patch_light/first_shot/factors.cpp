#include "estimators/patch_light/first_shot/factors.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "patches/visibility/item_buffer.h"
#include "stilb/error.h"

namespace stilb::estimators {
namespace {

/// A side that is seen from a sample.
struct Lit {
    std::uint32_t side = 0;
    float illuminance_lx = 0;
};

/// The buffers of one thread.
class Shooter {
  public:
    Shooter(const patches::PatchCaster& caster, const ShootingOptions& options)
        : patches_(caster.patches()),
          buffers_(make_item_buffers(options.backend, caster)),
          whole_(patches::BufferShape::cube, options.resolution),
          half_(options.window, options.resolution),
          flux_lm_(2 * patches_.count()) {}

    std::vector<Lit> shoot(const LightSample& sample) {
        const patches::ItemBufferLayout& layout = sample.is_point ? whole_ : half_;
        seen_.resize(layout.pixel_count());
        buffers_->fill(layout, sample.viewpoint, seen_);
        std::visit([&](const auto& intensity_cd) { add_flux(layout, intensity_cd); }, sample.intensity);
        return take_lit();
    }

  private:
    /// Adds what all seen sides receive.
    template <typename Intensity>
    void add_flux(const patches::ItemBufferLayout& layout, const Intensity& intensity_cd) {
        layout.for_each_pixel([&](std::size_t index, const patches::BufferPixel& pixel) {
            const std::uint32_t side = seen_[index];
            if (side == patches::kNoSide) return;
            const double flux_lm = intensity_cd(pixel) * pixel.solid_angle_sr;
            if (!(flux_lm > 0)) return;
            if (flux_lm_[side] == 0) touched_.push_back(side);
            flux_lm_[side] += flux_lm;
        });
    }

    std::vector<Lit> take_lit() {
        std::vector<Lit> lit;
        lit.reserve(touched_.size());
        for (const std::uint32_t side : touched_) {
            const double illuminance_lx = flux_lm_[side] / patches_.areas_m2[patches_.patch_of(side)];
            lit.push_back({side, static_cast<float>(illuminance_lx)});
            flux_lm_[side] = 0;
        }
        touched_.clear();
        return lit;
    }

    const patches::Patches& patches_;
    std::unique_ptr<patches::ItemBuffers> buffers_;
    patches::ItemBufferLayout whole_, half_;
    std::vector<std::uint32_t> seen_;
    std::vector<double> flux_lm_;         ///< per side, of the sample; 0 before and after
    std::vector<std::uint32_t> touched_;  ///< sides with flux
};

/// So many samples are shot between two looks at what they have stored.
constexpr std::size_t kTogether = 256;

void require_memory(std::size_t factors, std::size_t done, std::size_t samples) {
    const double all =
        static_cast<double>(factors) * static_cast<double>(samples) / static_cast<double>(done);
    if (all <= double{kMostFactors}) return;
    throw InputError(
        fmt::format("first shot replaces the lights by {} points, whose light on all patches would take "
                    "{:.2g} GB of memory, more than {:.2g} GB. Choose larger patches, or method auto, which "
                    "needs none.",
                    samples, all * sizeof(FirstShotFactors::Factor) * 1e-9,
                    double{kMostFactors} * sizeof(FirstShotFactors::Factor) * 1e-9));
}

/// The sides seen from every sample. The result for a sample does not depend on other threads' work.
std::vector<std::vector<Lit>> shoot_all(const patches::PatchCaster& caster,
                                        std::span<const LightSample> samples, const ShootingOptions& options,
                                        const Monitor& monitor) {
    std::vector<std::vector<Lit>> lit(samples.size());
    Stage stage(monitor, "first shot", samples.size());
    tbb::enumerable_thread_specific<Shooter> shooters([&] { return Shooter(caster, options); });
    const auto shoot = [&](std::size_t i) {
        lit[i] = shooters.local().shoot(samples[i]);
        stage.advance();
    };
    std::size_t factors = 0;
    for (std::size_t first = 0; first < samples.size(); first += kTogether) {
        const std::size_t end = std::min(first + kTogether, samples.size());
        if (options.backend == patches::BufferBackend::opengl) {  // one at a time, the driver has threads
            for (std::size_t i = first; i < end; ++i) shoot(i);
        } else {
            tbb::parallel_for(first, end, shoot);
        }
        for (std::size_t i = first; i < end; ++i) factors += lit[i].size();
        require_memory(factors, end, samples.size());
    }
    return lit;
}

}  // namespace

int first_shot_resolution(std::size_t patches, double samples) {
    constexpr double kPixelsPerPatch = 100, kFaces = 6, kLeast = 64, kMost = 2048, kFewSamples = 16;
    const double of_few = std::sqrt(kPixelsPerPatch / kFaces * static_cast<double>(patches));
    const double wanted = std::min(of_few, kMost) * std::cbrt(std::min(1.0, kFewSamples / samples));
    return 2 * static_cast<int>(std::ceil(std::max(wanted, kLeast) / 2));
}

FirstShotFactors::FirstShotFactors(const patches::PatchCaster& caster, std::span<const LightSample> samples,
                                   const ShootingOptions& options, const Monitor& monitor)
    : first_(2 * caster.patches().count() + 1) {
    std::vector<std::vector<Lit>> lit = shoot_all(caster, samples, options, monitor);
    for (const auto& sides : lit) {
        for (const Lit& l : sides) ++first_[l.side + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    factors_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < lit.size(); ++i) {
        for (const Lit& l : lit[i]) factors_[next[l.side]++] = {i, l.illuminance_lx};
        lit[i] = {};
    }
}

}  // namespace stilb::estimators
