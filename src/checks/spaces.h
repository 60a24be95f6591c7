// The closed spaces of a scene, and which of them light is in: surfaces let no light through.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "geometry/shells.h"
#include "rays/ray_caster.h"
#include "scene/scene.h"

namespace stilb {

/// A closed shell of an object.
struct ShellId {
    ObjectId object{};
    std::uint32_t shell = 0;

    auto operator<=>(const ShellId&) const = default;
};

/// The closed shells that a point lies in, sorted. Two points with different ones have a surface between them
/// on every way.
using Space = std::vector<ShellId>;

/// A point (lifted off whatever it lies on) and a direction into the open from there.
struct Outlook {
    Vec3 position, direction;
};

/// Keeps references to both arguments. Immutable.
class Spaces {
  public:
    Spaces(const Scene& scene, const RayCaster& caster);

    /// The space of a light that the point sees; or else by the parity of the hits along three rays into the
    /// hemisphere of the outlook's direction, of which two decide.
    Space space_of(const Outlook& outlook) const;
    /// Per light, the spaces that its rays start in: one for point-like lights, one for every shell of an
    /// emitting object.
    const std::vector<std::vector<Space>>& of_lights() const { return of_lights_; }
    /// Some light starts there.
    bool is_lit(const Space& space) const;

    /// Of every object.
    const std::vector<Shells>& shells() const { return shells_; }

  private:
    struct LightPlace {
        Vec3 position;
        Space space;
    };

    std::vector<Outlook> outlooks_of(const Light& light) const;
    Space voted_space(const Outlook& outlook) const;
    Space crossed_an_odd_number_of_times(const Vec3& origin, const Vec3& direction) const;

    const Scene& scene_;
    const RayCaster& caster_;
    std::vector<Shells> shells_;
    std::vector<std::vector<Space>> of_lights_;
    std::vector<LightPlace> tried_;  ///< the lights that a point is tried to see
};

}  // namespace stilb
