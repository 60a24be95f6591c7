// The white light of a scene: what a picture of it may take for white.
#pragma once

#include "base/rgb.h"
#include "scene/scene.h"

namespace stilb::scene {

/// Colours of luminance 1, linear Rec. 709; both the same where all white light has one colour.
struct WhiteRange {
    Rgb warmest = Rgb::grey(1);
    Rgb coolest = Rgb::grey(1);
};

/// The colours of the lights that are white: within 0.01 of black bodies and daylight of 1800 K and more in
/// CIE 1960 (u, v). Coloured light is left out, and so are the warmest and the coolest twentieth of the
/// lamps' white flux, which hardly count. An environment's flux is that into the whole scene, most of which
/// may never enter a room: it belongs to the range where it is more than a twentieth of all flux. The
/// screen's white where no light is white.
WhiteRange whites_of_lights(const Scene& scene);

}  // namespace stilb::scene
