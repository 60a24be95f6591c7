// Lines of sight of luminance sensors, followed through mirrors and glass to surfaces that scatter.
#pragma once

#include <optional>
#include <vector>

#include "materials/shaded_surface.h"
#include "rays/ray_caster.h"
#include "sensors/sensor.h"
#include "transport/light_sampler.h"

namespace stilb::transport {

/// A visible surface point, possibly seen through mirrors and glass: z of double local estimation.
struct SubPoint {
    rays::Hit surface;  ///< not specular; where light arrives
    Vec3 outgoing;      ///< unit, in which light leaves it towards the sensor; as a lobe takes it
    /// The transmittance of mirrors and glass between it and the sensor.
    Rgb transmission = Rgb::grey(1);
    int reflections = 0;  ///< and passages of glass, between it and the sensor
    /// By which the surface scatters light; null where its material is not composed.
    const materials::Lobe* lobe = nullptr;
};

/// A specular branch that is not followed because it carries too little light.
struct FaintRay {
    Vec3 origin, direction;
    Rgb transmission;
    int reflections = 0;
};

/// The surfaces visible along a line of sight.
struct VisibleSurfaces {
    std::optional<rays::Hit> first;    ///< first_surface()
    std::vector<SubPoint> sub_points;  ///< the one with most light first
    std::vector<FaintRay> faint;
    Rgb emission_cd_m2;  ///< emission seen on surfaces and from outside, without the faint branches
    LightParts parts;    ///< of the emission
    /// The sub-point with most light, or the mirror at which the limit of reflections ends the
    /// line of sight; nothing where it leaves the scene.
    std::optional<Vec3> end;
};

/// The first surface along a line of sight, or the surface of an emergent ray; nothing where the scene is
/// left.
std::optional<rays::Hit> first_surface(const Measurand& luminance, const rays::RayCaster& caster);
/// The unit viewing direction.
Vec3 viewing_direction(const Measurand& luminance);

/// Follows the line of sight of a luminance reading, over at most `max_reflections` interactions with mirrors
/// and glass. Where glass splits it, it follows both branches.
VisibleSurfaces trace_line_of_sight(const Measurand& luminance, const Scene& scene,
                                    const rays::RayCaster& caster, const LightSampler& lights,
                                    int max_reflections);

// Specular branches in the scene.

using materials::Carried;

struct SpecularRay {
    Vec3 origin;  ///< off the surface, on the side of the branch
    Vec3 direction;
    Rgb share;                    ///< of the flux; as in SpecularBranch
    double luminance_factor = 1;  ///< likewise
    /// True through a pane: such light counts as not reflected, and shadow rays find it, too.
    bool straight = false;
};

/// All branches at `hit` on a specular surface of a path that carries luminance; `from`: unit, towards the
/// previous vertex.
std::vector<SpecularRay> specular_rays(const Material& material, const rays::Hit& hit, const Vec3& from);

/// One branch, sampled in proportion to its luminous share by `u` in [0, 1); the share is divided by the
/// probability. Nothing where all light is absorbed.
std::optional<SpecularRay> choose_specular_ray(const Material& material, const rays::Hit& hit,
                                               const Vec3& from, Carried carried, double u);

}  // namespace stilb::transport
