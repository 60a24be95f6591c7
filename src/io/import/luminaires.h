// Lights of other formats that scene files describe by a file: spots and the sun.
#pragma once

#include <memory>
#include <vector>

#include "lights/environment.h"
#include "lights/luminaire.h"
#include "lights/photometric_solid.h"

namespace stilb::io {

/// A spot that shines with 1 cd within `inner_deg` of its axis and falls to 0 at `outer_deg` as the glTF
/// extension KHR_lights_punctual recommends: by the square of the cosine's share of its range.
PhotometricSolid::Grid spot_grid(double inner_deg, double outer_deg);

/// A luminaire's frame for axes of a node: nadir along `nadir`, C0 as near to `c0` as it can be.
lights::LuminaireFrame luminaire_frame(const Vec3& nadir, const Vec3& c0);

/// Light from a direction, in place of which a small disk of the sky shines.
struct DistantLight {
    Vec3 towards;        ///< unit, towards the light
    Rgb illuminance_lx;  ///< of a surface that faces it
};
/// All of them as one environment, black elsewhere: each is a pixel of half a degree, about the size of the
/// sun. The first has its direction exactly, the others to a quarter of a degree in both angles.
EnvironmentLight distant_lights(const std::vector<DistantLight>& lights);

}  // namespace stilb::io
