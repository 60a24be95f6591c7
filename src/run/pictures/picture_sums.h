// The sums of a picture's passes, and the errors of its pixels.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/bytes.h"
#include "run/pictures/picture_paces.h"
#include "run/plan.h"
#include "run/result.h"
#include "statistics/pooled_errors.h"

namespace stilb::run {

/// The plan of a picture and the sums of its passes: a value that another run continues. Pass p is of
/// replicate p mod `replicates`, so that all replicates grow together. From some pass on, cells may have
/// paces of their own; then not all of them take part in a pass.
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

    std::uint64_t passes() const { return passes_; }
    std::uint64_t replicates() const { return std::min<std::uint64_t>(passes_, plan_.replicates); }

    /// `pass`: a sample of each pixel, 0 for those that take none, and likewise of each layer, one after
    /// another.
    void add(const std::vector<std::array<float, 3>>& pass);
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
    /// The share of a replicate's sum in a pixel: the value is the sum over the replicates of sum * scale,
    /// over the sum of their weights.
    struct Share {
        double scale = 0, weight = 0;
    };
    /// By passes, which differ by one at most; in plans with paces, all replicates count the same
    /// (picture_paces.h).
    Share share_of(std::uint64_t replicate, std::size_t pixel) const;
    double weights() const;  ///< of all replicates
    /// `sums`: pixels x colours.
    std::array<float, 3> rgb_cd_m2(std::size_t pixel, std::span<const std::array<float, 3>> sums) const;
    std::uint64_t taken(std::uint64_t replicate, std::size_t pixel) const;
    /// The variance of a pixel's value, in units of that of one sample.
    double variance_per_sample(std::size_t pixel) const;
    statistics::PooledErrors<float> errors() const;  ///< [cd/m2]

    math::RandomKey cells_key() const;

    RunPlan plan_;
    std::array<int, 2> resolution_{};
    std::size_t pixels_ = 0;
    std::size_t layers_ = 0;
    std::size_t colours_ = 1;  ///< sums of colours for each pixel: one, or one for each replicate
    std::vector<std::array<float, 3>> rgb_;  ///< pixels x colours, and the same of each layer
    std::vector<float> luminance_;           ///< pixels x replicates
    std::uint64_t passes_ = 0;
    std::optional<PicturePaces> paces_;
};

}  // namespace stilb::run
