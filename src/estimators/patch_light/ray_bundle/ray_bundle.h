#pragma once

#include "estimators/estimator_list.h"

namespace stilb::estimators {

std::unique_ptr<Estimator> make_ray_bundle_estimator(const EstimatorInput& input);

}  // namespace stilb::estimators
