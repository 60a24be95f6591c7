// Random walks through a scene, for checks that ask where light gets at all.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/names.h"
#include "math/random.h"
#include "rays/ray_caster.h"
#include "scene/scene.h"

namespace stilb::checks {

/// The points and objects that random walks have reached. The normal of a lamp's point is the direction of a
/// particle from there, which goes into the half space that the lamp shines into.
struct Trail {
    std::vector<SurfacePoint> points;
    std::vector<bool> is_object_met;
    bool leaves_scene = false;

    explicit Trail(const Scene& scene) : is_object_met(scene.objects.size()) {}
};

/// Follows a ray over some reflections. All surfaces count as diffuse reflectors, even black
/// ones: only the geometry matters. Through glass and panes every second walk goes on.
void follow_walk(const Scene& scene, const rays::RayCaster& caster, rays::Ray ray, int reflections,
                 math::SampleStream& stream, Trail& trail);

/// Where particles of all lights get: those of some hundred, in proportion to flux.
std::vector<SurfacePoint> lit_places(const Scene& scene, const rays::RayCaster& caster);

/// Whether nothing but panes is between two points that lie on each other's sides.
bool sees(const SurfacePoint& from, const SurfacePoint& to, const rays::RayCaster& caster);

}  // namespace stilb::checks
