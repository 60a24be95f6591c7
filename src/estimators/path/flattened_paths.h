// Path tracing of a scene as it is, or flattened by first shot: small lights replaced by their first
// reflection, which every surface on a path adds as the patch that stands for it does.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "estimators/patch_light/first_shot/first_shot_patches.h"
#include "transport/path_tracer.h"

namespace stilb::estimators {

/// Keeps references to scene and caster. Stays where it is made. Immutable.
struct FlattenedPaths {
    /// There are patches only where the options name a variant of first shot.
    FlattenedPaths(const Scene& scene, const rays::RayCaster& caster, const PatchOptions& options,
                   const Monitor& monitor);
    FlattenedPaths(const FlattenedPaths&) = delete;
    FlattenedPaths& operator=(const FlattenedPaths&) = delete;

    std::vector<std::string> warnings() const;
    std::optional<PatchReport> report() const;

    const Scene& scene;
    std::unique_ptr<const FirstShotPatches> patches;  ///< null without first shot
    transport::LightSampler lights;                   ///< those that are replaced are made elsewhere
    transport::PathTracer tracer;
};

}  // namespace stilb::estimators
