#pragma once

#include <memory>

#include "estimators/estimator_list.h"

namespace stilb::estimators {

/// Local estimation as published, and balanced with path tracing; see local_estimation.cpp.
std::unique_ptr<Estimator> make_local_estimator(const EstimatorInput& input);
std::unique_ptr<Estimator> make_auto_estimator(const EstimatorInput& input);

}  // namespace stilb::estimators
