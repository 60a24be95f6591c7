// First shot: small lights replaced by their first reflection, which is flatter [Szirmay-Kalos, Sbert,
// Martinez, Tobler 2000, Incoming first-shot for non-diffuse global illumination].
//
// With Lep the emission of the replaced lights, L - Lep = Lnp solves
//
//     Lnp = L* + T Lnp,    L* = (Le - Lep) + T Lep                                   [FirstShot (11), (12)]
//
// where FirstShot::reflected() gives T Lep, by one of four variants. Its callers leave the emission
// of replaced lights out and add Lep to the light seen at the end.
//
// - classical: the reflected radiance is stored, in directional bins. Its error is the variation over a bin.
// - diffuse: the diffuse part of the reflection is stored, the rest found by shadow rays. Only for models
//   where the rest is a summand: RoughConductor and Plastic are left to shadow rays as a whole.
// - incoming: the light that arrives from each light sample is stored, and reflected when needed. Any BRDF.
// - on the fly: nothing is stored, shadow rays from every position. Any BRDF; without error except for the
//   noise of points drawn on area lights.
//
// The first three store a mean over each patch, by item buffers: their light ends at panes, while shadow rays
// pass them. Mirrors, glass and panes reflect nothing in any of them.
#pragma once

#include <optional>
#include <span>
#include <variant>

#include "base/monitor.h"
#include "estimators/patch_light/first_shot/shadow_rays.h"
#include "estimators/patch_light/first_shot/variants.h"
#include "estimators/patch_light/patch_options.h"
#include "math/random.h"
#include "patches/visibility/patch_caster.h"
#include "transport/light_sampler.h"
#include "transport/path_tracer.h"

namespace stilb::estimators {

/// Replaces no light.
struct NoFirstShot {
    void add_reflected(std::uint32_t, const Vec3&, math::RandomKey, std::span<const Vec3>,
                       std::span<Rgb>) const {}
    bool is_constant(std::uint32_t) const { return true; }
    std::size_t bytes() const { return 0; }
};

/// Immutable after construction; all queries may run in parallel. Keeps references to the arguments except
/// the options and the monitor.
class FirstShot {
  public:
    /// Throws InputError where the options are invalid (ItemBufferLayout, HemisphereBins) and where OpenGL
    /// is requested but missing; Cancelled as the monitor says.
    FirstShot(const Scene& scene, const rays::RayCaster& caster, const transport::LightSampler& sampler,
              const patches::PatchCaster& patch_caster, const FirstShotOptions& options,
              const Monitor& monitor = Monitor::none());
    /// Incoming first shot with factors of another one, of the same scene and patches.
    FirstShot(const Scene& scene, const rays::RayCaster& caster, const patches::Patches& patches,
              FirstShotFactors factors);
    FirstShot(const FirstShot&) = delete;
    FirstShot& operator=(const FirstShot&) = delete;

    /// Whether the emission of a light (of Scene::lights) is replaced.
    bool replaces(std::size_t light) const { return lights_.lights[light].is_replaced; }

    /// The light of the replaced lights that a side reflects towards the unit world direction `out`
    /// [cd/m2]; nothing towards directions behind the side. `position` is on the side's patch; it does not
    /// matter where light is stored. Shadow rays end at points on area lights that are drawn by key and
    /// position: use another key for each sample, where positions are always the same.
    Rgb reflected(std::uint32_t side, const Vec3& position, math::RandomKey key, const Vec3& out) const;
    /// The same added to `sums` for several directions: the arriving light is computed once.
    void add_reflected(std::uint32_t side, const Vec3& position, math::RandomKey key,
                       std::span<const Vec3> outs, std::span<Rgb> sums) const;
    /// Whether the light is the same for all positions and all directions in front of the side: one call is
    /// then enough for all steps.
    bool is_constant(std::uint32_t side) const;

    /// Whether position and key matter, because shadow rays start at the position.
    bool needs_position(std::uint32_t side) const {
        return std::holds_alternative<ShadowRays>(stored_) ||
               (std::holds_alternative<DiffuseFirstShot>(stored_) && !is_constant(side));
    }

    FirstShotVariant variant() const { return static_cast<FirstShotVariant>(stored_.index()); }
    /// The resolution of the item buffers, if there are any.
    std::optional<int> resolution() const { return resolution_; }
    /// The decision on each light, as Scene::lights.
    std::span<const FirstShotLight> lights() const { return lights_.lights; }
    std::span<const LightSample> samples() const { return lights_.samples; }
    /// Factors of incoming first shot; none in other variants.
    const IncomingFirstShot* incoming() const { return std::get_if<IncomingFirstShot>(&stored_); }
    /// Pairs of a side and a light sample that see one another but have no pixel (FirstShotFactors): none
    /// without item buffers.
    std::size_t missed() const { return missed_; }
    /// The memory of the stored light.
    std::size_t bytes() const;
    double set_up_s() const { return set_up_s_; }

  private:
    void set_up(const Scene& scene, const rays::RayCaster& caster, const transport::LightSampler& sampler,
                const patches::PatchCaster& patch_caster, const FirstShotOptions& options,
                const Monitor& monitor);

    FirstShotLights lights_;
    std::optional<int> resolution_;
    std::size_t missed_ = 0;
    /// In the order of FirstShotVariant.
    std::variant<NoFirstShot, ClassicalFirstShot, DiffuseFirstShot, IncomingFirstShot, ShadowRays> stored_;
    double set_up_s_ = 0;
};

// A scene whose surfaces are replaced by patches, and whose small lights are replaced by first shot on them.

/// Keeps references to scene and caster. Immutable after construction.
struct FirstShotPatches : transport::StoredReflection {
    FirstShotPatches(const Scene& scene, const rays::RayCaster& caster, const PatchOptions& options,
                     const Monitor& monitor = Monitor::none());

    /// Surfaces reflect as the patches do that represent them.
    void add_to(std::span<transport::Path* const> paths, rays::Coherence coherence) const override;

    PatchReport report() const;

    const Scene& scene;
    const rays::RayCaster& caster;
    PatchOptions options;
    transport::LightSampler lights;
    double size_m;  ///< no edge is longer
    patches::Patches patches;
    patches::PatchCaster patch_caster;
    FirstShot first_shot;
};

}  // namespace stilb::estimators
