// A scene whose surfaces are patches, and whose small lights first shot replaces on them.
#pragma once

#include "estimators/patch_light/patch_options.h"
#include "estimators/patch_light/patch_report.h"
#include "patches/visibility/patch_caster.h"
#include "transport/light_sampler.h"
#include "transport/path_tracer.h"

namespace stilb {

/// Keeps references to scene and caster. Immutable once made.
struct FirstShotPatches : StoredReflection {
    FirstShotPatches(const Scene& scene, const RayCaster& caster, const PatchOptions& options);
    /// With what others of the same scene made: patches, and factors of incoming first shot; without factors
    /// there is no first shot.
    FirstShotPatches(const Scene& scene, const RayCaster& caster, Patches patches,
                     std::optional<FirstShotFactors> factors);

    /// Surfaces reflect what the patches that stand for them do.
    void add_to(std::span<Path* const> paths, Coherence coherence) const override;

    PatchReport report() const;

    const Scene& scene;
    const RayCaster& caster;
    PatchOptions options;
    LightSampler lights;
    double size_m;  ///< no edge is longer
    Patches patches;
    PatchCaster patch_caster;
    FirstShot first_shot;
};

}  // namespace stilb
