// The sums of a picture's passes, and the errors of its pixels.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "run/pictures/picture_paces.h"
#include "run/result.h"
#include "statistics/pooled_errors.h"

namespace stilb::run {

/// How many replicates a picture has, and how its errors follow from them.
struct PicturePlan {
    /// Neighbours help only where their samples are independent of each other: light that is stored on
    /// patches is not.
    enum class Errors { own, pooled };

    std::uint64_t replicates = 1;  ///< with one, no errors are estimated
    Errors errors = Errors::own;
    bool has_paces = false;  ///< cells that are sure enough take fewer samples (picture_paces.h)
};

/// Pass p is of replicate p mod `replicates`, so that all replicates grow together. From some pass on, cells
/// may have paces of their own; then not all of them take part in a pass.
class PictureSums {
  public:
    PictureSums(const std::array<int, 2>& resolution, const PicturePlan& plan);

    std::uint64_t passes() const { return passes_; }
    std::uint64_t replicates() const { return std::min(passes_, plan_.replicates); }
    /// The number of replicates that passes are divided between.
    std::uint64_t all_replicates() const { return plan_.replicates; }

    /// `pass`: a sample of each pixel, 0 for those that take none.
    void add(const std::vector<std::array<float, 3>>& pass);

    /// Decides the paces, for a plan that has them; all replicates have as many passes by now.
    void set_paces(PicturePaces paces, const std::vector<bool>& blind);
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
    std::array<float, 3> rgb_cd_m2(std::size_t pixel) const;
    std::uint64_t taken(std::uint64_t replicate, std::size_t pixel) const;
    /// The variance of a pixel's value, in units of that of one sample.
    double variance_per_sample(std::size_t pixel) const;
    statistics::PooledErrors<float> errors() const;  ///< [cd/m2]

    std::size_t width_, pixels_;
    PicturePlan plan_;
    std::size_t colours_;  ///< sums of colours for each pixel: one, or one for each replicate
    std::vector<std::array<float, 3>> rgb_;  ///< pixels x colours
    std::vector<float> luminance_;           ///< pixels x replicates
    std::uint64_t passes_ = 0;
    std::optional<PicturePaces> paces_;
};

}  // namespace stilb::run
