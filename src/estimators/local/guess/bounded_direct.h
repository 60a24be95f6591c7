// Direct light at surface points, in two parts. Next-event estimation brings light of point lights with the
// share min(1, d^2 / a^2) at the distance d, so that it is bounded, and other light as it is. Particles of
// the point lights bring the rest, on the surfaces close to these lights: luminaires' own bodies, mostly.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "math/random.h"
#include "rays/ray_caster.h"
#include "transport/light_sampler.h"

namespace stilb::estimators {

/// Light that arrives at a surface.
struct Arrival {
    Vec3 direction;  ///< unit, towards the light
    Rgb illuminance_lx;
    std::uint32_t light = 0;  ///< of Scene::lights
};

/// Keeps references to its arguments. Immutable.
class BoundedDirect {
  public:
    BoundedDirect(const Scene& scene, const rays::RayCaster& caster, const transport::LightSampler& lights);

    enum class Part { bounded, all };
    /// Calls `visit(arrival)` for so many samples of the first part, or of all direct light, divided by their
    /// number (a power of two): of every light, spread evenly over it, or, where lights are many, of kEach
    /// times so many, which are chosen. Where all lights are points, one sample of each that is not chosen:
    /// all samples of it would be the same.
    template <typename Visit>
    void sample(const SurfacePoint& at, Part part, std::uint32_t samples, math::SampleStream& stream,
                const Visit& visit) const;

    /// A particle of the second part: its flux, and the surface that it meets.
    struct Particle {
        rays::Hit hit;
        Vec3 direction;
        Rgb flux_lm;
        double favour = 1;        ///< as in transport::EmittedParticle
        std::uint32_t light = 0;  ///< of Scene::lights
    };
    /// Nothing where it is not close to its light.
    std::optional<Particle> sample_particle(math::SampleStream& stream) const;
    bool has_particles() const { return has_points_; }

  private:
    static constexpr std::uint32_t kEach = 4;

    double share(double squared_distance) const { return std::min(1.0, squared_distance / near_m2_); }
    template <typename Visit>
    void add(const std::optional<lights::IncidentLight>& light, double weight, const SurfacePoint& at,
             Part part, const Visit& visit) const;

    const rays::RayCaster& caster_;
    const transport::LightSampler& lights_;
    double near_m2_;  ///< a^2
    bool has_points_;
};

template <typename Visit>
void BoundedDirect::sample(const SurfacePoint& at, Part part, std::uint32_t samples,
                           math::SampleStream& stream, const Visit& visit) const {
    const bool are_points = !lights_.has_visible_lights();
    if (lights_.count() <= (are_points ? kEach * samples : kEach)) {
        if (are_points) samples = 1;
        const double weight = 1. / samples;
        for (std::size_t light = 0; light < lights_.count(); ++light) {
            const std::array<double, 2> shift = stream.next_two();
            for (std::uint32_t i = 0; i < samples; ++i)
                add(lights_.sample_incident(light, at, math::even_point(i, samples, shift)), weight, at, part,
                    visit);
        }
        return;
    }
    lights_.sample_some_lights(at, kEach * samples, stream,
                               [&](const lights::IncidentLight& light) { add(light, 1, at, part, visit); });
}

template <typename Visit>
void BoundedDirect::add(const std::optional<lights::IncidentLight>& light, double weight,
                        const SurfacePoint& at, Part part, const Visit& visit) const {
    if (!light) return;
    const double cosine = dot(light->direction, at.normal);
    if (cosine <= 0) return;
    if (part == Part::bounded && std::isinf(light->pdf_per_sr))
        weight *= share(squared_length(light->source_point - at.position));
    const Rgb arriving = light->normal_illuminance_lx *
                         caster_.transmittance({at.lifted, light->source_point}) * (weight * cosine);
    if (arriving.max() > 0) visit(Arrival{light->direction, arriving, light->light});
}

}  // namespace stilb::estimators
