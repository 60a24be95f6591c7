// Views in the words of Radiance's options.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "sensors/camera.h"

namespace stilb::io {

/// A view as options give it: "-vtv -vp 0 0 1.5 -vd 1 0 0 -vu 0 0 1 -vh 60 -vv 36". The defaults are
/// Radiance's.
struct RadianceView {
    /// v: perspective, a: angular fisheye, h: hemispherical fisheye, s: planispheric fisheye, l: parallel, c:
    /// cylindrical.
    char type = 'v';
    Vec3 position, direction{0, 1, 0}, up{0, 0, 1};
    double horizontal_deg = 45, vertical_deg = 45;
    double shift = 0, lift = 0;        ///< of the picture off its axis, in widths and heights
    double fore_m = 0, aft_m = 0;      ///< distances where surfaces begin and end to be seen; 0: all are
    std::optional<int> width, height;  ///< most pixels of the picture (-x, -y)

    /// Takes over the options of a line; other options are skipped. Returns whether one of a view was among
    /// them. Throws InputError, without a place, where a value is missing or no number.
    bool read(std::string_view words);

    /// Height / width of the picture. Throws InputError, without a place, where there is none.
    double aspect() const;
    /// The camera without its resolution; shift, lift, fore and aft are left out. Nothing where the type is
    /// neither perspective nor angular fisheye. Throws InputError, without a place, where angle or axes do
    /// not make a view.
    std::optional<Camera> camera() const;
};

}  // namespace stilb::io
