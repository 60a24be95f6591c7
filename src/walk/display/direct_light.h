// The illuminance of surface points by each light, shadows included.
//
//     E = integral over the light's directions of L cos+ T dw
//
// with the transmittance T of shadow rays: 0 behind surfaces, and that of panes. Point-like lights take one
// shadow ray. Other lights take the first points of a (0, 2)-sequence: the same ones at all surface points,
// so that the remaining error varies slowly over a surface, and more of them where some are hidden. Standard
// errors come from groups of consecutive points, each of which is a net by itself: they are somewhat too
// large, as the whole net is more even than its parts.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "rays/ray_caster.h"
#include "scene/scene.h"
#include "transport/light_sampler.h"

namespace stilb::walk {

/// Keeps references to scene and caster. Immutable.
class DirectLight {
  public:
    DirectLight(const Scene& scene, const rays::RayCaster& caster);

    /// The number of lights, in the order of Scene::lights.
    std::size_t count() const { return sampler_.count(); }
    /// Adds `share` times the illuminance by each light, luminance-weighted [lx], to `sums`; returns the
    /// squared standard error of what it adds [lx2].
    double add(const SurfacePoint& point, double share, std::span<float> sums) const;

  private:
    /// The first number of points on a light, and the number where that is not enough.
    struct Effort {
        std::size_t few = 1, many = 1;
    };
    struct Estimate {
        double lx = 0, squared_error = 0;
        bool is_partly_hidden = false;
    };
    Estimate by_point_light(std::size_t light, const SurfacePoint& point) const;
    Estimate by_extended_light(std::size_t light, const SurfacePoint& point) const;
    Estimate by_points(std::size_t light, const SurfacePoint& point, std::size_t points) const;

    const rays::RayCaster& caster_;
    transport::LightSampler sampler_;
    std::vector<Effort> efforts_;                 ///< per light
    std::vector<std::array<double, 2>> pattern_;  ///< of points on extended lights
};

}  // namespace stilb::walk
