// Readings of all sensors of a scene.
#pragma once

#include <atomic>
#include <span>

#include "run/options.h"
#include "run/progress.h"
#include "run/result.h"
#include "scene/scene.h"

namespace stilb::run {

/// Measures all sensors at once. Without any target, to an error of 1 % or for a minute. The result depends
/// on scene, sensors, method, bounces and seed, and on the samples done: not on threads or time (a time limit
/// decides how many samples are done). `interrupt` ends the run early, in good order. A deterministic method
/// ends by itself; its errors are NaN. Throws InputError where an option is wrong, Cancelled where user or
/// time limit end it before there is a result, std::runtime_error where the numbers are wrong (too many are
/// not finite).
RunResult measure(const Scene& scene, std::span<const Sensor> sensors, const RunOptions& options,
                  ProgressSink* progress = nullptr, const std::atomic<bool>* interrupt = nullptr);

}  // namespace stilb::run
