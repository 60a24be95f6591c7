// The view-independent light of a scene: computed by solve(), stored in files, rendered to pictures.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "estimators/estimator.h"
#include "estimators/patch_light/first_shot/factors.h"
#include "estimators/patch_light/patch_transport.h"
#include "patches/patches.h"
#include "scene/scene.h"

namespace stilb::estimators {

/// Plain values, which belong to a scene with the same objects, materials and lights.
struct PatchSolution {
    patches::Patches patches;
    /// Factors of incoming first shot; nothing without first shot.
    std::optional<FirstShotFactors> factors;
    /// The degree of the basis of the light (incoming_light.h).
    int degree = 0;
    /// The sides that receive light and reflect some of it, ascending.
    std::vector<std::uint32_t> lit_sides;
    /// For each independent replicate: the terms [lx / sqrt(sr)] of all lit sides, one after the other.
    std::vector<std::vector<FloatRgb>> replicates;
};

/// Throws InputError where the parts do not fit one another or the scene: indices out of range would
/// address other data.
void require_consistency(const PatchSolution& solution, const Scene& scene, const rays::RayCaster& caster);

/// An estimator for pictures alone, whose pass shows the solution's replicate of the pass's number.
/// Throws InputError where the solution does not fit the scene.
std::unique_ptr<Estimator> make_solution_picture(const Problem& problem, PatchSolution solution);

}  // namespace stilb::estimators
