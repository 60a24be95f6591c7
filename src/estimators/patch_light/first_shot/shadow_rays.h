// First shot on the fly: light of the replaced lights at any position, by shadow rays when it is asked for.
//
// Point-like lights are exact. An area light is the mean of as many points drawn on it as it has samples: of
// low discrepancy in one call, and without bias over keys and over positions.
#pragma once

#include <span>

#include "estimators/patch_light/first_shot/lights.h"
#include "estimators/patch_light/first_shot/surface.h"
#include "math/random.h"
#include "transport/light_sampler.h"

namespace stilb::estimators {

/// Where rays from a position on a patch start: lifted off the true surface on that side. Spheres bulge out
/// beyond their patches.
Vec3 lifted_off(const Scene& scene, const patches::Patches& patches, const rays::RayCaster& caster,
                std::uint32_t side, const Vec3& position);

/// Keeps references to all arguments.
class ShadowRays {
  public:
    ShadowRays(const Scene& scene, const patches::Patches& patches, const rays::RayCaster& caster,
               const transport::LightSampler& sampler, const FirstShotLights& lights)
        : scene_(scene), patches_(patches), caster_(caster), sampler_(sampler), lights_(lights) {}

    /// As FirstShot.
    void add_reflected(std::uint32_t side, const Vec3& position, math::RandomKey key,
                       std::span<const Vec3> outs, std::span<Rgb> sums) const {
        add_reflected_by(material_of(scene_, patches_, side), side, position, key, outs, sums);
    }
    /// As if the side were of another material.
    void add_reflected_by(const Material& material, std::uint32_t side, const Vec3& position,
                          math::RandomKey key, std::span<const Vec3> outs, std::span<Rgb> sums) const;
    /// Where nothing is reflected: light differs from position to position.
    bool is_constant(std::uint32_t side) const {
        return reflects_nothing(material_of(scene_, patches_, side));
    }
    std::size_t bytes() const { return 0; }

  private:
    const Scene& scene_;
    const patches::Patches& patches_;
    const rays::RayCaster& caster_;
    const transport::LightSampler& sampler_;
    const FirstShotLights& lights_;
};

}  // namespace stilb::estimators
