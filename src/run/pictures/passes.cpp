#include "run/pictures/passes.h"

#include <algorithm>
#include <memory>

#include "base/parallel.h"
#include "run/streams.h"

namespace stilb::run {
namespace {

/// Passes of a replicate from which its cells' paces follow: after one, the spread says too little; after
/// four, most runs have ended or take as many everywhere.
constexpr std::uint64_t kPassesBeforePaces = 2;

}  // namespace

Passes::Passes(const estimators::Estimator& estimator, const std::vector<bool>& blind, PictureSums& sums,
               PictureSink* sink, const Monitor& monitor, const PictureComparison* comparison, RunPart part)
    : estimator_(estimator),
      comparison_(comparison),
      monitor_(monitor),
      blind_(blind),
      sink_(sink),
      sums_(sums),
      part_(part),
      pixels_(blind.size() * (1 + sums.layers())) {}

double Passes::attained_error() const {
    return sums_.attained_error(blind_) + kBiasesOfMostPixels * bias().at_most;
}

bool Passes::is_beyond_reach(double error) const { return kBiasesOfMostPixels * bias().at_least > error; }

PictureComparison::Bias Passes::bias() const {
    if (!comparison_) return {};
    return comparison_->bias_of([&](std::size_t pixel) {
        return PictureComparison::Shown{sums_.luminance_cd_m2(pixel), sums_.own_standard_error_cd_m2(pixel)};
    });
}

void Passes::advance(std::uint64_t) {
    const RunPlan& plan = sums_.plan();
    const std::uint64_t p = samples(), replicate = p % plan.replicates, round = p / plan.replicates;
    if (plan.has_paces && !sums_.paces() && round == kPassesBeforePaces) sums_.set_paces(blind_);
    const math::RandomKey key = key_of_seed(plan.seed).derived(RunStream::picture).derived(replicate);
    const std::vector<PicturePaces::Part> parts = parts_of_pass(replicate, round);
    std::vector<std::unique_ptr<const estimators::PicturePass>> started(parts.size());
    parallel_for(parts.size(), [&](std::size_t i) {
        started[i] = estimator_.start({{key}, parts[i].sample, replicate});
    });
    struct Task {
        const estimators::PixelBlock& block;
        const estimators::PicturePass& pass;
    };
    std::vector<Task> tasks;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (const estimators::PixelBlock& block : parts[i].blocks) tasks.push_back({block, *started[i]});
    }
    if (sums_.paces()) std::ranges::fill(pixels_, std::array<float, 3>{});
    parallel_for(tasks.size(), [&](std::size_t i) {
        monitor_.require_more();
        sample(tasks[i].block, tasks[i].pass);
    });
    sums_.add(replicate, pixels_);
    for (const auto& [block, pass] : tasks) samples_ += static_cast<double>(block.pixels());
    require_mostly_finite(invalid_, samples_);
}

void Passes::complete_plan(std::uint64_t passes) {
    const std::uint64_t first = kPassesBeforePaces * sums_.plan().replicates;
    if (!sums_.plan().has_paces || passes <= first) return;
    while (samples() < first) advance(1);
    sums_.set_paces(blind_);
}

std::vector<PicturePaces::Part> Passes::parts_of_pass(std::uint64_t replicate, std::uint64_t round) const {
    // A part of a run knows the paces from its beginning; the first passes take no notice.
    if (sums_.paces() && round >= kPassesBeforePaces) return sums_.paces()->parts_of(replicate, round);
    // Blocks have another offset in every pass, so that their edges do not show.
    const math::RandomKey key = key_of_seed(sums_.plan().seed).derived(RunStream::picture_offset);
    const auto [u, v] = math::SampleStream(key, round * sums_.plan().replicates + replicate).next_two();
    return {{round,
             estimators::blocks_of(sums_.resolution(), {1 + static_cast<int>(u * estimators::kBlockSize),
                                                        1 + static_cast<int>(v * estimators::kBlockSize)})}};
}

void Passes::sample(const estimators::PixelBlock& block, const estimators::PicturePass& pass) {
    const std::size_t layers = sums_.layers();
    estimators::Tally samples(block.pixels(), 0, layers);
    pass.sample(block, samples);
    invalid_ += samples.invalid;
    const auto width = static_cast<std::size_t>(sums_.resolution()[0]);
    for (std::size_t i = 0; i < samples.sum.size(); ++i) {
        const std::size_t x =
            static_cast<std::size_t>(block.left) + i % static_cast<std::size_t>(block.width);
        const std::size_t y = static_cast<std::size_t>(block.top) + i / static_cast<std::size_t>(block.width);
        const auto set = [&](std::size_t layer, const Rgb& sample) {
            for (std::size_t b = 0; b < kBands; ++b)
                pixels_[layer * blind_.size() + y * width + x][b] = static_cast<float>(sample[b]);
        };
        set(0, samples.sum[i]);
        for (std::size_t layer = 0; layer < layers; ++layer)
            set(1 + layer, samples.parts[layer * samples.sum.size() + i]);
    }
}

}  // namespace stilb::run
