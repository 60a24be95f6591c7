// The closed spaces of a scene, and which of them light is in: surfaces let no light through.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "geometry/mesh_topology.h"
#include "rays/ray_caster.h"
#include "scene/scene.h"

namespace stilb::checks {

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

}  // namespace stilb::checks
