// The illuminance of each side of each patch by each light sample: [FirstShot (17), (20)], theory (T.3),
// (T.4).
//
//     e_ij = (1 / A_j) sum over pixels p in P_j of I_i(w_p) dW_p     [lx]
//
// P_j are the pixels of an item buffer around sample i in which side j of a patch is seen, I_i is the
// sample's intensity towards a pixel, dW_p the pixel's solid angle. In a closed scene the sum of e_ij A_j
// over all sides is the flux that leaves the sample, except for the error of the midpoint rule over pixels. A
// patch's own e_ij is wrong by its boundary pixels; one that lies between the middles of pixels gets nothing,
// though it is seen, and its share goes to its neighbours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/monitor.h"
#include "estimators/patch_light/first_shot/lights.h"
#include "estimators/patch_light/patch_options.h"
#include "patches/visibility/patch_caster.h"

namespace stilb::estimators {

/// An even number of pixels along a face, such that a cube has 100 pixels or more per patch in the mean,
/// but at most 2048: from 250,000 patches on there are fewer. With more than 16 samples there are fewer, too:
/// the samples' errors, in proportion to resolution^-1.5, compensate each other, so that the error of their
/// sum stays the same. `samples`: their effective_number().
int first_shot_resolution(std::size_t patches, double samples);

/// 3.2 GB; they are held twice while they are put in order.
inline constexpr std::size_t kMostFactors = 400'000'000;

/// Rows of different lengths, one for each side, with the samples that see it.
class FirstShotFactors {
  public:
    struct Factor {
        std::uint32_t sample = 0;  ///< of the light samples
        float illuminance_lx = 0;  ///< e_ij, luminance-weighted, mean over the patch
    };

    /// Fills a buffer around every sample, by rays with all threads. Throws InputError where the resolution
    /// is invalid (ItemBufferLayout), where OpenGL is missing, and where there would be more than
    /// kMostFactors (as soon as the first samples show it); Cancelled as the monitor says.
    FirstShotFactors(const patches::PatchCaster& caster, std::span<const LightSample> samples,
                     const ShootingOptions& options, const Monitor& monitor = Monitor::none());
    /// The data that rows() and all() gave: rows ascend from 0 to the number of factors.
    FirstShotFactors(std::vector<std::uint32_t> rows, std::vector<Factor> factors)
        : first_(std::move(rows)), factors_(std::move(factors)) {}

    /// In the order of the samples.
    std::span<const Factor> of(std::uint32_t side) const {
        return std::span(factors_).subspan(first_[side], first_[side + 1] - first_[side]);
    }
    /// The start of each side's factors in all(), and their number.
    std::span<const std::uint32_t> rows() const { return first_; }
    std::span<const Factor> all() const { return factors_; }
    std::size_t bytes() const {
        return first_.size() * sizeof first_[0] + factors_.size() * sizeof factors_[0];
    }

  private:
    std::vector<std::uint32_t> first_;  ///< per side, and the end
    std::vector<Factor> factors_;
};

}  // namespace stilb::estimators
