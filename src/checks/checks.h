// Warnings about a scene: holes, overlaps, units, lamps by mistake, sensors and lights in the wrong place or
// turned the wrong way, objects without light.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/warning.h"
#include "geometry/mesh_topology.h"
#include "rays/ray_caster.h"
#include "scene/overlaps.h"
#include "scene/scene.h"
#include "sensors/sensor.h"

namespace stilb::checks {

/// The findings that need no rays. They are the same for all sensors.
struct SceneFindings {
    explicit SceneFindings(const Scene& scene);

    /// A lamp that was cut out of a mesh.
    struct CutLamp {
        ObjectId from{};
        std::vector<std::uint32_t> component_of_triangle;  ///< of the whole mesh
    };

    /// Of every object; a mesh is closed where the lamps that were cut out of it close it.
    std::vector<geometry::ConnectedComponents> components;
    std::map<ObjectId, CutLamp> cut_lamps;
    std::vector<std::string> units, holes;  ///< unit_warnings(), hole_warnings()
    std::vector<Overlap> overlaps;          ///< the first kMostOverlaps of all surfaces

  private:
    void join_cut_lamps(const Scene& scene);
};

// The enclosures of a scene, and those that contain lights: surfaces block light.

/// A closed connected component of an object.
struct ComponentId {
    ObjectId object{};
    std::uint32_t component = 0;

    auto operator<=>(const ComponentId&) const = default;
};

/// The closed components that enclose a point, sorted. Where they differ for two points, every path between
/// the points crosses a surface.
using Enclosure = std::vector<ComponentId>;

/// Keeps references to scene and caster. Immutable.
class Enclosures {
  public:
    /// `findings`: those in the scene, where they are known.
    Enclosures(const Scene& scene, const rays::RayCaster& caster,
               std::shared_ptr<const SceneFindings> findings = nullptr);

    /// The enclosure of a light that the point sees. Else by the parity of the surfaces that three rays into
    /// the hemisphere of its normal cross, by majority.
    Enclosure enclosure_of(const SurfacePoint& point) const;
    /// The enclosures where each light's rays start: one for points, those around the parts of an emitting
    /// object, the outside of all components for light from infinity.
    const std::vector<std::vector<Enclosure>>& of_lights() const { return of_lights_; }
    /// Whether a light's rays start there.
    bool is_lit(const Enclosure& enclosure) const;

    const SceneFindings& findings() const { return *findings_; }
    const std::vector<geometry::ConnectedComponents>& components() const { return findings_->components; }
    /// Starts of the light's rays: the first from its first component, others from all of its parts.
    std::vector<SurfacePoint> starts_of(const Light& light) const;

  private:
    struct TriedLight {
        Vec3 position;
        Enclosure enclosure;
    };

    /// The component that a ray crosses, if it is closed.
    std::optional<ComponentId> closed_component(const rays::Crossing& crossing) const;
    Enclosure voted_enclosure(const SurfacePoint& point) const;
    Enclosure crossed_an_odd_number_of_times(const Vec3& origin, const Vec3& direction) const;

    const Scene& scene_;
    const rays::RayCaster& caster_;
    std::shared_ptr<const SceneFindings> findings_;
    std::vector<std::vector<Enclosure>> of_lights_;
    std::vector<TriedLight> tried_;  ///< the lights whose visibility from a point is tested
};

// Surfaces that were probably meant to be closed.

/// A sentence for each object with components that are open but nearly closed: light passes through their
/// holes. And one for emitters whose triangles do not all face the same side. `components`: those of every
/// object.
std::vector<std::string> hole_warnings(const Scene& scene,
                                       const std::vector<geometry::ConnectedComponents>& components);

// Overlapping surfaces.

/// The search ends after so many: the rest would not change what the user has to do.
inline constexpr std::size_t kMostOverlaps = 1000;

/// A sentence for each pair of objects that overlap in one plane where light arrives: not for the bottom of a
/// cabinet on the floor. And one for each lamp in the plane of another object: it counts as being in front
/// (scene/overlaps.h).
std::vector<std::string> overlap_warnings(const Scene& scene, const rays::RayCaster& caster,
                                          std::span<const Overlap> overlaps, std::span<const Sensor> sensors);

// Lamps that were probably not meant.

/// A sentence for lights of the same kind and distribution in one place, and one for each area light whose
/// whole object is a closed mesh or box, or surrounds a sensor: a room, say, of which only a part was meant
/// to shine.
std::vector<std::string> lamp_warnings(const Scene& scene, const rays::RayCaster& caster,
                                       const std::vector<geometry::ConnectedComponents>& components,
                                       std::span<const Sensor> sensors);

/// A sentence for the luminaires whose luminous opening is larger or smaller than that of any luminaire: its
/// size is that of another unit.
std::vector<std::string> opening_warnings(const Scene& scene);

// Misplaced sensors and lights.

/// Where the light of the sensor's first reading arrives, and from which side; of a camera, that of its
/// middle.
SurfacePoint first_point_of(const Sensor& sensor, const rays::RayCaster& caster);

/// Lights and sensors that a warning names already: later checks leave them out, one message for one mistake.
struct Explained {
    std::vector<bool> lights, sensors;

