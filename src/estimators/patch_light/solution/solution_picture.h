// Pictures of a solution.
#pragma once

#include <memory>

#include "estimators/estimator.h"
#include "estimators/patch_light/solution/patch_solution.h"

namespace stilb::estimators {

/// An estimator for pictures alone: the light of the solution's vertices, which the surfaces reflect towards
/// the camera, and direct light by shadow rays from what is seen. A pass shows the light of the replicate of
/// its number. `solution`: of the problem's scene (require_consistency), all groups in one (relit).
std::unique_ptr<Estimator> make_solution_picture(const Problem& problem, PatchSolution solution);

}  // namespace stilb::estimators
