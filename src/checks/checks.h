// What is odd about a scene: holes, overlaps, sensors and lights behind walls, objects without light.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geometry/mesh_topology.h"
#include "rays/ray_caster.h"
#include "scene/scene.h"
#include "sensors/sensor.h"

namespace stilb::checks {

// The closed spaces of a scene, and which of them light is in: surfaces let no light through.

/// A closed shell of an object.
struct ComponentId {
    ObjectId object{};
    std::uint32_t shell = 0;

    auto operator<=>(const ComponentId&) const = default;
};

/// The closed shells that a point lies in, sorted. Two points with different ones have a surface between them
/// on every way.
using Enclosure = std::vector<ComponentId>;

/// A point (lifted off whatever it lies on) and a direction into the open from there.
struct ProbeRay {
    Vec3 position, direction;
};

/// Keeps references to both arguments. Immutable.
class Enclosures {
  public:
    Enclosures(const Scene& scene, const rays::RayCaster& caster);

    /// The space of a light that the point sees; or else by the parity of the hits along three rays into the
    /// hemisphere of the outlook's direction, of which two decide.
    Enclosure enclosure_of(const ProbeRay& probe_ray) const;
    /// Per light, the spaces that its rays start in: one for points, one for every shell of an emitting
    /// object, what no shell encloses for light from infinity.
    const std::vector<std::vector<Enclosure>>& of_lights() const { return of_lights_; }
    /// Some light starts there.
    bool is_lit(const Enclosure& space) const;

    /// Of every object.
    const std::vector<geometry::ConnectedComponents>& shells() const { return shells_; }

  private:
    struct LightPlace {
        Vec3 position;
        Enclosure space;
    };

    std::vector<ProbeRay> probe_rays_of(const Light& light) const;
    Enclosure voted_enclosure(const ProbeRay& probe_ray) const;
    Enclosure crossed_an_odd_number_of_times(const Vec3& origin, const Vec3& direction) const;

    const Scene& scene_;
    const rays::RayCaster& caster_;
    std::vector<geometry::ConnectedComponents> shells_;
    std::vector<std::vector<Enclosure>> of_lights_;
    std::vector<LightPlace> tried_;  ///< the lights that a point is tried to see
};

// Surfaces that were probably meant to be closed.

/// A sentence for each object with shells that are open but nearly enclose a space: light goes through their
/// holes. And one for emitters whose triangles do not all face the same side. `shells` are those of every
/// object.
std::vector<std::string> hole_warnings(const Scene& scene,
                                       const std::vector<geometry::ConnectedComponents>& shells);

// Surfaces that lie in one another.

/// Two triangles that lie over each other in one plane and do not look alike: rounding decides which of them
/// a ray meets.
struct Overlap {
    ObjectId first{}, second{};
    Vec3 position, normal;  ///< the middle of what they share; unit normal of the plane
};

/// Pairs of triangles in the same plane (to a few parts in a million of the scene's size) that share more
/// than a thousandth of the smaller one, and differ in material or emission. Ends after the first
/// kMostOverlaps.
std::vector<Overlap> find_overlaps(const Scene& scene);
inline constexpr std::size_t kMostOverlaps = 1000;

/// A sentence for each pair of objects that overlap where light comes: not for the bottom of a cabinet in the
/// floor.
std::vector<std::string> overlap_warnings(const Scene& scene, const rays::RayCaster& caster,
                                          const Enclosures& spaces);

// Mistakes in where sensors and lights stand: closed surfaces between them.

/// A sentence for every sensor with points that no light can reach, because a closed surface lies around the
/// point and no light in it (or around all lights and not the point), and for every light that likewise
/// reaches no point of any sensor. And for every sensor with bodies that lie on surfaces.
std::vector<std::string> placement_warnings(const Scene& scene, const rays::RayCaster& caster,
                                            std::span<const Sensor> sensors);

// Objects that no light reaches.

/// The objects that no light reaches, in the order of the scene; emitters are never among them. Light
/// particles are traced over some diffuse reflections; what they do not hit is looked at from where they
/// were. An object may be named wrongly only where almost no light gets to it.
std::vector<ObjectId> unlit_objects(const Scene& scene, const rays::RayCaster& caster);

// All of it.

/// What all checks warn of, in sentences for users.
std::vector<std::string> scene_warnings(const Scene& scene, const rays::RayCaster& caster,
                                        const Enclosures& enclosures, std::span<const Sensor> sensors);

}  // namespace stilb::checks
