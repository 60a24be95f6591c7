// Path tracing from a surface point: the luminance that it reflects.
//
// Every reflection adds the light of one source, chosen and sampled by next-event estimation, and that of
// emitters that the path runs into, weighted against each other by the balance heuristic [Veach and Guibas
// 1995]. Behind mirrors and glass, which next-event estimation cannot see through, emitters count in full.
// Not made: light that leaves a point-like source and meets a mirror or glass first.
#pragma once

#include <limits>

#include "estimators/light_sampler.h"

namespace stilb {

/// A path that is traced against the light: where it has come to and what it has gathered on its way.
struct Path {
    Hit hit;
    Vec3 outgoing;  ///< unit, from `hit` back along the path
    SampleStream stream;
    int reflections_left = 0;  ///< at `hit` and behind
    Spectrum throughput = Spectrum::grey(1);
    Spectrum luminance_cd_m2{};  ///< so far; emission of the first hit is left out
    /// With what density `hit` was looked for from the surface before; infinite where next-event estimation
    /// could not have found it.
    double pdf_per_sr = std::numeric_limits<double>::infinity();
};

/// Keeps references to its arguments. Immutable.
class PathTracer {
  public:
    PathTracer(const Scene& scene, const RayCaster& caster, const LightSampler& lights)
        : scene_(scene), caster_(caster), lights_(lights) {}

    /// Follows paths to their ends, side by side. `first`: of the shadow rays at their first hits.
    void trace(std::span<Path> paths, Coherence first) const;

    /// Follows a path through mirrors and glass until it stands on another surface; false where it ends
    /// before.
    bool look_through(Path& path) const;

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
                                      const SampleStream& stream) const;

    /// The same with the emission of `hit`: all the light along a ray.
    Spectrum luminance(const Hit& hit, const Vec3& direction, int max_reflections,
                       const SampleStream& stream) const {
        return lights_.emitted_luminance(hit) +
               luminance_without_direct(hit, direction, max_reflections, stream);
    }

    const Material& material(const Hit& hit) const { return scene_.material(hit.material); }

  private:
    /// What a path receives from a source if nothing lies in between.
    struct Connection {
        Segment segment;
        Spectrum luminance_cd_m2;
    };
    /// What a path does where it has come to: nothing more if there is no ray.
    struct Step {
        std::optional<Connection> connection;
        std::optional<Ray> ray;
    };
    Step take_step(Path& path) const;
    std::optional<Ray> pass_specular(Path& path, const Material& material) const;
    Step reflect(Path& path, const Material& material) const;
    /// Where the step's ray has met something.
    void arrive(Path& path, const Vec3& direction, const Hit& next) const;
    /// One path by itself.
    void follow(Path& path) const;

    const Scene& scene_;
    const RayCaster& caster_;
    const LightSampler& lights_;
};

}  // namespace stilb