    Explained(const Scene& scene, std::span<const Sensor> all_sensors)
        : lights(scene.lights.size()), sensors(all_sensors.size()) {}
};

/// A sentence for every sensor with points that no light can reach, because a closed surface separates
/// them from all lights, and for every light that likewise
/// reaches no point of any sensor. And for every sensor with bodies that lie on surfaces.
std::vector<std::string> placement_warnings(const Scene& scene, const rays::RayCaster& caster,
                                            const Enclosures& enclosures, std::span<const Sensor> sensors,
                                            Explained& explained);

/// A sentence for every area light and luminaire whose front is close to a surface that stops its light, and
/// for every illuminance sensor whose normal points to a surface close by, or into the surface that it lies
/// on, away from the lamps.
std::vector<std::string> facing_warnings(const Scene& scene, const rays::RayCaster& caster,
                                         std::span<const Sensor> sensors, Explained& explained);

/// A sentence for the lights of which nothing reaches any sensor, and one for the sensors that no light
/// reaches. Without sensors one for the lights whose light meets no surface. Random walks from both sides are
/// connected, over some diffuse reflections at each side: where they find no connection, hardly any light
/// gets through. Of many lights and sensors only a part is tested.
std::vector<std::string> reach_warnings(const Scene& scene, const rays::RayCaster& caster,
                                        std::span<const Sensor> sensors, const Explained& explained);

// Points that belong to no area.

/// The sensors, without those points of areas that are not measured, because they stand inside of a body or
/// outside of the room (a closed surface separates them from all lights, but not all points of the area), or
/// a surface covers them. The areas count them. Throws InputError where all of an area is covered.
std::vector<Sensor> without_hidden_points(const Scene& scene, const rays::RayCaster& caster,
                                          const Enclosures& enclosures, std::span<const Sensor> sensors);

// Far away.

/// A sentence for each sensor that lies so far from the others that rays are coarse beside the surfaces
/// around it (docs/ray-queries.md).
std::vector<std::string> precision_warnings(const rays::RayCaster& caster, std::span<const Sensor> sensors);

// Objects that no light reaches.

/// The objects that no light reaches, in the order of the scene; emitters are never among them. Light
/// particles are traced over some diffuse reflections; surfaces that they do not hit are then connected to
/// the positions of the particles. A lit object can be listed only where almost no light reaches it.
std::vector<ObjectId> unlit_objects(const Scene& scene, const rays::RayCaster& caster);
/// One sentence for all of them.
std::vector<std::string> unlit_warnings(const Scene& scene, const rays::RayCaster& caster);

// Light that finds no end.

/// A sentence where nothing absorbs the light of the lamps, as far as random walks find: a closed room with
/// reflectances of 1. Without a limit on reflections there is no result.
std::optional<std::string> endless_light(const Scene& scene, const rays::RayCaster& caster);
/// This sentence, or one where the surfaces around the lamps absorb nearly nothing.
std::vector<std::string> absorption_warnings(const Scene& scene, const rays::RayCaster& caster);

// Units.

/// A sentence where the meshes are so large on all sides that their file is probably not in metres.
std::vector<std::string> unit_warnings(const Scene& scene);

// All checks.

/// The warnings of all checks, after those that the reader of the scene has given. `sensors`: those that are
/// measured, or none.
std::vector<Warning> scene_warnings(const Scene& scene, const rays::RayCaster& caster,
                                    const Enclosures& enclosures, std::span<const Sensor> sensors,
                                    std::vector<Warning> of_reader = {});

}  // namespace stilb::checks
