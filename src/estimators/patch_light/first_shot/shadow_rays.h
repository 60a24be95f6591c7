// First shot on the fly: light of the replaced lights at any position, by shadow rays when needed.
//
// Point-like lights are exact. An area light is the mean of as many points drawn on it as it has samples: of
// low discrepancy in one call, and without bias over keys and over positions.
#pragma once

#include <cstddef>
#include <span>
#include <variant>

#include "estimators/patch_light/first_shot/factors.h"
#include "estimators/patch_light/first_shot/lights.h"
#include "materials/material.h"
#include "materials/model_list.h"
#include "math/random.h"
#include "patches/patches.h"
#include "rays/ray_caster.h"
#include "transport/light_sampler.h"

namespace stilb::estimators {

// Sides of patches as reflecting surfaces.

inline const Material& material_of(const Scene& scene, const patches::Patches& patches, std::uint32_t side) {
    return scene.material(patches.material_of(scene, side));
}

/// The local frame of a side's material, in world coordinates.
inline Frame frame_of(const patches::Patches& patches, std::uint32_t side) {
    return Frame::of_surface(patches.normal_of(side));
}

/// Bands in single precision, for data stored per side.
inline patches::Float3 in_floats(const Rgb& s) {
    return {static_cast<float>(s[0]), static_cast<float>(s[1]), static_cast<float>(s[2])};
}
inline Rgb to_spectrum(const patches::Float3& bands) { return {{bands.x, bands.y, bands.z}}; }

/// True for mirrors, glass and panes, too: they have no BRDF.
inline bool reflects_nothing(const Material& material) {
    return material.is<Black>() || is_specular(material);
}
/// Whether the reflected light, if any, is the same in all directions.
inline bool reflects_alike(const Material& material) {
    return material.is<Diffuse>() || reflects_nothing(material);
}

/// As reflect(), for one model. It is not inlined, so that simple models are not slowed by the registers that
/// others need.
template <typename M, typename ForEachArrival>
[[gnu::noinline]] void reflect_by(const M& material, const Frame& frame,
                                  const ForEachArrival& for_each_arrival, std::span<const Vec3> outs,
                                  std::span<Rgb> sums) {
    for_each_arrival([&](const Vec3& in, const Rgb& illuminance_lx) {
        const Vec3 local_in = frame.to_local(in);
        for (std::size_t i = 0; i < outs.size(); ++i) {
            const Vec3 out = frame.to_local(outs[i]);
            sums[i] += evaluate_brdf_per_sr(material, local_in, out) * illuminance_lx;
        }
    });
}

/// Adds to each of `sums` the light that the material reflects towards the unit world direction in `outs` at
/// the same index [cd/m2]. `for_each_arrival(visit)` calls `visit(in, illuminance_lx)` for all light that
/// arrives from the unit world direction `in`.
template <typename ForEachArrival>
void reflect(const Material& any, const Frame& frame, const ForEachArrival& for_each_arrival,
             std::span<const Vec3> outs, std::span<Rgb> sums) {
    materials::visit_model(
        [&](const auto& material) { reflect_by(material, frame, for_each_arrival, outs, sums); }, any);
}

// Shadow rays.

/// The start of rays from a position on a patch: lifted off the true surface on that side. Spheres bulge out
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
    /// As if the side had another material.
    void add_reflected_by(const Material& material, std::uint32_t side, const Vec3& position,
                          math::RandomKey key, std::span<const Vec3> outs, std::span<Rgb> sums) const;
    /// For sides that reflect nothing: the light differs between positions.
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

// Detection of item buffers that were too coarse.

/// More lines of sight take tens of seconds.
inline constexpr std::size_t kMostPairs = 100'000'000;
/// The number of pairs of a side and a light sample that has no pixel on it, though its light reaches the
/// side's middle. Only sides of a few pixels' size are tested, and of more than kMostPairs pairs those of
/// every n-th side, which then stand for the others.
std::size_t count_missed(const Scene& scene, const rays::RayCaster& caster, const patches::Patches& patches,
                         std::span<const LightSample> samples, const FirstShotFactors& factors,
                         int resolution, const Monitor& monitor);

}  // namespace stilb::estimators
