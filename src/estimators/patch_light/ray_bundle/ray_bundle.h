#pragma once

#include "estimators/estimator_list.h"

namespace stilb {

std::unique_ptr<Estimator> make_ray_bundle_estimator(const EstimatorInput& input);

}  // namespace stilb
