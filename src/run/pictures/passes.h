// The work of a picture: one pass after another over its pixels.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/monitor.h"
#include "estimators/estimator.h"
#include "math/random.h"
#include "run/pictures/picture_comparison.h"
#include "run/pictures/picture_sums.h"
#include "run/run.h"
#include "run/schedule.h"
#include "statistics/interval.h"

namespace stilb::run {

/// 95 % of the pixels have a bias of less than about twice the root mean square.
inline constexpr double kBiasesOfMostPixels = 2;

/// A picture that accumulates one pass after another over all blocks or, once its cells have paces, over
/// those cells that take part. Keeps references to the arguments' targets; `sums` hold all that is done at
/// any time. Of a part of a run, it makes the passes that are the part's.
class Passes final : public Work {
  public:
    /// `blind`: the pixels outside of the camera's field. `sink` may be null, and `comparison`, for methods
    /// without patches.
    Passes(const estimators::Estimator& estimator, const std::vector<bool>& blind, PictureSums& sums,
           PictureSink* sink, const Monitor& monitor, const PictureComparison* comparison, RunPart part = {});

    /// The passes of the pixels that take part in all; of a part, those of the whole run up to its next one.
    std::uint64_t samples() const override { return sums_.next_pass(part_); }
    std::uint64_t samples_in_all() const override { return sums_.passes(); }
    std::uint64_t samples_for(std::uint64_t paths) const override { return paths; }
    std::uint64_t most_samples() const override { return std::numeric_limits<std::uint64_t>::max(); }
    /// There is no error without two replicates.
    bool has_result() const override { return sums_.passes() >= 2; }
    /// After 1, 2, 3, 4, 6, 8, 12 ... passes of each replicate.
    std::uint64_t next_check() const override { return check_after(samples() / sums_.plan().replicates); }
    bool is_at_check() const override {
        const std::uint64_t replicates = sums_.plan().replicates, passes = samples();
        return passes >= replicates && check_after(passes / replicates - 1) == passes;
    }
    std::uint64_t most_at_once() const override { return 1; }
    double attained_error() const override;
    bool is_beyond_reach(double error) const override;
    /// That of the patches; 0 for other methods.
    PictureComparison::Bias bias() const;
    void show() override {
        if (sink_ && sink_->wants_picture()) sink_->show(sums_.pixels());
    }
    /// An unfinished pass is left out.
    void advance(std::uint64_t) override;
    /// Makes the first passes of all replicates, and decides the paces, where `passes` are enough for this.
    void complete_plan(std::uint64_t passes);

  private:
    /// `rounds`: passes of each replicate.
    std::uint64_t check_after(std::uint64_t rounds) const {
        return sums_.plan().replicates * statistics::next_check(rounds, 1);
    }
    /// `round`: the number of the pass among those of the replicate.
    std::vector<PicturePaces::Part> parts_of_pass(std::uint64_t replicate, std::uint64_t round) const;
    void sample(const estimators::PixelBlock& block, const estimators::PicturePass& pass);

    const estimators::Estimator& estimator_;
    const PictureComparison* comparison_;
    const Monitor& monitor_;
    const std::vector<bool>& blind_;
    PictureSink* sink_;
    PictureSums& sums_;
    RunPart part_;
    std::vector<std::array<float, 3>> pixels_;  ///< of the last pass, and of its layers
    double samples_ = 0;                        ///< of all pixels
    std::atomic<std::uint64_t> invalid_ = 0;
};

}  // namespace stilb::run
