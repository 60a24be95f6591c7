// How fast pictures by ray bundles converge, with every first shot.
#pragma once

#include <string>
#include <vector>

#include "estimators/patch_options.h"
#include "scene/ray_caster.h"
#include "sensors/camera.h"

namespace stilb {

/// The error of a picture that is the mean of so many steps: mean absolute difference from the reference's
/// pixels, over their mean.
struct ConvergencePoint {
    double steps = 0;
    double elapsed_s = 0;  ///< set-up of first shot included
    double error = 0;
};

struct ConvergenceCurve {
    std::string name;
    std::vector<ConvergencePoint> points;
};

struct ConvergenceMethod {
    std::string name;
    PatchOptions options;
};

/// One walk for each method from darkness, no step left out, and the same number of steps for all but those
/// that take longer than `most_time_s`. The reference is the mean of several longer walks by incoming first
/// shot over the same patches.
std::vector<ConvergenceCurve> converge(const Scene& scene, const RayCaster& caster, const Camera& camera,
                                       const std::vector<ConvergenceMethod>& methods, int steps,
                                       double most_time_s);

}  // namespace stilb
