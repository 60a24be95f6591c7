// How exact the light of a solution is at its vertices.
#pragma once

#include <vector>

#include "estimators/patch_light/solution/light_gather.h"
#include "estimators/patch_light/solution/patch_solution.h"
#include "scene/scene.h"

namespace stilb::run {

/// Per lit vertex: the relative half-width of the 95 % interval of its illuminance without direct light: the
/// noise of the replicates, and beside it the bias of the patches.
std::vector<float> relative_errors(const estimators::PatchSolution& solution);

/// Relative half-widths of illuminances, direct light included, that places with 95 % of the flux meet:
/// places with hardly any light, in cracks and where things touch, must not decide.
struct AttainedErrors {
    double all = 0;
    double bias = 0;  ///< without noise: what stays however long the run goes on
};
AttainedErrors attained_errors(const patches::Patches& patches,
                               const estimators::LightGather::Illuminances& illuminances);

/// The terms rounded to steps of at most 0.3 of the stated error, for all groups together: the rest is noise,
/// which takes space in files. An illuminance changes by a quarter of that error at most, by 0.1 of it in the
/// root mean square.
estimators::PatchSolution rounded_to_errors(estimators::PatchSolution solution, const Scene& scene);

}  // namespace stilb::run
