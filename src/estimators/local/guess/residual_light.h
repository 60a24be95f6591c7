// What a guess of the light lacks: the residual r = E + T L~ - L~ of theory (T.8), and its reflections.
//
// r is the light that a surface point reflects, direct light and light of the guess by one more reflection,
// minus the guess there: of the diffuse part of its material, where it may be negative, and of the gloss.
// Paths start from r, spread over the surfaces, and walk on as light paths do: their vertices, connected to
// the receivers, bring what the guess lacks. Diffuse part and gloss are vertices of their own. Paths end on
// traced surfaces, because r contains what these bring, by path tracing.
//
// Close to point lights, r holds only a part of the direct light (bounded_direct.h): particles bring the
// rest. Light that only light paths find, because it left a point-like source and met a mirror or glass
// first, is not in r: it comes from light paths beside those of the residual.
#pragma once

#include <cstdint>
#include <vector>

#include "estimators/local/guess/light_guess.h"
#include "math/sampling.h"
#include "transport/light_parts.h"
#include "transport/light_path.h"
#include "transport/path_tracer.h"

namespace stilb::estimators {

/// Keeps references to its arguments. Immutable.
class ResidualLight {
  public:
    /// Parts of the keys of its paths.
    enum class Stream : std::uint64_t { paths, light_paths, particles };

    /// `key`: for the pilot that finds where r is large.
    ResidualLight(const Scene& scene, const rays::RayCaster& caster, const transport::LightSampler& lights,
                  const BoundedDirect& direct, const transport::PathTracer& tracer, const LightGuess& guess,
                  math::RandomKey key, const Monitor& monitor = Monitor::none());

    /// The vertices of paths number `first` ... `end` - 1 of the streams of a key, for a sum over the paths:
    /// the expectation of each path's sum is the whole residual.
    std::vector<transport::LightVertex> trace(math::KeyOf<Stream> key, std::uint64_t first,
                                              std::uint64_t end) const;

    /// An estimate of the luminance that the guess lacks at a point of a side whose material is diffuse, all
    /// the light of point lights included [cd/m2].
    transport::LightSum missing_cd_m2(std::uint32_t side, const math::Barycentric& at,
                                      math::SampleStream& stream) const;

    /// The lit area from which it comes: that of the guess, and of surfaces that have no guess.
    double area_m2() const { return area_m2_; }

  private:
    /// Where and how paths start.
    struct Start {
        SurfacePoint point;
        transport::LightSum guessed_cd_m2;
        /// One sample of r, as the illuminance that the diffuse part would reflect to it.
        transport::LightSum missing_lx;
        /// All the light that the gloss reflects, as if it came from one direction.
        Vec3 direction;
        transport::LightSum arriving_lx;
    };
    /// The light that arrives at a point of a side, after its next reflection. `chosen`: gets each part of
    /// it.
    template <typename Chosen>
    transport::LightSum arriving_at(const SurfacePoint& point, std::uint64_t packets,
                                    BoundedDirect::Part part, math::SampleStream& stream,
                                    Chosen& chosen) const;
    Start start_at(std::uint32_t side, const math::Barycentric& at, std::uint64_t packets,
                   BoundedDirect::Part part, math::SampleStream& stream) const;
    /// One step of a walk: r, as in Start, and what of the rest of the walk comes back.
    struct Step {
        transport::LightSum missing_lx;
        Rgb reflectance;
        double survival = 0;
        Rgb share{};  ///< of the side on which the walk goes on, over the probability of that
    };
    /// What a ray from a point meets: a side where the walk goes on, or a surface of which a sample of what
    /// the guess lacks there is known.
    struct Around {
        std::uint32_t side;
        math::Barycentric at;
        transport::LightSum missing_cd_m2;
    };
    Around look_around(const SurfacePoint& point, math::SampleStream& stream) const;
    double pilot(std::uint32_t side, math::RandomKey key) const;
    void trace_particle(math::SampleStream stream, std::vector<transport::LightVertex>& nodes) const;
    void trace_one(math::SampleStream stream, std::vector<transport::LightVertex>& nodes) const;
    /// Goes on from a start with some paths, each by one of the parts of the material. `diffuse`, `gloss`:
    /// the start as their vertices.
    void branch_out(const materials::SplitMaterial& parts, const transport::LightVertex& diffuse,
                    const transport::LightVertex& gloss, math::SampleStream& stream,
                    std::vector<transport::LightVertex>& nodes) const;
    /// Adds vertices from the surface on that the flux of the vertex `from` meets.
    void walk(std::optional<rays::Hit> hit, Vec3 direction, transport::LightVertex from,
              math::SampleStream& stream, std::vector<transport::LightVertex>& nodes) const;
    void trace_light_paths_only(math::RandomKey key, std::uint64_t first, std::uint64_t end,
                                std::vector<transport::LightVertex>& nodes) const;
    /// Adds the vertices of all parts of a surface that a walk meets along `direction`. `carried`: its flux.
    void add_all(const rays::Hit& hit, const Vec3& direction, const materials::SplitMaterial& parts,
                 const transport::LightVertex& carried, std::vector<transport::LightVertex>& nodes) const;
    /// Adds the vertices of both parts of a material.
    void add(const transport::LightVertex& whole, const materials::SplitMaterial& parts,
             std::vector<transport::LightVertex>& nodes) const;

    const Scene& scene_;
    const rays::RayCaster& caster_;
    const transport::LightSampler& lights_;
    const BoundedDirect& direct_;
    const transport::PathTracer& tracer_;
    const LightGuess& guess_;
    bool has_light_for_light_paths_only_;
    double area_m2_;
    std::vector<std::uint32_t> sides_;        ///< that reflect light and are not traced
    math::DiscreteDistribution by_residual_;  ///< over `sides_`
    std::vector<double> favours_;             ///< LightVertex::favour of their starts
};

}  // namespace stilb::estimators
