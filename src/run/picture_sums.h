// The sums of a picture's passes, and the errors of its pixels.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "run/result.h"
#include "statistics/pooled_errors.h"

namespace stilb::run {

/// Pass p is of replicate p mod `replicates`, so that all replicates grow together.
class PictureSums {
  public:
    /// How errors come from replicates. Neighbours help only where their samples are independent of each
    /// other: light that is stored on patches is not.
    enum class Errors { own, pooled };

    /// One replicate: no errors are estimated.
    PictureSums(const std::array<int, 2>& resolution, std::uint64_t replicates, Errors errors);

    std::uint64_t passes() const { return passes_; }
    std::uint64_t replicates() const { return std::min(passes_, replicates_); }
    /// The number of replicates that passes are divided between.
    std::uint64_t all_replicates() const { return replicates_; }

    void add(const std::vector<std::array<float, 3>>& pass);

    double luminance_cd_m2(std::size_t pixel) const;
    /// The standard error from the pixel's own replicates, each weighted by its passes (which differ by one
    /// at most); infinite for a single replicate.
    double own_standard_error_cd_m2(std::size_t pixel) const;

    /// 95 % of the pixels that see anything have a 95 % interval whose half-width is at most this share of
    /// their luminance. Infinite for a single replicate.
    double attained_error(const std::vector<bool>& blind) const;
    Pixels pixels() const;

  private:
    statistics::PooledErrors<float> errors() const;  ///< [cd/m2]

    std::size_t width_;
    std::uint64_t replicates_;
    Errors errors_;
    std::vector<std::array<float, 3>> rgb_;
    std::vector<float> luminance_;  ///< pixels x replicates
    std::uint64_t passes_ = 0;
};

}  // namespace stilb::run
