#pragma once

#include "estimators/estimator_list.h"

namespace stilb::estimators {

std::unique_ptr<Estimator> make_particles_estimator(const EstimatorInput& input);
std::unique_ptr<PictureEstimator> make_particles_picture(const PictureInput& input);

}  // namespace stilb::estimators
