// The colours of false-colour pictures.
#pragma once

#include <cstddef>
#include <vector>

#include "io/image/tone_curve.h"

namespace stilb::io {

/// From almost black over blue, magenta and orange to pale yellow. Lightness increases monotonically, so that
/// the order survives grey print and colour blindness, and equal steps of the argument are equal steps in
/// OKLab.
class ColourMap {
  public:
    /// Colours between which the page of `stilb view` interpolates, both ends included.
    static constexpr std::size_t kSamples = 257;

    ColourMap();

    /// The colour at 0 (least) to 1 (most); values outside get the end's colour.
    Colour at(double fraction) const;

  private:
    /// Colours at equal distances along the curve, both ends included.
    std::vector<Oklab> samples_;
};

}  // namespace stilb::io
