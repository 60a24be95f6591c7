// Ways of light on from mirrors and glass, in the scene.
#pragma once

#include <optional>
#include <vector>

#include "materials/shaded_surface.h"
#include "rays/ray_caster.h"

namespace stilb::transport {

using materials::Carried;

struct SpecularRay {
    Vec3 origin;  ///< off the surface, on the side that the way goes to
    Vec3 direction;
    Rgb share;                    ///< of the flux; as SpecularBranch has it
    double luminance_factor = 1;  ///< likewise
    /// Through a pane: straight on, so that such light counts as not reflected, and shadow rays make it too.
    bool straight = false;
};

/// All ways on from `hit` on a specular surface of a path that carries luminance; `from`: unit, towards where
/// the path came from.
std::vector<SpecularRay> specular_rays(const Material& material, const rays::Hit& hit, const Vec3& from);

/// One of them, drawn in proportion to its luminous share by `u` in [0, 1); the share is divided by the
/// probability. Nothing where all light is absorbed.
std::optional<SpecularRay> choose_specular_ray(const Material& material, const rays::Hit& hit,
                                               const Vec3& from, Carried carried, double u);

}  // namespace stilb::transport
