#pragma once

#include <memory>

#include "estimators/estimator_list.h"

namespace stilb::estimators {

/// Path tracing from every point; see path.cpp.
std::unique_ptr<Estimator> make_path_estimator(const EstimatorInput& input);

}  // namespace stilb::estimators
