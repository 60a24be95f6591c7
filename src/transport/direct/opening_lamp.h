// A luminaire's opening whose light on diffuse receivers is integrated once, where all of it is seen.
#pragma once

#include <optional>
#include <vector>

#include "lights/luminous_opening.h"
#include "lights/solid_angle/projected_solid_angle.h"
#include "math/gauss_legendre.h"
#include "scene/scene.h"
#include "transport/direct/lamp_hull.h"

namespace stilb::transport {

/// Keeps a reference to the scene's photometric solids.
class OpeningLamp {
  public:
    /// Nothing where the light is no opening, or has too many elements.
    static std::optional<OpeningLamp> of(const Scene& scene, const Light& light, const Lift& lift);

    const LampHull& hull() const { return hull_; }
    /// Whether some element's front faces the point, on the side that it faces.
    bool may_light(const SurfacePoint& at) const;
    /// The illuminance without shadows, by quadrature: two rules, of which the second has twice as many nodes
    /// in each direction, agree to kAgreement. Nothing where no two of them do: close to the opening, or
    /// where it reaches below the horizon.
    std::optional<Rgb> illuminance_lx(const SurfacePoint& at) const;
    /// The light from a point of the front that is drawn about by solid angle.
    std::optional<LampSample> sample(const SurfacePoint& at, math::SampleStream& stream) const;

    static constexpr double kAgreement = 5e-5;

  private:
    OpeningLamp(const Scene& scene, const LuminousOpening& opening, const Lift& lift);
    Rgb sum_lx(const SurfacePoint& at, const math::GaussLegendre& rule) const;

    lights::OpeningEmitter emitter_;
    std::vector<lights::EmitterElement> elements_;
    LampHull hull_;
};

}  // namespace stilb::transport
