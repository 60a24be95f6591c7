// How fast pictures by ray bundles converge, with every first shot.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "estimators/camera_paths.h"
#include "estimators/patch_light/patch_options.h"
#include "estimators/patch_light/patch_transport.h"

namespace stilb::papers {

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
    estimators::PatchOptions options;
    bool is_shown = false;  ///< by pictures, which need all steps
};

/// What sides reflect towards the eye [cd/m2], as a mean over so many steps of a method.
struct ConvergenceState {
    const ConvergenceMethod& method;
    const estimators::PatchTransport& transport;
    int steps;
    std::vector<estimators::FloatRgb> sides_cd_m2;
};

/// One walk for each method from darkness, no step left out, and the same number of steps for all but those
/// that take longer than `most_time_s` and are not shown. The reference is the mean of several walks of as
/// many steps by incoming first shot over the same patches; throws std::invalid_argument where the methods'
/// patches have different sizes. `look` sees what has a point on the curve; its time is not counted.
std::vector<ConvergenceCurve> converge(const estimators::PictureTracing& tracing,
                                       const std::vector<ConvergenceMethod>& methods, int steps,
                                       double most_time_s,
                                       const std::function<void(const ConvergenceState&)>& look);

}  // namespace stilb::papers
