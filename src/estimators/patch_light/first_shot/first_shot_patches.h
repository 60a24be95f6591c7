// A scene whose surfaces are patches, and whose small lights first shot replaces on them.
#pragma once

#include "base/monitor.h"
#include "estimators/patch_light/first_shot/first_shot.h"
#include "estimators/patch_light/patch_options.h"
#include "estimators/patch_light/patch_report.h"
#include "patches/visibility/patch_caster.h"
#include "transport/light_sampler.h"
#include "transport/path_tracer.h"

namespace stilb::estimators {

/// Keeps references to scene and caster. Immutable once made.
struct FirstShotPatches : transport::StoredReflection {
    FirstShotPatches(const Scene& scene, const rays::RayCaster& caster, const PatchOptions& options,
                     const Monitor& monitor = Monitor::none());
    /// With what others of the same scene made: patches, and factors of incoming first shot; without factors
    /// there is no first shot.
    FirstShotPatches(const Scene& scene, const rays::RayCaster& caster, patches::Patches patches,
                     std::optional<FirstShotFactors> factors);

    /// Surfaces reflect what the patches that stand for them do.
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
