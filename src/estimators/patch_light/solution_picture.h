// Pictures of a solution: what patches reflect towards the eye is known before the first pass.
#pragma once

#include "estimators/patch_light/patch_solution.h"
#include "estimators/picture_estimator.h"

namespace stilb::estimators {

/// A pass shows the solution's replicate of the pass's number. Throws InputError where the solution does not
/// fit the scene.
std::unique_ptr<PictureEstimator> make_solution_picture(const PictureInput& input, PatchSolution solution);

}  // namespace stilb::estimators
