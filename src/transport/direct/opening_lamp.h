// A surface whose luminance depends on direction, such as the opening of a luminaire: its light on diffuse
// receivers is integrated once, where all of it is seen.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "math/gauss_legendre.h"
#include "scene/scene.h"
#include "transport/direct/lamp_hull.h"
#include "transport/light_sampler.h"

namespace stilb::transport {

/// Keeps a reference to the lights.
class OpeningLamp {
  public:
    /// Of a light of the scene; nothing where it has no such surface, or one of too many elements.
    static std::optional<OpeningLamp> of(const Scene& scene, std::size_t light, const LightSampler& lights,
                                         const Lift& lift);

    std::size_t light() const { return light_; }
    const LampHull& hull() const { return hull_; }
    /// Whether some element's front faces the point, on the side that it faces.
    bool may_light(const SurfacePoint& at) const;
    /// The illuminance without shadows, by quadrature: two rules, of which the second has twice as many nodes
    /// in each direction, agree to kAgreement. Nothing where no two of them do: close to the opening, or
    /// where it reaches below the horizon.
    std::optional<Rgb> illuminance_lx(const SurfacePoint& at) const;

    static constexpr double kAgreement = 5e-5;

  private:
    OpeningLamp(std::size_t light, const LightSampler& lights, ObjectId object,
                std::vector<lights::EmitterElement> elements, const Lift& lift)
        : light_(light), lights_(lights), elements_(std::move(elements)), hull_(object, elements_, lift) {}
    Rgb sum_lx(const SurfacePoint& at, const math::GaussLegendre& rule) const;

    std::size_t light_;  ///< its number
    const LightSampler& lights_;
    std::vector<lights::EmitterElement> elements_;
    LampHull hull_;
};

}  // namespace stilb::transport
