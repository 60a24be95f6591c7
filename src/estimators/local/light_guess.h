// A quick guess of the light that diffuse surfaces reflect: a control variate for local estimation (theory
// T.8).
//
// The guess is a function of the point alone: the luminance of patches, interpolated between their vertices.
// It is wrong by some per cent, and nothing is biased by that: what it lacks, the residual, is estimated
// beside it (residual_light.h). It must not depend on the samples that it is used with, so it has a random
// key of its own.
//
// Each lit side of a patch sends out some rays once. The sides that they meet are a sampled matrix of form
// factors, and the guess is the solution of the equations of radiosity with it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/monitor.h"
#include "math/random.h"
#include "patches/patches.h"
#include "patches/visibility/patch_caster.h"
#include "rays/ray_caster.h"
#include "transport/light_sampler.h"
#include "transport/path_tracer.h"

namespace stilb::estimators {

/// The guessed light along the rays of a packet.
struct GuessedLight {
    using Floats = RayPacket::Floats;
    alignas(64) std::array<Floats, kBands> luminance{};  ///< [cd/m2]; 0 where a ray meets nothing
    alignas(64) Floats cosine{};  ///< at the surface that is met; 0 where there is none
    /// The lanes whose rays meet a mirror or glass, for which there is no guess.
    std::uint32_t specular_lanes = 0;
};

/// Keeps references to its arguments. Immutable.
class LightGuess {
  public:
    /// Whether all surfaces are flat and diffuse, apart from mirrors and glass.
    static bool suits(const Scene& scene);

    LightGuess(const Scene& scene, const rays::RayCaster& caster, const transport::LightSampler& lights,
               const transport::PathTracer& tracer, math::RandomKey key,
               const Monitor& monitor = Monitor::none());

    const patches::Patches& patches() const { return patches_; }
    /// The sides that light reaches and that reflect it, ascending.
    const std::vector<std::uint32_t>& lit_sides() const { return lit_sides_; }
    const Rgb& reflectance(std::uint32_t side) const { return reflectance_[patches_.patch_of(side)]; }

    /// The guess at a point of a side [cd/m2].
    Rgb luminance_cd_m2(std::uint32_t side, const math::Barycentric& at) const;
    /// The guess along rays, for lanes that are set. Origins are relative to patches().center; `end` becomes
    /// the distance of the surface that is met.
    void look(RayPacket& packet, const LaneMask& lanes, rays::Coherence coherence, GuessedLight& light) const;

  private:
    /// Of a side, for three corners.
    using CornerLuminances = std::array<std::array<float, kBands>, 3>;

    struct Solver;

    void interpolate(const std::vector<Rgb>& luminance_of_sides);

    patches::Patches patches_;
    patches::PatchCaster patch_caster_{patches_};
    std::vector<Rgb> reflectance_;           ///< per patch; 0 where it is specular
    std::vector<std::uint8_t> is_specular_;  ///< per patch
    std::vector<std::uint32_t> lit_sides_;
    std::vector<CornerLuminances> corners_;  ///< per side
};

/// A point of a side, lifted off it, and its direct light.
struct SidePoint {
    math::Barycentric barycentric;
    Vec3 position, lifted, normal;
};
SidePoint side_point(const patches::Patches& patches, const rays::RayCaster& caster, std::uint32_t side,
                     double u1, double u2);

/// One sample of the direct illuminance at a surface point [lx]: of every light, or of some where they are
/// many.
Rgb sample_direct_lx(const transport::LightSampler& lights, const rays::RayCaster& caster,
                     const SidePoint& at, math::SampleStream& stream);

}  // namespace stilb::estimators
