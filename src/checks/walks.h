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

/// A lifted point and the normal on its side, or a direction into the half space that belongs to it.
struct Location {
    Vec3 position, normal;
};

/// The places and objects that random walks have reached.
struct Trail {
    std::vector<Location> locations;
    std::vector<bool> is_object_met;
    bool leaves_scene = false;

    explicit Trail(const Scene& scene) : is_object_met(scene.objects.size()) {}
};

/// Follows a ray from a location over some reflections. All surfaces count as diffuse reflectors, even black
/// ones: only the geometry matters. Through glass and panes every second walk goes on.
void follow_walk(const Scene& scene, const rays::RayCaster& caster, const Location& start, Vec3 direction,
                 int reflections, math::SampleStream& stream, Trail& trail);

/// Where particles of all lights get: those of some hundred, in proportion to flux.
std::vector<Location> lit_places(const Scene& scene, const rays::RayCaster& caster);

/// Whether nothing but panes is between two locations that lie on each other's sides.
bool sees(const Location& from, const Location& to, const rays::RayCaster& caster);

}  // namespace stilb::checks
