// What a luminance meter looks at: lines of sight, on through mirrors and glass to surfaces that scatter.
#pragma once

#include <optional>
#include <vector>

#include "materials/shaded_surface.h"
#include "rays/ray_caster.h"
#include "sensors/sensor.h"
#include "transport/light_sampler.h"

namespace stilb::transport {

/// A surface point that is seen, perhaps through mirrors and glass: z of double local estimation.
struct SubPoint {
    rays::Hit surface;  ///< not specular
    Vec3 outgoing;      ///< unit, along which light leaves it towards the sensor
    /// What is left of the luminance on its way to the sensor.
    Rgb transmission = Rgb::grey(1);
    int reflections = 0;  ///< and passages of glass, between it and the sensor
};

/// A way through mirrors and glass that is not followed on because too little light comes along it.
struct FaintRay {
    Vec3 origin, direction;
    Rgb transmission;
    int reflections = 0;
};

/// All that a sensor sees along a line of sight.
struct VisibleSurfaces {
    std::optional<rays::Hit> first;    ///< first_surface()
    std::vector<SubPoint> sub_points;  ///< the one that most light comes from first
    std::vector<FaintRay> faint;
    Rgb emission_cd_m2;  ///< that is seen, of surfaces and from outside, but along the faint ways
    /// The sub-point that most light comes from, or the mirror at which the limit of reflections ends the
    /// line of sight; nothing where it leaves the scene.
    std::optional<Vec3> end;
};

/// The surface that a line of sight meets first, or that an emergent ray leaves; nothing in the void.
std::optional<rays::Hit> first_surface(const Measurand& luminance, const rays::RayCaster& caster);
/// The unit direction that it is looked at along.
Vec3 looking_direction(const Measurand& luminance);

/// Follows the line of sight of a luminance reading, at most `max_reflections` times at mirrors and glass.
/// Where glass divides it, it follows both ways.
VisibleSurfaces look(const Measurand& luminance, const Scene& scene, const rays::RayCaster& caster,
                     const LightSampler& lights, int max_reflections);

// Ways of light on from mirrors and glass, in the scene.

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
