// Light sources. Photometric quantities are per band: luminance() of an intensity is candela, and so on.
#pragma once

#include <string>
#include <variant>

#include "base/ids.h"
#include "base/rgb.h"
#include "base/vec.h"

namespace stilb::lights {

/// Isotropic.
struct PointLight {
    Vec3 position;
    Rgb intensity_cd;
};

/// A luminaire with an intensity distribution, small against its distance from everything.
struct Luminaire {
    Vec3 position;
    SolidId solid{};
    /// Columns of the luminaire's frame in world coordinates: towards C0, towards C90, towards the nadir.
    Vec3 c0, c90, nadir;
    /// Multiplies the solid's intensity: colour (luminance 1) times dimming or flux override.
    Rgb factor;
};

/// One-sided diffuse emitter on the front of an object. A luminous sphere is one on a sphere.
struct AreaLight {
    ObjectId object{};
    Rgb luminance_cd_m2;
};

struct Light {
    std::string name;
    std::variant<PointLight, Luminaire, AreaLight> source;
};

}  // namespace stilb::lights

namespace stilb {
using lights::AreaLight;
using lights::Light;
using lights::Luminaire;
using lights::PointLight;
}  // namespace stilb
