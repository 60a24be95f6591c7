// How a luminaire hangs in the scene.
#pragma once

#include "base/vec.h"

namespace stilb::lights {

/// Unit vectors of a luminaire's (left-handed) frame in the scene: towards C0, C90 and the nadir.
struct LuminaireFrame {
    Vec3 c0, c90, nadir;
};

/// A luminaire that hangs straight down (nadir -z, C0 +x, C90 +y) is first turned about its vertical axis by
/// `spin_deg`, counterclockwise seen from behind, which is from above; then its nadir is turned to `unit_aim`
/// on the shortest way. For an aim of exactly +z that way is a half turn about the x axis.
LuminaireFrame aim_luminaire(const Vec3& unit_aim, double spin_deg);

}  // namespace stilb::lights
