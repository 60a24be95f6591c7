// Light that was reflected more than once, on its own.
#pragma once

#include <vector>

#include "run/run.h"

namespace stilb::papers {

/// The luminance [cd/m2] of at least two reflections at each of the readings of a luminance sensor. Of
/// `options`, paths are those of each of `runs` pairs of runs, whose seeds follow on the given one; bounces
/// does not count.
std::vector<statistics::Estimate> multiply_reflected_cd_m2(const Scene& scene, const Sensor& sensor,
                                                           const RunOptions& options, int runs,
                                                           ProgressSink* progress = nullptr);

}  // namespace stilb::papers
