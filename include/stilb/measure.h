#pragma once

#include "stilb/options.h"
#include "stilb/result.h"
#include "stilb/scene.h"

namespace stilb::api {

/// Measures all sensors of a scene but cameras. Without any target it stops at an error of 1 % or after a
/// minute. The result depends on scene, method, bounces and seed, and on the samples done: not on threads.
/// Throws InputError where an option is wrong, Interrupted where it was interrupted before there was a
/// result.
Result measure(const Scene& scene, const Options& options = {}, const Control& control = {});

}  // namespace stilb::api
