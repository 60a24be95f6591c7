// A scene whose surfaces are patches, and whose small lights first shot replaces on them.
#pragma once

#include "estimators/light_sampler.h"
#include "estimators/patch_options.h"
#include "estimators/patch_report.h"
#include "patches/patch_caster.h"

namespace stilb {

/// Keeps references to scene and caster. Immutable once made.
struct FirstShotPatches {
    FirstShotPatches(const Scene& scene, const RayCaster& caster, const PatchOptions& options);
    /// With what others of the same scene made: patches, and factors of incoming first shot; without factors
    /// there is no first shot.
    FirstShotPatches(const Scene& scene, const RayCaster& caster, Patches patches,
                     std::optional<FirstShotFactors> factors);

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
