// The colours of a false-colour picture.
#pragma once

#include <vector>

#include "io/image/tone_curve.h"

namespace stilb::plot {

/// From almost black over blue, magenta and orange to pale yellow. Lightness grows all the way, so that the
/// order survives grey print and colour blindness, and equal steps of the argument are equal steps in OKLab.
class ColourMap {
  public:
    ColourMap();

    /// The colour at 0 (least) to 1 (most); what lies outside gets the end's colour.
    io::Colour at(double fraction) const;

  private:
    /// At equal distances along the curve, both ends included.
    std::vector<io::Oklab> samples_;
};

}  // namespace stilb::plot
