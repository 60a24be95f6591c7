// How far a picture by patches is from path tracing, which has no patches: in some of its pixels.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "estimators/estimator.h"
#include "statistics/bias.h"

namespace stilb::run {

class PictureComparison {
  public:
    /// Parts of its key.
    enum class Stream : std::uint64_t { choice, paths };

    /// Traces paths through some pixels, some seconds of work at most. `blind`: the pixels outside of the
    /// camera's field.
    PictureComparison(const estimators::Problem& problem, const std::vector<bool>& blind,
                      math::KeyOf<Stream> key);

    /// A pixel of the picture.
    struct Shown {
        double luminance_cd_m2 = 0, standard_error_cd_m2 = 0;
    };
    /// The root mean square of the pixels' biases, relative to their values. `at_most` contains the noise of
    /// the picture. `shown`: of any pixel.
    struct Bias {
        double at_least = 0, at_most = 0;
    };
    Bias bias_of(const std::function<Shown(std::size_t pixel)>& shown) const;

  private:
    std::vector<std::size_t> pixels_;
    std::vector<double> traced_cd_m2_;  ///< replicates x pixels
};

}  // namespace stilb::run
