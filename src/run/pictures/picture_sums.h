// The sums of a picture's passes, and the errors of its pixels.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/bytes.h"
#include "run/pictures/picture_paces.h"
#include "run/plan.h"
#include "run/result.h"
#include "statistics/pooled_errors.h"

namespace stilb::run {

/// The plan of a picture and the sums of its passes: a value that another run continues, in parts or at
/// another time. Pass p is of replicate p mod `replicates`, so that all replicates grow together. From some
/// pass on, cells may have paces of their own; then not all of them take part in a pass.
class PictureSums {
  public:
    PictureSums() = default;
    /// With one replicate, no errors are estimated.
    /// `layers`: parts of the light that are kept apart.
    PictureSums(const std::array<int, 2>& resolution, RunPlan plan, std::size_t layers = 0);

    const RunPlan& plan() const { return plan_; }
    const std::array<int, 2>& resolution() const { return resolution_; }

    void write(ByteWriter& bytes) const;
    static PictureSums read(ByteReader& bytes);

    /// Adds the replicates that another part of the run has made, or the passes of other seeds; the latter
    /// cannot be continued. Throws std::invalid_argument for a run of another plan or size, and where both
    /// have made the same passes.
    void merge(PictureSums other);
    std::vector<std::uint64_t> seeds() const;

    /// The passes of all replicates.
    std::uint64_t passes() const;
    /// Those that have passes: all of the plan after its first passes, unless these are sums of a part.
    std::uint64_t replicates() const;
    /// The first pass of a part of the run that is not among the sums; the largest number where the part has
    /// no replicate.
    std::uint64_t next_pass(const RunPart& part = {}) const;

    /// Adds the next pass of a replicate. `pass`: a sample of each pixel, 0 for those that take none, and
    /// likewise of each layer, one after another.
    void add(std::uint64_t replicate, const std::vector<std::array<float, 3>>& pass);
    std::size_t layers() const { return layers_; }

    /// Decides the paces, for a plan that has them; all replicates have as many passes by now.
    void set_paces(const std::vector<bool>& blind);
    /// Null before.
    const PicturePaces* paces() const { return paces_ ? &*paces_ : nullptr; }

    double luminance_cd_m2(std::size_t pixel) const;
    /// The mean of one replicate, which has at least one pass.
    double luminance_of_replicate_cd_m2(std::uint64_t replicate, std::size_t pixel) const;
    /// The standard error from the pixel's own replicates; infinite for a single replicate.
    double own_standard_error_cd_m2(std::size_t pixel) const;

    /// 95 % of the pixels that see anything have a 95 % interval whose half-width is at most this share of
    /// their luminance. Infinite for a single replicate.
    double attained_error(const std::vector<bool>& blind) const;
    Pixels pixels() const;
    /// The mean over the pixels that see anything.
    double samples_per_pixel(const std::vector<bool>& blind) const;

  private:
    /// Sums of samples: of the pixels, and likewise of each layer, one after another.
    using Colours = std::vector<std::array<float, 3>>;
    struct Replicate {
        std::uint64_t passes = 0;
        Colours sums;  ///< empty without passes
    };

    /// Calls `action` with the number of each replicate that has passes.
    template <typename Action>
    void for_each_begun(const Action& action) const {
        for (std::uint64_t r = 0; r < replicates_.size(); ++r) {
            if (replicates_[r].passes > 0) action(r);
        }
    }
    void merge_seeds(PictureSums other);
    /// Gives all pixels of a replicate as many samples as it has passes, with the same means.
    void forget_paces();

    /// The share of a replicate's sum in a pixel: the value is the sum over the replicates of sum * scale,
    /// over the sum of their weights.
    struct Share {
        double scale = 0, weight = 0;
    };
    /// By passes, which differ by one at most; in plans with paces, all replicates count the same
    /// (picture_paces.h).
    Share share_of(std::uint64_t replicate, std::size_t pixel) const;
    double weights() const;                                              ///< of all replicates
    double sum_cd_m2(std::uint64_t replicate, std::size_t pixel) const;  ///< the luminance of its sum
    /// `layer`: 0 for the whole light.
    std::array<float, 3> rgb_cd_m2(std::size_t pixel, std::size_t layer) const;
    std::uint64_t taken(std::uint64_t replicate, std::size_t pixel) const;
    /// The variance of a pixel's value, in units of that of one sample.
    double variance_per_sample(std::size_t pixel) const;
    statistics::PooledErrors<float> errors() const;  ///< [cd/m2]

    math::RandomKey cells_key() const;

    RunPlan plan_;
    std::array<int, 2> resolution_{};
    std::size_t pixels_ = 0;
    std::size_t layers_ = 0;
    std::vector<Replicate> replicates_;
    std::vector<std::uint64_t> more_seeds_;  ///< as RunState
    std::optional<PicturePaces> paces_;
};

}  // namespace stilb::run
