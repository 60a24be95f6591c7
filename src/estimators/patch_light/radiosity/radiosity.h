#pragma once

#include "estimators/estimator_list.h"

namespace stilb::estimators {

std::unique_ptr<Estimator> make_radiosity_estimator(const EstimatorInput& input);
std::unique_ptr<PictureEstimator> make_radiosity_picture(const PictureInput& input);

}  // namespace stilb::estimators
