// What is known of a scene's light for all eyes at once: made by solve(), kept in files, shown by pictures.
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
    /// Of incoming first shot; nothing without first shot.
    std::optional<FirstShotFactors> factors;
    /// Of the basis that light is kept in (incoming_light.h).
    int degree = 0;
    /// That receive light and reflect some, ascending.
    std::vector<std::uint32_t> lit_sides;
    /// Of each independent replicate: the terms [lx / sqrt(sr)] of all lit sides, one after the other.
    std::vector<std::vector<FloatRgb>> replicates;
};

/// Throws InputError where the parts do not fit one another or the scene: what is out of range would be
/// looked up elsewhere.
void require_consistency(const PatchSolution& solution, const Scene& scene, const rays::RayCaster& caster);

/// An estimator of pictures alone, of which a pass shows the solution's replicate of the pass's number.
/// Throws InputError where the solution does not fit the scene.
std::unique_ptr<Estimator> make_solution_picture(const Problem& problem, PatchSolution solution);

}  // namespace stilb::estimators
