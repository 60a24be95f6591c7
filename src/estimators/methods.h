// The methods, each in the file of its name: estimator_list.cpp has one entry for each.
#pragma once

#include <memory>

#include "estimators/estimator.h"

namespace stilb::estimators {

/// Local estimation balanced with path tracing, and as published: local/local_estimation.cpp.
std::unique_ptr<Estimator> make_auto(const Problem& problem);
std::unique_ptr<Estimator> make_local(const Problem& problem);
/// path/path.cpp
std::unique_ptr<Estimator> make_path(const Problem& problem);
/// patch_light/ray_bundle/ray_bundle.cpp
std::unique_ptr<Estimator> make_ray_bundle(const Problem& problem);
/// patch_light/radiosity/radiosity.cpp
std::unique_ptr<Estimator> make_radiosity(const Problem& problem);
/// patch_light/particles/particles.cpp
std::unique_ptr<Estimator> make_particles(const Problem& problem);

}  // namespace stilb::estimators
