// Path tracing from a surface point: the luminance that it reflects.
//
// Every reflection adds the light of one source, chosen and sampled by next-event estimation, and that of
// emitters that the path runs into, weighted against each other by the balance heuristic [Veach and Guibas
// 1995]. Behind mirrors and glass, which next-event estimation cannot see through, emitters count in full.
// Not made: light that leaves a point-like source and meets a mirror or glass first.
#pragma once

#include "estimators/light_sampler.h"

namespace stilb {

/// Keeps references to its arguments. Immutable.
class PathTracer {
  public:
    PathTracer(const Scene& scene, const RayCaster& caster, const LightSampler& lights)
        : scene_(scene), caster_(caster), lights_(lights) {}

    /// Follows a ray that met `hit` through mirrors and glass: the surface behind them and what they leave of
    /// the light.
    struct View {
        std::optional<Hit> surface;  ///< not specular; nothing where the ray left the scene or ended
        Vec3 outgoing;               ///< unit, from the surface towards where it is seen from
        Spectrum transmission = Spectrum::grey(1);
        Spectrum emission_cd_m2;  ///< of emitters on the way, behind mirrors and glass, transmission included
        int reflections = 0;      ///< at mirrors and glass
    };
    View look_through(const Hit& hit, const Vec3& direction, int max_reflections, SampleStream& stream) const;

    /// Light from one source at `surface`, shadows included; nothing where none arrives.
    std::optional<IncidentLight> sample_light(const Hit& surface, SampleStream& stream) const;

    /// What arrives at `surface` (not specular) along one direction, drawn by the BRDF as seen from
    /// `outgoing`: one unbiased sample, divided by the probability of going on. Reflected light has met at
    /// most `max_reflections` surfaces before.
    struct IncomingBeam {
        Vec3 direction;            ///< unit, towards where the light comes from
        Spectrum luminance_cd_m2;  ///< reflected, and emission that is seen by mirrors or glass
        Spectrum emission_cd_m2;   ///< of an emitter that `direction` meets: sample_light() makes it as well
        double light_pdf_per_sr = 0;  ///< with this density
    };
    std::optional<IncomingBeam> sample_beam(const Hit& surface, const Vec3& outgoing, int max_reflections,
                                            SampleStream& stream) const;

    /// One sample of the luminance [cd/m2] that arrives along a ray that met `hit`: reflected light, and
    /// emission that is seen by mirrors or glass. Emission of `hit` itself is left out: that is direct light.
    Spectrum luminance_without_direct(const Hit& hit, const Vec3& direction, int max_reflections,
                                      SampleStream& stream) const;

    /// The same with the emission of `hit`: all the light along a ray.
    Spectrum luminance(const Hit& hit, const Vec3& direction, int max_reflections,
                       SampleStream& stream) const {
        return lights_.emitted_luminance(hit) +
               luminance_without_direct(hit, direction, max_reflections, stream);
    }

    const Material& material(const Hit& hit) const { return scene_.material(hit.material); }

  private:
    /// One unbiased sample of the luminance [cd/m2] that `surface` (not specular) reflects towards
    /// `outgoing`, by at most `max_reflections` reflections, its own counted. Emission of the surface itself
    /// is left out.
    Spectrum reflected_luminance(const Hit& surface, const Vec3& outgoing, int max_reflections,
                                 SampleStream& stream) const;

    const Scene& scene_;
    const RayCaster& caster_;
    const LightSampler& lights_;
};

}  // namespace stilb
