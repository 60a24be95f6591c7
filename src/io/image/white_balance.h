// White balance: what a picture takes for white, and the adaptation of its colours to the screen's white.
#pragma once

#include <array>
#include <vector>

#include "base/rgb.h"
#include "io/image/picture.h"
#include "scene/whites.h"

namespace stilb::io {

/// The luminances of a picture that are above 0 and finite.
class PictureLuminances {
  public:
    explicit PictureLuminances(const Picture& picture);

    bool empty() const { return values_.empty(); }
    /// The luminance that this share of them does not exceed; there must be some.
    double quantile(double share);

  private:
    std::vector<double> values_;
};

/// The white of a picture: the mixture of the warmest and the coolest white whose chromaticity is nearest to
/// the picture's mean, in CIE 1960 (u, v). A tenth of the pixels, the brightest, count as if they were no
/// brighter than all others. Where both ends are equal, the picture does not matter, and all views of a scene
/// have the same white.
Rgb choose_white(const Picture& picture, const scene::WhiteRange& whites);

/// Changes colours so that `white` becomes the screen's white (D65), by the linear Bradford transform [Lam
/// 1985; ICC.1:2022, annex E]: the responses of three sharpened kinds of cones are divided by those to white.
/// Linear Rec. 709; components below 0 are colours that it does not have.
class ChromaticAdaptation {
  public:
    /// `white`: luminance above 0. Its luminance stays.
    explicit ChromaticAdaptation(const Rgb& white);
    Rgb operator()(const Rgb& rgb) const;

  private:
    std::array<Rgb, 3> rows_;
};

}  // namespace stilb::io
